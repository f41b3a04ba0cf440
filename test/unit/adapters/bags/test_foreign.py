"""Joints of a robot among the names of a foreign bag."""

import pytest
from refusals import refused

from mrlab_ros.adapters.bags.foreign import chosen_models, columns_of
from mrlab_ros.core.base.diagnostic import Fix
from mrlab_ros.core.base.errors import BadInput, Misuse
from mrlab_ros.core.recording.diagnostics import JOINTS_OF_TOPIC, NO_SUCH_JOINTS, SEVERAL_MODELS

ARM = ("base_joint", "elbow_joint")
MODELS = {"small": ARM, "big": ARM, "long": (*ARM, "wrist_joint"), "other": ("axis_1", "axis_2")}


@pytest.mark.parametrize(
    ("names", "columns"),
    [
        (["base_joint", "elbow_joint"], [0, 1]),
        (["finger", "elbow_joint", "base_joint"], [2, 1]),
        (["left_elbow_joint", "left_base_joint", "right_base_joint"], [1, 0]),
        (["cell/base_joint", "cell/elbow_joint"], [0, 1]),
        (["left_base_joint", "right_elbow_joint"], None),
        (["database_joint", "dataelbow_joint"], None),  # no prefix, other words
        ([], None),
    ],
)
def test_names_are_found_in_any_order_and_below_a_prefix(names, columns):
    assert columns_of(ARM, names) == columns


def test_the_names_alone_decide_where_one_robot_has_them():
    topics = {"/joint_states": ["axis_2", "axis_1"], "/pan_tilt": ["pan", "tilt"]}
    assert chosen_models([], MODELS, topics) == {"/joint_states": "other"}
    long = {"/joint_states": [*ARM, "wrist_joint"]}
    assert chosen_models([], MODELS, long) == {"/joint_states": "long"}


def test_names_of_several_robots_need_a_choice():
    with refused(SEVERAL_MODELS, Misuse, models=["small", "big"]) as caught:
        chosen_models([], MODELS, {"/joint_states": list(ARM)})
    assert caught.value.diagnostic.fixes == (Fix("robot", "small"),)
    assert chosen_models(["big"], MODELS, {"/a": list(ARM)}) == {"/a": "big"}
    two = {"/a": list(ARM), "/b": list(ARM)}
    assert chosen_models(["big", "small"], MODELS, two) == {"/a": "big", "/b": "small"}


def test_an_asked_robot_that_is_not_there_is_named_with_what_is():
    with refused(JOINTS_OF_TOPIC, BadInput, topic="/a", joints=["pan"]):
        chosen_models(["other"], MODELS, {"/a": ["pan"]})
    with refused(NO_SUCH_JOINTS, BadInput, model="other", found=[]):
        chosen_models(["other"], MODELS, {})
