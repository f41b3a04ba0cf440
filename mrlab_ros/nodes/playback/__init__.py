"""The playback host, and the playback node of each robot."""
