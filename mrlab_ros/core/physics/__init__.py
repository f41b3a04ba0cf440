"""The physics of the lab without an engine: rules, states and the world that keeps them."""
