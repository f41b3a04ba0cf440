"""The page of a file in which no motion was found: why, and the marks all the same."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from mrlab_ros.app.show import ingredients, still_text
from mrlab_ros.app.show.page import page

SCHEMA = "mrlab.refusal.1"


def refusal_page(
    title: str, findings: Sequence[Mapping[str, Any]], marks: Mapping[str, Any], share: Path
) -> str:
    """Return one HTML file that says why there is nothing to be seen.

    findings: as `plain` writes diagnostics, the reason first. marks: by a rubric, as JSON has
    them. share: folder with the built pages.
    """
    document = {"schema": SCHEMA, "title": title, "findings": list(findings), "marks": marks}
    code = ingredients.code(share, flat=True)
    return page(title, still_text.refusal(document), document, {}, code)
