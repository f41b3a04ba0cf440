"""Robot models and their kinematics."""
