"""Exports of submissions, and the processes that check them."""
