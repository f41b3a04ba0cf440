"""Finds a robot's joints among the names that a foreign bag uses for them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.recording.diagnostics import JOINTS_OF_TOPIC, NO_SUCH_JOINTS, SEVERAL_MODELS


def columns_of(joints: Sequence[str], names: Sequence[str]) -> list[int] | None:
    """Return where each joint of a robot stands among `names`, None where one is missing.

    A name may have a prefix, such as left_elbow_joint or cell/elbow_joint, that is the same for
    all joints.
    """
    prefixes = {
        name.removesuffix(joints[0])
        for name in names
        if name.endswith(joints[0]) and name.removesuffix(joints[0])[-1:] in ("", "_", "/", ".")
    }
    for prefix in sorted(prefixes, key=len):
        wanted = [prefix + joint for joint in joints]
        if set(wanted) <= set(names):
            return [names.index(name) for name in wanted]
    return None


def chosen_models(
    asked: Sequence[str],
    models: Mapping[str, Sequence[str]],
    topics: Mapping[str, Sequence[str]],
) -> dict[str, str]:
    """Return the model of each topic whose joints are a robot's.

    asked: models that the person named; empty: found by the names. models: joints of each model;
    topics: joint names of each topic. Raises BadInput where an asked robot has no joints there,
    Misuse where the names fit several robots and none was named.
    """
    if asked:
        return _of_asked(asked, models, topics)
    found = {}
    for topic, names in topics.items():
        fitting = [model for model in models if columns_of(models[model], names) is not None]
        # An arm of seven joints fits one of six whose names are among them.
        most = max((len(models[model]) for model in fitting), default=0)
        fitting = [model for model in fitting if len(models[model]) == most]
        if len(fitting) > 1:
            fix = Fix(option="robot", value=fitting[0])
            raise Misuse(SEVERAL_MODELS(topic=topic, models=fitting, fixes=(fix,)))
        if fitting:
            found[topic] = fitting[0]
    return found


def _of_asked(
    asked: Sequence[str],
    models: Mapping[str, Sequence[str]],
    topics: Mapping[str, Sequence[str]],
) -> dict[str, str]:
    found: dict[str, str] = {}
    for model in asked:
        free = [
            topic
            for topic, names in topics.items()
            if topic not in found and columns_of(models[model], names) is not None
        ]
        if not free:
            there = [JOINTS_OF_TOPIC(topic=topic, joints=names) for topic, names in topics.items()]
            raise BadInput(NO_SUCH_JOINTS(model=model, joints=models[model], found=there))
        found[free[0]] = model
    return found
