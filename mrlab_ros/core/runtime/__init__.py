"""How the processes of a lab live side by side."""
