"""From the description of a case with the car to its recordings and its answer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from proving_ground.build import CaseBuilder, Values
from proving_ground.car.channels import columns, ideal
from proving_ground.car.effects import combine
from proving_ground.car.individual import draw
from proving_ground.car.manoeuvres import CarDriver, make
from proving_ground.car.rig import CarRig, CarTruth
from proving_ground.cases import CaseSpec
from proving_ground.effects.base import Active
from proving_ground.instruments import without_gravity
from proving_ground.layout import Commands, FloatArray
from proving_ground.task import Manoeuvre

HEADER = (
    "vehicle: BMW 320i, multi-body model of commonroad-vehicle-models, parameter set 2",
    "hub_names: front_left front_right rear_left rear_right",
    "tractor_base_link: center of gravity, 1.156 m behind the front axle, 0.614 m above the road",
    "tilt: roll and pitch are against the true horizontal; pitch nose-down positive",
    "filters: rates, accelerations, velocities zero-phase 20 Hz; hub speeds zero-phase 10 Hz; "
    "100 Hz sampling",
    "noise_1sigma_tractor: velocity 0.012 m/s, rate 0.02 deg/s, acceleration 0.03 m/s2, "
    "tilt 0.02 deg, heading 0.04 deg, position 0.02 m",
    "noise_1sigma_other: hub speed 0.2 %",
    "throttle: force at the rear wheels = throttle x 110 kW / speed",
    "brakes: 2 bar a m/s2, 66 % in front",
    "road: proving ground, taken as level and dry",
)


class _Again:
    """Commands of an earlier run."""

    def __init__(self, truth: CarTruth) -> None:
        self._rows = np.vstack([truth.lead_in, truth.commands])
        self._next = 0

    def act(self, time_s: float, x: float, y: float, heading: float, yaw_rate: float,
            speed: float) -> Commands:
        """The next row; the last one is held."""
        row = self._rows[min(self._next, len(self._rows) - 1)]
        self._next += 1
        return Commands(*map(float, row))


class CarBuilder(CaseBuilder):
    """One case with the car: its individual, its runs, its calibrated severities."""

    header: tuple[str, ...] = HEADER
    vehicle = "bmw_320i"
    # Camber changes its sign with a step in the foreign tires: both roll rates chatter.
    unsteady = ("tractor_roll_rate", "tractor_ay")

    def _make_rigs(self, spec: CaseSpec) -> None:
        car = draw(spec.seed)
        self._car, self._even_car = CarRig(car), CarRig(replace(car, bumps_seed=0))

    def _channels(self) -> list[str]:
        return columns()

    def _manoeuvres(self, spec: CaseSpec) -> list[tuple[str, Manoeuvre, int]]:
        return [(name, make(kind, seed), seed) for name, kind, seed in spec.runs()]

    def _drive(self, manoeuvre: Manoeuvre, actives: list[Active], seed: int,
               even: bool = False) -> CarTruth:
        rig = self._even_car if even else self._car
        return rig.drive(manoeuvre, *combine(actives), CarDriver(manoeuvre, seed))

    def _replay(self, truth: CarTruth, actives: list[Active], even: bool = True) -> CarTruth:
        rig = self._even_car if even else self._car
        return rig.drive(truth.manoeuvre, *combine(actives), _Again(truth))

    def clean(self, truth: CarTruth) -> Values:
        """Ideal channels, with gravity taken out where this car's instruments do so."""
        values = ideal(truth)
        return without_gravity(values) if self.level else values

    def _front_m(self, truth: CarTruth) -> FloatArray:
        return np.asarray(truth.states[:, 0] + truth.car.car["a"])
