"""Unseen runs, instants, intervals, the run to drive next."""
