"""Where the files of installed packages lie, which a sandbox lets its process read."""

from __future__ import annotations

from mrlab_ros.adapters import installed


def test_what_left_the_source_tree_since_it_was_built_is_no_place(tmp_path, monkeypatch):
    tree, prefix = tmp_path / "tree", tmp_path / "prefix"
    share = prefix / "share" / "arm"
    index = prefix / "share" / "ament_index" / "resource_index" / "packages"
    for folder in (tree / "meshes", share, index):
        folder.mkdir(parents=True)
    (index / "arm").touch()
    for name in ("package.xml", "meshes/link.stl"):
        (tree / name).touch()
    (share / "package.xml").symlink_to(tree / "package.xml")
    (share / "link.stl").symlink_to(tree / "meshes" / "link.stl")
    (share / "gone.stl").symlink_to(tree / "gone" / "gone.stl")
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(prefix))
    assert set(installed.packages()) == {share, tree / "meshes", tree / "package.xml"}
