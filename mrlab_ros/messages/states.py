"""States of what has published none. Apart: a command needs no more of the messages than this."""

from mrlab_msgs import msg


def unknown_state() -> msg.PlaybackState:
    """Return what stands for the state of a playback that has not published one."""
    return msg.PlaybackState(label="?")
