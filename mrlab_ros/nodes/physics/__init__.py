"""The physics node, what it receives and what it publishes."""
