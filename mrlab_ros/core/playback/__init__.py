"""The playback of one robot: states, clock and stream."""
