"""The law of what has no name."""
