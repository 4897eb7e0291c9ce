"""What foreign commands become: a road-wheel angle and a speed wish, onto the truck's inputs."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from truck_blowout_sim.nodes.adapters.longitudinal import speed_controller
from truck_blowout_sim.nodes.steering_gear import hand_wheel_rad
from truck_blowout_sim.vehicle.places import hub_places

if TYPE_CHECKING:
    from truck_blowout_sim.nodes.simulator_node import Simulator

_BRAKES = ("brake_pressure_steer_pa", "brake_pressure_drive_pa", "brake_pressure_trailer_pa")


class ForeignCommands:
    """Feeds the simulator's inputs, with their checks, warnings and timeouts.

    Args:
        simulator: whose inputs are fed.
    """

    def __init__(self, simulator: Simulator) -> None:
        vehicle = simulator.plant.vehicle
        self._simulator = simulator
        self._inputs = {topic.guarded.name: topic for topic in simulator.commands}
        self._controller = speed_controller(vehicle)
        names = list(simulator.plant.output_names)
        self._speed = names.index("tractor_vx_mps")
        steered = [place.hub for place in hub_places(vehicle) if place.steered]
        self._steer = [names.index(f"{hub}_steer_rad") for hub in steered]

    @property
    def speed_mps(self) -> float:
        """Forward speed of the front unit."""
        return float(self._simulator.plant.outputs()[self._speed])

    @property
    def steer_rad(self) -> float:
        """Mean angle of the steered road wheels."""
        outputs = self._simulator.plant.outputs()
        return float(outputs[self._steer].mean()) if self._steer else 0.0

    def steer(self, steer_rad: float) -> None:
        """Apply a mean road-wheel angle alone."""
        self._inputs["steering_wheel_angle_rad"].take(
            hand_wheel_rad(self._simulator.plant.vehicle, steer_rad)
        )

    def take(self, steer_rad: float, speed_mps: float, acceleration_mps2: float = 0.0) -> None:
        """Apply a command.

        Args:
            steer_rad: mean road-wheel angle, left positive.
            speed_mps: wanted speed.
            acceleration_mps2: wanted acceleration, 0 if none was given.
        """
        if not self._simulator.plant.ready:
            return  # the truck is not there yet: nothing to control
        if not all(map(math.isfinite, (speed_mps, acceleration_mps2))):
            # neither pedal follows from it: refused as one command, the last good one holds
            self._inputs["throttle"].take(math.nan)
            return
        throttle, brake_pa = self._controller.pedals(self.speed_mps, speed_mps, acceleration_mps2)
        self.steer(steer_rad)
        self._inputs["throttle"].take(throttle)
        for name in _BRAKES:
            topic = self._inputs[name]
            topic.take(min(brake_pa, topic.guarded.high))
