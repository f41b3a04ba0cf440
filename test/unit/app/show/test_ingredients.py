"""What goes into a page: the built code, and small meshes."""

from pathlib import Path

from refusals import refused

from mrlab_ros.adapters.diagnostics import REPORT_NOT_BUILT
from mrlab_ros.app.show import ingredients
from mrlab_ros.core.base.errors import BadInput

URDF = """<robot name="r"><link name="a">
<visual><geometry><mesh filename="package://p/here.glb"/></geometry></visual>
<visual><geometry><mesh filename="package://p/missing.glb"/></geometry></visual>
<collision><geometry><mesh filename="package://p/hull.stl"/></geometry></collision>
</link></robot>"""


def test_pages_that_are_not_built_are_said_to_be(tmp_path):
    with refused(REPORT_NOT_BUILT, BadInput):
        ingredients.code(tmp_path)


def test_a_missing_mesh_is_left_out():
    robots = Path(__file__).parents[4] / "robots"
    files = {
        "package://p/here.glb": robots / "ur5e" / "meshes" / "wrist_3_link.glb",
        "package://p/missing.glb": robots / "none.glb",
    }
    assert list(ingredients.meshes_of([URDF], files.__getitem__)) == ["package://p/here.glb"]
