"""MR-Lab: a mixed-reality robotics laboratory without robots."""
