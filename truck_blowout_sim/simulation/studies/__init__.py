"""Many runs of one scenario in which keys of its files vary."""

from truck_blowout_sim.simulation.studies.batch import Batch, open_batch, simulate_batch
from truck_blowout_sim.simulation.studies.cases import Row, Study
from truck_blowout_sim.simulation.studies.design import Axis, grid, parse_axis, sample

__all__ = ["Axis", "Batch", "Row", "Study", "grid", "open_batch", "parse_axis", "sample",
           "simulate_batch"]
