"""Where simulation and recording differ: locate it, name what is missing, show the fit improve."""

from truck_blowout_sim.diagnosis.calibrate import (
    Calibration,
    calibrate,
    write_calibrated_vehicle,
)
from truck_blowout_sim.diagnosis.case.fingerprints import simulation_key
from truck_blowout_sim.diagnosis.case.resume import Kept, keeping
from truck_blowout_sim.diagnosis.diagnose import diagnose, write_diagnosed_vehicle
from truck_blowout_sim.diagnosis.effort import QUICK, THOROUGH, USUAL, Effort
from truck_blowout_sim.diagnosis.result import Diagnosis, write_diagnosis

__all__ = ["QUICK", "THOROUGH", "USUAL", "Calibration", "Diagnosis", "Effort", "Kept", "calibrate",
           "diagnose", "keeping", "simulation_key", "write_calibrated_vehicle",
           "write_diagnosed_vehicle", "write_diagnosis"]
