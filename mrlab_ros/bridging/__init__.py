"""The parts of the bridge node: what goes out, what comes in, services, the crossing between."""
