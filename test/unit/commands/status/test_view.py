"""The window of `mrlab status` on more lines than the terminal has."""

from __future__ import annotations

from rich.console import Console
from rich.text import Text

from mrlab_ros.commands.status.view import DOWN, PAGE_DOWN, PAGE_UP, UP, Scroll

HEIGHT = 6


def shown(scroll: Scroll, console: Console) -> list[str]:
    with console.capture() as capture:
        console.print(scroll)
    return capture.get().splitlines()


def test_keys_move_the_window_and_never_beyond_its_lines():
    console = Console(width=60, height=HEIGHT)
    scroll = Scroll(console, None)
    scroll.take(Text("\n".join(f"line {n}" for n in range(1, 21))))
    assert shown(scroll, console) == [
        *(f"line {n}" for n in range(1, 6)),
        "lines 1 to 5 of 20; arrows scroll, q ends",
    ]
    for key, first in ((DOWN, 2), (PAGE_DOWN, 6), (UP, 5), (PAGE_UP, 1), (UP, 1), (b"x", 1)):
        scroll.press(key)
        assert shown(scroll, console)[0] == f"line {first}", key
    for _ in range(9):
        scroll.press(b" ")
    assert shown(scroll, console)[-2:] == [
        "line 20",
        "lines 16 to 20 of 20; arrows scroll, q ends",
    ]
    scroll.press(b"q")
    assert scroll.ended


def test_what_fits_has_no_window():
    console = Console(width=60, height=HEIGHT)
    scroll = Scroll(console, None)
    scroll.press(DOWN)
    scroll.take(Text("one\ntwo"))
    assert shown(scroll, console) == ["one", "two"]
