"""What is written and drawn on bodies: the designation, type plates, labels of axes, warnings.

Drawn with Pillow's own open typeface, four times as large as in the picture. Heights are pixels.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from materials import STEEL
from PIL import Image, ImageDraw, ImageFont
from solids import Array

from mrlab_ros.adapters.robots.packing.surfaces import Material

FINE = 4  # times as large
INK = (24, 24, 27)
PAPER = (240, 240, 236)
YELLOW = (250, 200, 10)
PLATE = (188, 190, 194)
Colour = tuple[int, int, int]


def name(text: str, height: int, ground: Material) -> Array:
    """Return the designation, on the paint of its casting."""
    dark = _is_dark(ground)
    size = round(height * FINE * 1.02)
    stroke = max(size // 42, 1)
    font = _font(size)
    left, top, right, bottom = font.getbbox(text, stroke_width=stroke)
    image = Image.new("RGB", (right - left + size // 8, height * FINE), _colour(ground))
    ImageDraw.Draw(image).text(
        (size // 16 - left, (height * FINE - top - bottom) // 2),
        text,
        font=font,
        fill=PAPER if dark else INK,
        stroke_width=stroke,
        stroke_fill=PAPER if dark else INK,
    )
    return _small(image)


def axis(number: int, way: str, height: int, ground: Material) -> Array:
    """Return the label of an axis with an arrow to both senses of its turning.

    way: where its positive sense is seen: "left" (against the clock), "right", or "ahead",
    "back", "up", "down" for an arrow that stands across the axis.
    """
    side = height * FINE
    turns = way in ("left", "right")
    upright = way in ("up", "down")
    image = Image.new("RGB", (side, side), _colour(ground))
    draw = ImageDraw.Draw(image)
    edge = side // 40
    draw.rounded_rectangle(
        (edge, edge, side - edge, side - edge), side // 9, fill=PAPER, outline=INK, width=edge
    )
    low, high = side * 0.17, side * 0.83
    wide = max(side // 17, 1)
    if turns:
        box = (low, low, high, high)
        draw.arc(box, 200, 340, fill=INK, width=wide)
        radius = (high - low) / 2 - wide / 2
        tips = [_on_arc(side / 2, radius, angle) for angle in (200, 340)]
        ways = [_on_arc(0, 1, 200 - 90), _on_arc(0, 1, 340 + 90)]
        signs = "+-" if way == "left" else "-+"
        marks = [(side * 0.2, side * 0.73), (side * 0.8, side * 0.73)]
        text = (side * 0.5, side * 0.6)
    elif upright:
        x = side * 0.24
        draw.line((x, low + wide, x, high - wide), fill=INK, width=wide)
        tips, ways = [(x, low + wide), (x, high - wide)], [(0.0, -1.0), (0.0, 1.0)]
        signs = "+-" if way == "up" else "-+"
        marks = [(side * 0.45, side * 0.19), (side * 0.45, side * 0.81)]
        text = (side * 0.64, side * 0.5)
    else:
        y = side * 0.27
        draw.line((low + wide, y, high - wide, y), fill=INK, width=wide)
        tips, ways = [(low + wide, y), (high - wide, y)], [(-1.0, 0.0), (1.0, 0.0)]
        signs = "+-" if way == "ahead" else "-+"
        marks = [(side * 0.2, side * 0.5), (side * 0.8, side * 0.5)]
        text = (side * 0.5, side * 0.66)
    for tip, (dx, dy), mark, sign in zip(tips, ways, marks, signs, strict=True):
        long, half = side * 0.11, side * 0.075
        x, y = tip
        draw.polygon(
            [
                (x + dx * long, y + dy * long),
                (x - dy * half, y + dx * half),
                (x + dy * half, y - dx * half),
            ],
            fill=INK,
        )
        _sign(draw, mark, sign, side * 0.055, wide)
    font = _font(round(side * 0.32))
    draw.text(text, f"A{number}", font=font, fill=INK, anchor="mm", stroke_width=side // 90)
    return _small(image)


def pinch(height: int, ground: Material) -> Array:
    """Return a yellow warning triangle: moving parts."""
    side = height * FINE
    image = Image.new("RGB", (side, side), _colour(ground))
    draw = ImageDraw.Draw(image)
    middle = side / 2
    for shrink, colour in ((0.0, INK), (0.13, YELLOW)):
        tall = side * (0.8 - 1.5 * shrink)
        low = side * (0.88 - shrink / 2)
        half = tall / np.sqrt(3)
        draw.polygon(
            [(middle - half, low), (middle + half, low), (middle, low - tall)], fill=colour
        )
    draw.polygon(
        [
            (middle - side * 0.05, side * 0.4),
            (middle + side * 0.05, side * 0.4),
            (middle + side * 0.028, side * 0.63),
            (middle - side * 0.028, side * 0.63),
        ],
        fill=INK,
    )
    r = side * 0.042
    draw.ellipse((middle - r, side * 0.72 - r, middle + r, side * 0.72 + r), fill=INK)
    return _small(image)


def plate(figures: dict[str, Any], height: int) -> Array:
    """Return the type plate: what robot.yaml states of the robot."""
    tall = height * FINE
    wide = tall * 8 // 5
    image = Image.new("RGB", (wide, tall), PLATE)
    draw = ImageDraw.Draw(image)
    edge = tall // 40
    draw.rectangle((edge, edge, wide - edge - 1, tall - edge - 1), outline=INK, width=edge // 2)
    for x in (0.045, 0.955):
        for y in (0.08, 0.92):
            r = tall * 0.022
            draw.ellipse(
                (x * wide - r, y * tall - r, x * wide + r, y * tall + r), fill=(120, 122, 126)
            )
    head = _font(round(tall * 0.16))
    while head.getlength(figures["product"]) > wide * 0.8:
        head = _font(round(head.size) - 1)
    draw.text((wide * 0.5, tall * 0.17), figures["product"], font=head, fill=INK, anchor="mm",
              stroke_width=tall // 180)  # fmt: skip
    draw.line((wide * 0.07, tall * 0.3, wide * 0.93, tall * 0.3), fill=INK, width=edge // 2)
    moving = [joint for joint in figures["joints"] if joint["type"] in ("revolute", "continuous")]
    lines = [
        ("Family", figures["family"]),
        ("Payload", f"{figures['payload']:g} kg"),
        ("Reach", f"{figures['reach'] * 1000:.0f} mm"),
        ("Axes", f"{len(moving)}"),
    ]
    font = _font(round(tall * 0.115))
    for row, (label, value) in enumerate(lines):
        y = tall * (0.405 + 0.135 * row)
        draw.text((wide * 0.08, y), label, font=font, fill=INK, anchor="lm")
        draw.text((wide * 0.37, y), value, font=font, fill=INK, anchor="lm")
    return _small(image)


PLATE_FINISH: Material = STEEL


def _sign(
    draw: ImageDraw.ImageDraw, at: tuple[float, float], sign: str, half: float, wide: int
) -> None:
    x, y = at
    draw.line((x - half, y, x + half, y), fill=INK, width=wide)
    if sign == "+":
        draw.line((x, y - half, x, y + half), fill=INK, width=wide)


def _on_arc(middle: float, radius: float, degrees: float) -> tuple[float, float]:
    angle = np.radians(degrees)
    return (middle + radius * float(np.cos(angle)), middle + radius * float(np.sin(angle)))


def _font(size: int) -> ImageFont.FreeTypeFont:
    font = ImageFont.load_default(size)
    if not isinstance(font, ImageFont.FreeTypeFont):
        raise RuntimeError("Pillow has no FreeType here: install a wheel of it")
    return font


def _colour(material: Material) -> Colour:
    red, green, blue = (round(value * 255) for value in material.colour)
    return red, green, blue


def _is_dark(material: Material) -> bool:
    return sum(material.colour) / 3 < 0.4


def _small(image: Image.Image) -> Array:
    size = (image.width // FINE, image.height // FINE)
    return np.asarray(image.resize(size, Image.Resampling.BOX))
