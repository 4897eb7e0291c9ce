"""One page with the figures and tables that were asked for."""

from __future__ import annotations

from collections.abc import Sequence

from truck_blowout_sim.report.page import render
from truck_blowout_sim.report.style import Picture
from truck_blowout_sim.report.thesis.tables import Table


def thesis_page(pictures: Sequence[Picture], tables: Sequence[Table]) -> str:
    """The page as text."""
    return render("thesis.html", {"pictures": pictures, "tables": tables})
