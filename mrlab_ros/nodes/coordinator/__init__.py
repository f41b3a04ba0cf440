"""The coordinator node, the members that it commands, and what it checks first."""
