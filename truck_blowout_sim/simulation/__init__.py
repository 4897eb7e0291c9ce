"""Time: a truck to hold and step, scenarios, drivers, replay of recordings, batches."""

from truck_blowout_sim.simulation.batch import run_batch
from truck_blowout_sim.simulation.drive import Drive, run_drive
from truck_blowout_sim.simulation.equilibrium import InitialState
from truck_blowout_sim.simulation.inputs import Inputs
from truck_blowout_sim.simulation.replay import drive_from, simulate_inputs
from truck_blowout_sim.simulation.run import prepare, simulate
from truck_blowout_sim.simulation.scenario import Scenario, load_scenario, scenario_names
from truck_blowout_sim.simulation.studies import Batch, open_batch, simulate_batch
from truck_blowout_sim.simulation.truck import Truck

__all__ = [
    "Batch",
    "Drive",
    "InitialState",
    "Inputs",
    "Scenario",
    "Truck",
    "drive_from",
    "load_scenario",
    "open_batch",
    "prepare",
    "run_batch",
    "run_drive",
    "scenario_names",
    "simulate",
    "simulate_batch",
    "simulate_inputs",
]
