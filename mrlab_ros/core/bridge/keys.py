"""The zenoh keys of topics and services. Apart: commands need no more of the bridge than this."""


def key_of(name: str, prefix: str = "") -> str:
    """Return the zenoh key of a topic or service name, such as ur5e_1/joint_states."""
    return f"{prefix}{name}" if prefix else name[1:]
