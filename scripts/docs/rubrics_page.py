"""The measures of docs/rubrics.md, from the forms of the sentences."""

from __future__ import annotations

from mrlab_ros.classroom.rubrics.measures import FAMILIES


def measures() -> str:
    """Return a table of all forms."""
    lines = ["| `expect` | what is measured | `partial` |", "|---|---|---|"]
    for family, forms in FAMILIES.items():
        lines.append(f"| **{family.capitalize()}** | | |")
        for form in forms:
            rules = ", ".join(f"`{rule}`" for rule in form.rules)
            lines.append(f"| `{form.text}` | {form.about} | {rules} |")
    return "\n".join(lines)
