"""Control pressure from a wanted braking force: a vehicle's brakes turned around. Without ROS.

References: torque of a hub = linear over - quadratic over^2, over = pressure - pushout, as in
`physics/brakes.py`; force = torque / tire radius.
Known limits: all circuits get one pressure; radii are those of unloaded tires, some 4 % too large;
fade, lag and the grip of the road are left to the feedback on speed.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.simulation.plausible import MOST_BRAKE_PA
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.schema.axle import BrakeSpec

FloatArray = NDArray[np.float64]
_POINTS = 100


@dataclass(frozen=True)
class BrakeCurve:
    """Braking force of a whole vehicle over the pressure in all its circuits.

    Attributes:
        pressures_pa: rising, from 0.
        forces_n: never falling.
    """

    pressures_pa: FloatArray
    forces_n: FloatArray

    def pressure_pa(self, force_n: float) -> float:
        """Least pressure that brakes with a force; the highest one where none does."""
        return float(np.interp(force_n, self.forces_n, self.pressures_pa))


def brake_curve(vehicle: Vehicle) -> BrakeCurve:
    """The curve of a vehicle, from its brakes and tire radii."""
    braked = _brakes_and_radii_m(vehicle)
    pushouts_pa = [brake.pushout_pa for brake, _ in braked]
    even_pa = np.linspace(0.0, MOST_BRAKE_PA[vehicle.spec.brakes], _POINTS)
    pressures_pa = np.union1d(even_pa, pushouts_pa)
    forces_n = np.zeros_like(pressures_pa)
    for brake, radius_m in braked:
        over_pa = np.maximum(pressures_pa - brake.pushout_pa, 0.0)
        torque_nm = brake.linear_nmppa * over_pa - brake.quadratic_nmppa2 * over_pa**2
        forces_n += np.maximum(torque_nm, 0.0) / radius_m
    return BrakeCurve(pressures_pa, np.maximum.accumulate(forces_n))


def _brakes_and_radii_m(vehicle: Vehicle) -> list[tuple[BrakeSpec, float]]:
    """Of each hub that has a brake."""
    found = []
    for hub in vehicle.hubs:
        brake = vehicle.spec.axles[vehicle.axle_of_hub(hub)].brake
        tires = [vehicle.tire_specs[tire] for tire in vehicle.tires_of_hub(hub)]
        if brake is not None:
            found.append((brake, max(tire.unloaded_radius_m for tire in tires)))
    return found
