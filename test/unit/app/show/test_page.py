"""One HTML file: its policy, its data, and that nothing breaks out of it."""

import base64
import hashlib
import json
import re
import struct
import zlib

import numpy as np

from mrlab_ros.app.show import still_text
from mrlab_ros.app.show.packed import packed
from mrlab_ros.app.show.page import Code, Picture, page

CODE = Code(b"const text = '</script>'", "body { color: red }</style>")


def block(text, name):
    found = re.search(rf'<script type="text/plain" id="{name}">(.*?)</script>', text, re.S)
    return zlib.decompress(base64.b64decode(found.group(1)))


def test_the_data_comes_back_and_equal_meshes_are_stored_once():
    meshes = {"package://a.glb": b"one" * 99, "package://b.glb": b"two", "c": b"one" * 99}
    text = page("t", "", {"schema": "x"}, meshes, CODE)
    data = block(text, "data")
    (length,) = struct.unpack_from("<I", data)
    head = json.loads(data[4 : 4 + length])
    assert head["document"] == {"schema": "x"}
    for uri, (offset, size) in head["meshes"].items():
        assert data[4 + length + offset :][:size] == meshes[uri]
    assert len(data) == 4 + length + 300
    assert block(text, "code") == CODE.script


def test_the_policy_trusts_its_own_script_and_style_alone():
    text = page("t", "", {}, {}, CODE)
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', text).group(1)
    assert "default-src 'none'" in policy
    assert "unsafe" not in policy
    assert "http" not in policy
    scripts = re.findall(r"<script>(.*?)</script>", text, re.S)
    styles = re.findall(r"<style>(.*?)</style>", text, re.S)
    for content in (*scripts, *styles):
        digest = base64.b64encode(hashlib.sha256(content.encode()).digest()).decode()
        assert f"'sha256-{digest}'" in policy
    assert (len(scripts), len(styles)) == (1, 1)
    assert not re.search(r'<[^>]* (style|on\w+)="', text)


def test_what_a_file_says_cannot_become_markup():
    evil = "<script>alert(1)</script>\"'"
    array = packed(np.zeros((3, 1)), "float32")
    document = {
        "title": evil, "verdict": "refused", "message": evil, "frame_rate": 10.0,
        "times": None, "rows": None, "positions": array, "gripper": None,
        "velocities": None, "effort_proxies": None,
        "robot": {
            "model": evil, "end_effector": evil, "urdf": evil,
            "joints": [
                {"name": evil, "kind": "revolute", "lower": None, "upper": None, "velocity": None}
            ],
        },
        "findings": [
            {
                "severity": "error", "code": "c", "message": evil, "remedy": evil,
                "variable": evil, "first_row": 2, "last_row": 3, "joint": evil, "value": None,
                "limit": None, "unit": "", "link": evil,
                "fixes": [{"option": "", "value": "", "matlab": evil}],
            }
        ],
        "source": {"file": evil, "variable": evil, "sha256": ""},
    }  # fmt: skip
    text = page(evil, still_text.motion(document), document, {}, CODE, [Picture("data:,", evil)])
    assert "<script>alert" not in text
    assert text.count("<script") == 3


def test_no_text_of_the_document_turns_the_direction_of_writing_and_arrays_stay():
    document = {"title": "\u202etxet", "findings": [{"message": "a\u200b"}], "data": "\u202e"}
    data = block(page("t", "", document, {}, CODE), "data")
    (length,) = struct.unpack_from("<I", data)
    shown = json.loads(data[4 : 4 + length])["document"]
    assert shown["title"] == "\\u202etxet"
    assert shown["findings"][0]["message"] == "a\\u200b"
    assert shown["data"] == "\u202e"
