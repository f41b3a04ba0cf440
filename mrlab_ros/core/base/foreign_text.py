"""Makes text from outside fit for where it is shown: a name in a file may hold what acts there.

Control characters reach a terminal as commands (colours, the clipboard, other lines), and
characters that turn the direction of writing show another text than there is. Both are written as
JSON writes them, such as \\u001b: they are seen, and JSON stays the same JSON.
"""

from __future__ import annotations

import html
import json
import re
import shlex

# C0 and C1 controls, the soft hyphen, overrides of direction, line and paragraph
# separators, invisible operators, tags; not the joiners that Persian and emoji are written with
ACTING = (
    "\x00-\x1f\x7f-\x9f\xad\u115f\u1160\u180e\u200b\u2028-\u202e\u2060-\u206f"
    "\u3164\ufeff\uffa0\ufff0-\ufffb\ud800-\udfff\U000e0000-\U000e0fff"
)
ANY = re.compile(f"[{ACTING}]")
BUT_LINES = re.compile(f"(?![\\n\\t])[{ACTING}]")
# Text that a table program computes, also where another character than the comma parts the cells
FORMULA = re.compile("(^|[;\t\r\n])([\\s\"']*)(?=[=+\\-@\uff1d\uff0b\uff0d\uff20])")


def visible(text: str) -> str:
    """Return a text on one line, in which nothing acts on a terminal."""
    return ANY.sub(_written, text)


def visible_lines(text: str) -> str:
    """Return a text whose lines stay lines, in which nothing else acts on a terminal."""
    return BUT_LINES.sub(_written, text)


def file_name(path: object) -> str:
    """Return a path or a name as text; each byte that is no UTF-8 becomes a replacement sign.

    JSON, pages and tables take text only.
    """
    return str(path).encode("utf-8", "surrogateescape").decode("utf-8", "replace")


def for_html(text: str) -> str:
    """Return a text as the content of an element or a quoted attribute."""
    return html.escape(visible_lines(text))


def for_table(text: str) -> str:
    """Return a text as a cell of CSV that no table program computes; a ' makes it a text.

    Nothing in it acts on a terminal that shows the file.
    """
    return FORMULA.sub(r"\1\2'", visible_lines(text))


def for_shell(words: list[str]) -> str:
    """Return the command line of these words, to be copied into a shell."""
    return " ".join(map(_word, words))


def _word(word: str) -> str:
    shown = visible(word)
    if shown == word:
        return shlex.quote(word)
    quoted = ANY.sub(_of_bash, word.replace("\\", "\\\\").replace("'", "\\'"))
    return f"$'{quoted}'"


def _of_bash(found: re.Match[str]) -> str:
    code = ord(found[0])
    # a byte of a file's name that is no UTF-8
    return f"\\x{code - 0xDC00:02x}" if 0xDC80 <= code <= 0xDCFF else f"\\U{code:08x}"


def _written(found: re.Match[str]) -> str:
    return json.dumps(found[0])[1:-1]
