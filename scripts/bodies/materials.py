"""What bodies are made of: one table for robots, tools and things.

Colours are sRGB, the reflected colour of a metal, the scattered one of everything else; metalness
is 0 or 1, as nothing is between. docs/faces.md says where the rows come from.
"""

from __future__ import annotations

from mrlab_ros.adapters.robots.packing.surfaces import Material

# KUKA's paints by their RAL numbers: 2003, 9005, 9010. Black is drawn as bright as it looks in a
# lit room: what the paint alone scatters, 1 %, shows no form on a screen.
ORANGE = Material("orange", (0.965, 0.471, 0.157), 0.0, 0.32)
BLACK = Material("black", (0.165, 0.167, 0.175), 0.0, 0.38)
WHITE = Material("white", (0.905, 0.895, 0.865), 0.0, 0.3)
GREY = Material("grey", (0.33, 0.335, 0.345), 0.0, 0.42)
# Universal Robots' lids, tubes and housings, from the colours of their description.
UR_BLUE = Material("ur_blue", (0.49, 0.678, 0.8), 0.0, 0.36)
UR_SILVER = Material("ur_silver", (0.8, 0.81, 0.82), 1.0, 0.38)
UR_DARK = Material("ur_dark", (0.278, 0.278, 0.285), 0.0, 0.4)
# Metals: aluminium anodised, steel turned and ground, iron blackened, zinc hot-dipped.
LIGHT_GREY = Material("light_grey", (0.8, 0.805, 0.815), 1.0, 0.44)
STEEL = Material("steel", (0.74, 0.735, 0.73), 1.0, 0.28)
IRON = Material("iron", (0.44, 0.45, 0.47), 1.0, 0.5)
ZINC = Material("zinc", (0.7, 0.715, 0.73), 1.0, 0.55)
COPPER = Material("copper", (0.93, 0.66, 0.52), 1.0, 0.32)
# Carbon black in rubber scatters 2 % of the light.
RUBBER = Material("rubber", (0.15, 0.15, 0.155), 0.0, 0.78)
BELT = Material("belt", (0.17, 0.2, 0.19), 0.0, 0.6)
YELLOW = Material("yellow", (0.945, 0.72, 0.08), 0.0, 0.36)
RED = Material("red_lacquer", (0.72, 0.09, 0.08), 0.0, 0.2)
BLUE = Material("blue_plastic", (0.13, 0.32, 0.62), 0.0, 0.42)
PORCELAIN = Material("porcelain", (0.9, 0.895, 0.88), 0.0, 0.14)
GLAZE = Material("blue_glaze", (0.1, 0.23, 0.44), 0.0, 0.16)
CLAY = Material("clay", (0.78, 0.74, 0.68), 0.0, 0.85)
GLASS = Material("green_glass", (0.13, 0.36, 0.2), 0.0, 0.05, 0.62)
PAPER = Material("paper", (0.9, 0.88, 0.82), 0.0, 0.8)
WOOD = Material("wood", (0.74, 0.585, 0.4), 0.0, 0.72)
WOOD_DARK = Material("wood_dark", (0.64, 0.48, 0.31), 0.0, 0.76)
BEECH = Material("beech", (0.82, 0.68, 0.5), 0.0, 0.42)
SKIN = Material("figure", (0.36, 0.42, 0.5), 0.0, 0.75)
