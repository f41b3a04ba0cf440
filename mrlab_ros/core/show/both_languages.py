"""Sentences of a page in English, with the German ones beside them for its script to choose."""

from __future__ import annotations

from mrlab_ros.core.foreign_text import for_html as escape


def said(english: str, german: str) -> str:
    """Return a sentence in both languages."""
    return f'<span data-de="{escape(german)}">{escape(english)}</span>'


def german(value: float) -> str:
    """Return a number with three digits, and a comma for its point."""
    return f"{value:.3g}".replace(".", ",")
