"""The measures of docs/rubrics.md, from the forms of the sentences."""

from __future__ import annotations

from mrlab_ros.core.rubrics.forms import FAMILIES


def measures() -> str:
    """Return a table of all forms."""
    lines = ["| `expect` | what is measured | `partial` |", "|---|---|---|"]
    for family, forms in FAMILIES.items():
        lines.append(f"| **{family.capitalize()}** | | |")
        for form in forms:
            partial = ["`each`"] if form.each else []
            partial += [f"`until {form.until.example}`"] if form.until else []
            lines.append(f"| `{form.text}` | {form.about} | {', '.join(partial)} |")
    return "\n".join(lines)
