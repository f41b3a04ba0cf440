"""States of a grasp and the load that it carries."""
