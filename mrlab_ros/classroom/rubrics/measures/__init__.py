"""All forms of the sentences of a rubric.

Each module of this folder has FORMS and the FAMILY that they belong to. A new file adds a measure;
nothing else names it.
"""

from __future__ import annotations

import importlib
import pkgutil

from mrlab_ros.classroom.rubrics.sentences import Form


def families() -> dict[str, tuple[Form, ...]]:
    """Return the forms of all modules of this folder, by family."""
    found: dict[str, tuple[Form, ...]] = {}
    for module in sorted(pkgutil.iter_modules(__path__), key=lambda each: each.name):
        measures = importlib.import_module(f"{__name__}.{module.name}")
        found[measures.FAMILY] = (*found.get(measures.FAMILY, ()), *measures.FORMS)
    return found


FAMILIES = families()
FORMS = tuple(form for forms in FAMILIES.values() for form in forms)
