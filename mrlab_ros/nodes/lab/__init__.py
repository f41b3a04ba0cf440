"""The lab node, its scenes and what it restores."""
