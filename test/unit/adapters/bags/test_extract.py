"""A bag names its attachments, and may not choose where on the machine they are written."""

import pytest

from mrlab_ros.adapters.bags.extract import extract
from mrlab_ros.adapters.bags.reader import Bag
from mrlab_ros.adapters.bags.writer import BagWriter
from mrlab_ros.core.base.errors import BadInput

pytestmark = pytest.mark.fast


def bag_with(folder, *names):
    writer = BagWriter(folder / "class", lambda kind: ("", ""))
    for name in names:
        writer.attach(name, "text/plain", name.encode(), 0)
    writer.close()
    return Bag(folder / "class")


def everything(folder):
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*")}


def test_attachments_are_written_below_a_new_folder(tmp_path):
    names = ["meshes/arm/base.dae", "robots/a.urdf", "scene.json"]
    assert extract(bag_with(tmp_path, *names), tmp_path / "out") == names
    assert (tmp_path / "out/meshes/arm/base.dae").read_text() == "meshes/arm/base.dae"


@pytest.mark.parametrize(
    "name",
    [
        *("../evil", "a/../../evil", "/tmp/mrlab-evil", "..", "robots/.."),
        *(".bashrc", ".ssh/authorized_keys", "robots/.hidden", "robots//twice", "", "./a"),
        *("a\nb", "\x1b]52;c;ZXZpbA==\x07", "a\x00b", "a\u202eb", "n" * 300),
        *("scene.json/inside",),
    ],
)
def test_a_bag_that_names_another_place_is_refused_before_anything_is_written(name, tmp_path):
    bag = bag_with(tmp_path, "scene.json", name)
    before = everything(tmp_path)
    with pytest.raises(BadInput):
        extract(bag, tmp_path / "out")
    assert everything(tmp_path) == before


@pytest.mark.parametrize("kind", ["full", "file", "link"])
def test_what_is_there_already_is_not_touched(kind, tmp_path):
    bag, out = bag_with(tmp_path, "scene.json"), tmp_path / "out"
    (tmp_path / "mine").mkdir()
    {
        "full": lambda: (out.mkdir(), (out / "scene.json").write_text("mine")),
        "file": lambda: out.write_text("mine"),
        "link": lambda: out.symlink_to(tmp_path / "mine"),
    }[kind]()
    before = everything(tmp_path)
    with pytest.raises(BadInput):
        extract(bag, out)
    assert everything(tmp_path) == before
