"""The figures and tables of the 2013 thesis, by number, from our own runs and sheets."""

from truck_blowout_sim.report.thesis.book import FIGURES, Entry, figure_picture
from truck_blowout_sim.report.thesis.tables import TABLES, Table, thesis_table

__all__ = ["FIGURES", "TABLES", "Entry", "Table", "figure_picture", "thesis_table"]
