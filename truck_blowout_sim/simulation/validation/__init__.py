"""The model held against published figures, and against what any sound simulation must give."""

from truck_blowout_sim.simulation.validation.rows import Row
from truck_blowout_sim.simulation.validation.table import MODES, as_markdown, validate

__all__ = ["MODES", "Row", "as_markdown", "validate"]
