"""What every room of the core uses; it imports no other room."""
