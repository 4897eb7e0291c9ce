"""What no case of development has: laws, instruments and maneuvers kept back for sealed draws.

Cases of a world from number `FROM` on belong to sealed draws. Their runs are of kinds that no other
case of a world has; a third of them each gets a tire family, a law of friction in the suspension
and an instrument set of its own.

References: Dugoff, Fancher, Segel, SAE 700377 (1970) (tire); Fancher, Ervin, MacAdam, Winkler, SAE
800905 (1980) (leaf springs whose friction grows with the load).
Known limits: the truck of W1 and the car of W3 keep their tires and suspension, rough logs their
instruments; the answer of a case states what was drawn.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from proving_ground.channels import RATE_HZ
from proving_ground.instruments import DEG
from proving_ground.laws import DUGOFF, LEAF, Laws
from proving_ground.layout import FloatArray

FROM, SEEDS_A_WORLD = 480_000, 1_000_000
FIRST_WORLD_SEED = 2_000_000
SHARE = 1.0 / 3.0
GNSS_HZ = 10.0
SERIES_NOISE = {"_radps": 0.1 * DEG, "_mps2": 0.12}   # one sigma of a series vehicle's unit
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


@dataclass(frozen=True)
class KeptBack:
    """Which of the things kept back a case has."""

    tire: bool = False
    suspension: bool = False
    instruments: bool = False

    @classmethod
    def of(cls, seed: int) -> KeptBack:
        """Drawn once per case; nothing outside the sealed draws."""
        if not sealed(seed):
            return cls()
        return cls(*(np.random.default_rng([seed, 151]).random(3) < SHARE).tolist())

    def laws(self, laws: Laws) -> Laws:
        """The form of a truck with what was kept back."""
        return laws._replace(family=DUGOFF if self.tire else laws.family,
                             friction_law=LEAF if self.suspension else laws.friction_law)

    def read(self, readings: dict[str, FloatArray], seed: int) -> dict[str, FloatArray]:
        """What a series vehicle's inertial unit beside a satellite receiver of 10 Hz reads."""
        if not self.instruments:
            return readings
        rng, every, out = np.random.default_rng([seed, 157]), round(RATE_HZ / GNSS_HZ), {}
        for channel, signal in readings.items():
            sigma = next((s for end, s in SERIES_NOISE.items() if channel.endswith(end)), 0.0)
            out[channel] = signal + sigma * rng.standard_normal(len(signal)) if sigma else signal
            if channel.endswith(("_x_m", "_y_m", "vx_mps", "vy_mps", "_yaw_rad")):
                gone = np.arange(len(signal)) % every != 0
                out[channel] = np.where(gone, np.nan, signal)
        return out
