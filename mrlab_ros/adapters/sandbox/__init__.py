"""Reads files from outside in processes that can open nothing else, and bounds what they print."""
