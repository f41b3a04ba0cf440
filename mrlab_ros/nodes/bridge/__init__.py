"""The bridge node and its routes between the graph and zenoh."""
