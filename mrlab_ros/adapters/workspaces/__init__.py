"""Files with joint motion: MATLAB workspaces, tables and messages."""
