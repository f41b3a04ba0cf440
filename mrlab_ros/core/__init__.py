"""The pure core: standard library and numpy only; time is always an argument."""
