"""The truck as an FMU (FMI 3.0, co-simulation): `python -m truck_blowout_sim.fmu`."""

from truck_blowout_sim.fmu.build import build_fmu

__all__ = ["build_fmu"]
