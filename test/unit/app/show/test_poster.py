"""Pictures of robots, drawn as points with a depth buffer."""

import numpy as np
import trimesh

from mrlab_ros.adapters.robots import drawing
from mrlab_ros.app.show.poster import SIZE, picture


def box(colour, at):
    made = trimesh.creation.box((1, 1, 1))
    made.apply_translation(at)
    made.visual.face_colors = colour
    return made


def test_what_is_nearer_hides_what_is_behind_and_nothing_has_holes():
    red, blue = box((255, 0, 0, 255), 4 * drawing.VIEW), box((0, 0, 255, 255), (0, 0, 0))
    drawn = picture([blue, red]).astype(int)
    assert drawn.shape == (SIZE, SIZE, 3)
    inner = slice(SIZE // 3, 2 * SIZE // 3)
    assert (drawn[inner, inner, 0] > drawn[inner, inner, 2] + 30).all()


def test_the_corners_stay_white():
    drawn = picture([trimesh.creation.icosphere(subdivisions=2)])
    assert (drawn[:8, :8] == 255).all()
    assert np.ptp(drawn) > 100
