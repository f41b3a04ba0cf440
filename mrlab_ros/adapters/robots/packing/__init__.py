"""Whole robots as one packed glTF file each: light baked into vertices, colours in one picture."""
