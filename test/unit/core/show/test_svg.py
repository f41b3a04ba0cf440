"""Plots as SVG."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from mrlab_ros.core.show.svg import HEIGHT, WIDTH, Mark, Strip, strip_svg, time_axis_svg

TIMES = np.linspace(0, 4, 401)
SVG = "{http://www.w3.org/2000/svg}"


def parse(text):
    return ET.fromstring(text.replace("<svg ", '<svg xmlns="http://www.w3.org/2000/svg" ', 1))


def by_class(root, name):
    return [e for e in root.iter() if name in str(e.get("class")).split()]


def draw(values, **options):
    return parse(strip_svg(Strip("elbow <1>", "deg", values, **options), TIMES, 4.0))


def test_the_line_lies_within_the_strip():
    (line,) = by_class(draw(np.sin(TIMES) * 90), "line")
    points = np.array([p.split(",") for p in line.get("points").split()], float)
    assert len(points) == 401
    assert (points >= 0).all()
    assert (points <= [WIDTH, HEIGHT]).all()


def test_a_gap_parts_the_line():
    values = np.sin(TIMES)
    values[100:120] = np.nan
    assert len(by_class(draw(values), "line")) == 2


def test_only_a_limit_that_comes_near_is_drawn():
    values = np.sin(TIMES) * 90
    assert by_class(draw(values, limits=(-1000, 1000)), "forbidden") == []
    (forbidden,) = by_class(draw(values, limits=(-1000, 80)), "forbidden")
    assert float(forbidden.get("height")) > 0
    assert "limit 80 deg" in "".join(draw(values, limits=(-1000, 80)).itertext())


def test_a_finding_is_marked_with_its_number_where_it_applies():
    mark = Mark(3, "error", 1.0, 2.0)
    root = draw(np.sin(TIMES), marks=(mark,))
    (group,) = [e for e in root.iter() if e.get("data-finding")]
    assert group.get("data-finding") == "3"
    (span,) = by_class(root, "range")
    left, width = float(root.get("data-left")), float(root.get("data-width"))
    assert float(span.get("x")) == pytest.approx(left + width / 4, abs=1.1)
    assert float(span.get("width")) == pytest.approx(width / 4, abs=2.1)


def test_a_long_series_keeps_its_peaks():
    times = np.linspace(0, 4, 100_000)
    values = np.zeros(100_000)
    values[54_321] = 5.0
    text = strip_svg(Strip("a", "m", values), times, 4.0)
    (line,) = by_class(parse(text), "line")
    heights = [float(p.split(",")[1]) for p in line.get("points").split()]
    assert len(heights) < 1500
    assert min(heights) < HEIGHT / 4
    assert max(heights) > 3 * HEIGHT / 4


@pytest.mark.parametrize(
    "values", [np.full(401, np.nan), np.zeros(401), np.full(401, 1e9)], ids=["none", "0", "large"]
)
def test_any_values_can_be_drawn(values):
    assert draw(values).get("aria-label").startswith("elbow <1>")


def test_nothing_but_attributes_styles_it():
    """A style attribute is what the page's security policy forbids."""
    text = strip_svg(Strip("a", "deg", np.sin(TIMES)), TIMES, 4.0) + time_axis_svg(4.0)
    assert not re.search(r"\bstyle=", text)


def test_the_axis_of_time_says_seconds():
    assert "".join(parse(time_axis_svg(4.0)).itertext()).startswith("0 s")


@pytest.mark.parametrize(
    ("begin", "duration", "texts"),
    [
        (0.0, 4.0, ["0 s", "1", "2", "3", "4"]),
        (90.0, 60.0, ["1:30 min", "1:40", "1:50", "2:00", "2:10", "2:20", "2:30"]),
        (3600.0, 4.0, ["1:00:00 h", "1:00:01", "1:00:02", "1:00:03", "1:00:04"]),
        (0.0, 7200.0, ["0:00:00 h", "0:20:00", "0:40:00", "1:00:00", "1:20:00", "1:40:00",
                       "2:00:00"]),
        (0.0, 0.0, ["0 s"]),
    ],
)  # fmt: skip
def test_an_axis_of_time_shows_seconds_or_what_a_clock_does(begin, duration, texts):
    axis = parse(time_axis_svg(duration, begin=begin))
    assert [text.text for text in axis.iter(f"{SVG}text")] == texts
