"""Figures and pages, drawn from finished results; nothing is computed here."""
