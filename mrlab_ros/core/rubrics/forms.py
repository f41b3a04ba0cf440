"""All forms of the sentences of a rubric, by families."""

from __future__ import annotations

from mrlab_ros.core.rubrics import (
    comparison,
    contacts,
    ends,
    grasps,
    limits,
    paths,
    places,
    poses,
    timing,
)
from mrlab_ros.core.rubrics.sentences import Form

FAMILIES: dict[str, tuple[Form, ...]] = {
    "contact and distance": contacts.FORMS,
    "poses, beginning and end": poses.FORMS + ends.FORMS,
    "grasps": grasps.FORMS,
    "places": places.FORMS,
    "time and mode": timing.FORMS,
    "limits": limits.FORMS,
    "path": paths.FORMS,
    "reference": comparison.FORMS,
}
FORMS = tuple(form for forms in FAMILIES.values() for form in forms)
