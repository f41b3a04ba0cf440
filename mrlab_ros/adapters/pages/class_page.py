"""The page of a graded class."""

from __future__ import annotations

from pathlib import Path

from mrlab_ros.adapters.pages import ingredients
from mrlab_ros.core.classroom.graded import GradedClass
from mrlab_ros.core.show import static
from mrlab_ros.core.show.classroom import class_document
from mrlab_ros.core.show.page import page


def class_page(graded: GradedClass, share: Path) -> str:
    """Return one HTML file about a class. share: folder with the built pages."""
    document = class_document(graded)
    return page(
        graded.rubric.name, static.classroom(document), document, {}, ingredients.code(share)
    )
