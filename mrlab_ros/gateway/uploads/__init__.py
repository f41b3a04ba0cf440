"""Files that people send, and what becomes of them."""
