"""Commands that act on a running lab: play, robots, systems, scenes, recording, replay."""
