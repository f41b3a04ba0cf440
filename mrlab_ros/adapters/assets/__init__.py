"""Assets that clients draw the lab with: files that are served, documents made of the lab."""
