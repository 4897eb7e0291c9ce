"""Candidates, search, acceptance, aliases."""
