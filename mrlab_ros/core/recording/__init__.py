"""What is recorded and how a recording is played again; no graph and no file here."""
