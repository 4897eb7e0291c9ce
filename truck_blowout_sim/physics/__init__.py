"""What a truck does: compiled scalar code over the named layout, one small file per phenomenon."""
