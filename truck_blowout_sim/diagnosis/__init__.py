"""Where simulation and recording differ: locate it, name what is missing, show the fit improve."""

from truck_blowout_sim.diagnosis.diagnose import diagnose, write_diagnosed_vehicle
from truck_blowout_sim.diagnosis.fingerprints import simulation_key
from truck_blowout_sim.diagnosis.result import Diagnosis, write_diagnosis
from truck_blowout_sim.diagnosis.resume import Kept, keeping

__all__ = ["Diagnosis", "Kept", "diagnose", "keeping", "simulation_key",
           "write_diagnosed_vehicle", "write_diagnosis"]
