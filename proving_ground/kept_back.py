"""What no case of development has: laws, instruments and maneuvers kept back for sealed draws.

Cases of a world from number `FROM` on belong to sealed draws. Their runs are of kinds that no other
case of a world has; a third of them each gets a tire family, a law of the suspension and an
instrument set of its own. A method that learned from a sealed draw has seen its forms: draws from
`LATER` on have others.

References: Dugoff, Fancher, Segel, SAE 700377 (1970), and Burckhardt, Fahrwerktechnik:
Radschlupf-Regelsysteme (1993) (tires); Fancher, Ervin, MacAdam, Winkler, SAE 800905 (1980) (leaf
springs whose friction grows with the load); Dixon, The Shock Absorber Handbook (2007) (a valve
that opens); SAE J1939-71 (resolutions on a truck's bus; rates and noise are judgement).
Known limits: the truck of W1 and the car of W3 keep their tires and suspension, rough logs their
instruments; the answer of a case states what was drawn.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from proving_ground.channels import RATE_HZ
from proving_ground.instruments import DEG
from proving_ground.laws import BLOW_OFF, BURCKHARDT, DUGOFF, LEAF, Laws
from proving_ground.layout import FloatArray

FROM, LATER, SEEDS_A_WORLD = 480_000, 489_600, 1_000_000
FIRST_WORLD_SEED = 2_000_000
SHARE = 1.0 / 3.0
GNSS_HZ = 10.0
SERIES_NOISE = {"_radps": 0.1 * DEG, "_mps2": 0.12}   # one sigma of a series vehicle's unit
# On the bus: what a channel's name begins or ends with, its resolution, seconds between messages.
# Wheel speeds to 1/16 km/h over half a meter of radius.
BUS = {"hub_speed_": (1.0 / 16.0 / 3.6 / 0.5, 0.1), "brake_chamber_": (8000.0, 0.1),
       "tire_pressure_": (4000.0, 1.0), "_vx_mps": (1.0 / 256.0 / 3.6, 0.1),
       "_yaw_rate_radps": (1.0 / 8192.0, 0.01), "_ay_mps2": (1.0 / 2048.0, 0.01)}
BUS_NOISE = {"_radps": 0.07 * DEG, "_mps2": 0.08}   # one sigma of a stability control's unit
KINDS: dict[str, tuple[str, ...]] = {
    "blowout": ("blowout_pull_over", "blowout_quick_hands"),
    "quick steer": ("swerve_and_return", "growing_triangles", "lift_in_turn", "tightening_turn"),
    "hard steer": ("hard_tightening", "hard_swerve"),
    "steer": ("tightening_turn", "lift_in_turn", "swerve_and_return", "growing_triangles"),
    "small steer": ("slow_drift", "growing_triangles"),
    "kingpin": ("slow_drift", "tightening_turn", "growing_triangles"),
    "limit": ("braking_taper", "braking_added", "hard_tightening", "hard_swerve"),
    "brake": ("braking_added", "braking_taper"),
    "coast": ("roll_and_dabs", "dragging_brake"),
    "straight": ("dragging_brake", "roll_and_dabs", "braking_taper"),
    "any": ("dragging_brake", "growing_triangles", "slow_drift", "roll_and_dabs"),
}


def sealed(seed: int) -> bool:
    """Whether a case's number is one of the sealed draws."""
    return seed >= FIRST_WORLD_SEED and seed % SEEDS_A_WORLD >= FROM


def later(seed: int) -> bool:
    """Whether it is of a draw with the later forms."""
    return sealed(seed) and seed % SEEDS_A_WORLD >= LATER


@dataclass(frozen=True)
class KeptBack:
    """Which of the things kept back a case has; `later`: of the later forms."""

    tire: bool = False
    suspension: bool = False
    instruments: bool = False
    later: bool = False

    @classmethod
    def of(cls, seed: int) -> KeptBack:
        """Drawn once per case; nothing outside the sealed draws."""
        if not sealed(seed):
            return cls()
        return cls(*(np.random.default_rng([seed, 151]).random(3) < SHARE).tolist(), later(seed))

    def as_dict(self) -> dict[str, bool | str]:
        """As an answer states it."""
        own = {"tire": self.tire, "suspension": self.suspension, "instruments": self.instruments}
        return {**own, "forms": "later"} if self.later else own

    def laws(self, laws: Laws) -> Laws:
        """The form of a truck with what was kept back."""
        if self.tire:
            laws = laws._replace(family=BURCKHARDT if self.later else DUGOFF)
        if self.suspension and self.later:
            return laws._replace(damper_law=BLOW_OFF)
        return laws._replace(friction_law=LEAF) if self.suspension else laws

    def reading(self, channel: str) -> Reading:
        """How the instruments kept back read a channel; as it is where the case has none."""
        if not self.instruments:
            return Reading()
        return (bus_reading if self.later else series_reading)(channel)

    def read(self, readings: dict[str, FloatArray], seed: int) -> dict[str, FloatArray]:
        """Readings of the instruments kept back, where the case has them."""
        if not self.instruments:
            return readings
        rng = np.random.default_rng([seed, 157])
        return {channel: _read(self.reading(channel), signal, rng)
                for channel, signal in readings.items()}


class Reading(NamedTuple):
    """How a channel is read: further noise and step (SI), and one of how many samples."""

    sigma: float = 0.0
    step: float = 0.0
    every: int = 1


def series_reading(channel: str) -> Reading:
    """What a series vehicle's inertial unit beside a satellite receiver of 10 Hz reads."""
    slow = channel.endswith(("_x_m", "_y_m", "vx_mps", "vy_mps", "_yaw_rad"))
    return Reading(_sigma(channel, SERIES_NOISE), 0.0, round(RATE_HZ / GNSS_HZ) if slow else 1)


def bus_reading(channel: str) -> Reading:
    """What a truck's own bus carries of a channel: coarse, and not always fresh."""
    step, seconds = next((found for part, found in BUS.items()
                          if channel.startswith(part) or channel.endswith(part)),
                         (0.0, 1.0 / RATE_HZ))
    return Reading(_sigma(channel, BUS_NOISE), step, round(seconds * RATE_HZ))


def _sigma(channel: str, sigmas: dict[str, float]) -> float:
    return next((s for end, s in sigmas.items() if channel.endswith(end)), 0.0)


def _read(how: Reading, signal: FloatArray, rng: np.random.Generator) -> FloatArray:
    if how.sigma:
        signal = signal + how.sigma * rng.standard_normal(len(signal))
    if how.step:
        signal = how.step * np.round(signal / how.step)
    return _every(signal, how.every) if how.every > 1 else signal


def _every(signal: FloatArray, count: int) -> FloatArray:
    """One of so many samples; the others are missing."""
    return np.where(np.arange(len(signal)) % count != 0, np.nan, signal)
