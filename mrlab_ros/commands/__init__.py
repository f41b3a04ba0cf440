"""The commands of `mrlab` that are more than a call."""
