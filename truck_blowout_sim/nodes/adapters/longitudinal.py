"""Speed and acceleration wishes turned into throttle and brake pressure. Knows nothing of ROS.

References: drive force = throttle * power / speed - (1 - throttle) * engine drag, as in
`physics/driveline.py`; brakes as in `brake_curve.py`.
Known limits: road grade and tire drag are left to the feedback on speed.
"""

from __future__ import annotations

from dataclasses import dataclass

from truck_blowout_sim.nodes.adapters.brake_curve import BrakeCurve, brake_curve
from truck_blowout_sim.vehicle import Vehicle

_LOWEST_SPEED_MPS = 1.0
_ROLLING = 0.006  # resistance per weight of warm truck tires, for the feed-forward alone


@dataclass(frozen=True)
class SpeedController:
    """Proportional speed control with feed-forward of the wanted acceleration.

    Attributes:
        mass_kg: whole vehicle.
        power_w: at full throttle.
        max_force_n: of the drive at low speed.
        drag_n: of the engine with the throttle closed.
        brakes: braking force over control pressure.
        gravity_mps2: of the road.
        gain_ps: acceleration per speed error.
        max_deceleration_mps2: what is asked of the brakes at most.
    """

    mass_kg: float
    power_w: float
    max_force_n: float
    drag_n: float
    brakes: BrakeCurve
    gravity_mps2: float
    gain_ps: float = 0.5
    max_deceleration_mps2: float = 6.0

    def pedals(
        self, speed_mps: float, wanted_mps: float, wanted_mps2: float = 0.0
    ) -> tuple[float, float]:
        """Throttle (0..1) and control pressure for all brakes (Pa).

        Args:
            speed_mps: now.
            wanted_mps: speed to reach.
            wanted_mps2: acceleration that goes with it.
        """
        acceleration = wanted_mps2 + self.gain_ps * (wanted_mps - speed_mps)
        force_n = self.mass_kg * acceleration + self._rolling_n()
        if force_n >= -self.drag_n:
            return self._throttle(force_n, speed_mps), 0.0
        deceleration = min(-(force_n + self.drag_n) / self.mass_kg, self.max_deceleration_mps2)
        return 0.0, self.brakes.pressure_pa(deceleration * self.mass_kg)

    def _rolling_n(self) -> float:
        return _ROLLING * self.mass_kg * self.gravity_mps2

    def _throttle(self, force_n: float, speed_mps: float) -> float:
        full_n = min(self.power_w / max(speed_mps, _LOWEST_SPEED_MPS), self.max_force_n)
        throttle = (force_n + self.drag_n) / (full_n + self.drag_n)
        return max(0.0, min(1.0, throttle))


def speed_controller(vehicle: Vehicle) -> SpeedController:
    """A controller for a vehicle, from its masses, driveline and brakes."""
    bodies_kg = sum(
        unit.body.mass_kg + sum(block.mass_kg for block in unit.payload.values())
        for unit in vehicle.unit_specs.values()
    )
    axles_kg = sum(axle.mass_kg for axle in vehicle.spec.axles.values())
    driveline = vehicle.spec.driveline
    return SpeedController(
        mass_kg=bodies_kg + axles_kg,
        power_w=driveline.power_w,
        max_force_n=driveline.max_force_n,
        drag_n=driveline.drag_n,
        brakes=brake_curve(vehicle),
        gravity_mps2=vehicle.road.gravity_mps2,
    )
