"""From the variables of a file to a checked trajectory."""
