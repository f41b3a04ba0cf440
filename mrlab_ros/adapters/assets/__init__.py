"""What clients draw the lab with: files that may be served, and documents made of the lab."""
