"""The page of a graded class."""

from __future__ import annotations

from pathlib import Path

from mrlab_ros.adapters.pages import ingredients
from mrlab_ros.core.classroom.graded import SCHEMA, GradedClass
from mrlab_ros.core.show.class_body import class_body
from mrlab_ros.core.show.page import page


def class_page(graded: GradedClass, share: Path) -> str:
    """Return one HTML file about a class. share: folder with the built pages."""
    alike = sorted({key for group in graded.similar().groups for key in group.keys})
    document = {"schema": SCHEMA, "alike": alike}
    return page(graded.rubric.name, class_body(graded), document, {}, ingredients.code(share))
