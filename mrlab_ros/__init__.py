"""MR-Lab: a mixed-reality robotics laboratory without robots."""

# As in setup.py and package.xml; a test compares them.
__version__ = "0.1.0"
