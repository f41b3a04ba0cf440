"""Recordings and their replay; no graph and no file here."""
