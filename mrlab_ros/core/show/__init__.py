"""What a page needs to show a motion or a recorded session."""
