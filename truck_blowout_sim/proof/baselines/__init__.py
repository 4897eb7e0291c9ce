"""What else one could do with the same recordings: rivals of the diagnosis, each kept plain."""
