"""Tables of text: headings, cells, instants of time."""
