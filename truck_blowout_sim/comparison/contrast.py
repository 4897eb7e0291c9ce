"""Whether a rating tells vehicles apart: what other vehicles reach on the same record.

A high rating says little where a quite different vehicle has nearly the same one.

Known limits: the other vehicles are those that ship with the package; channels that one of them
lacks are left out for all.
Validated with: test/comparison/test_contrast.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from truck_blowout_sim.comparison.errors import rating_of
from truck_blowout_sim.comparison.pairing import Pair, pairs_of
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation.replay import simulate_inputs
from truck_blowout_sim.vehicle import load_vehicle

CONTRASTED = ("rigid_truck", "international_9400i_trailmobile", "ferrari_250lm")
CHANNELS = ("tractor_vx_mps", "tractor_yaw_rate_radps", "tractor_ay_mps2", "trailer_yaw_rate_radps",
            "tractor_across_m")  # fmt: skip
STEP_S = 0.002


@dataclass(frozen=True)
class Contrast:
    """Mean rating of the model and of other vehicles over the same channels.

    Attributes:
        rating: of the vehicle that was compared.
        others: of others, by name, best first.
        channels: that were rated.
    """

    rating: float
    others: Mapping[str, float]
    channels: tuple[str, ...]

    @property
    def separates(self) -> bool:
        """Whether every other vehicle is rated at least one grade (0.1) lower."""
        return all(self.rating - other >= 0.1 for other in self.others.values())


def contrast(recording: Recording, pairs: Mapping[str, Pair], vehicle: str,
             impose_speed: bool | None) -> Contrast | None:  # fmt: skip
    """Drive other vehicles with the same inputs and rate them.

    Args:
        recording: the record.
        pairs: the compared vehicle's channels beside it.
        vehicle: its name, which is left out of the others.
        impose_speed: as in `compare`.

    Returns:
        None where nothing can be rated, or no other vehicle can be driven.
    """
    own = _ratings(pairs, CHANNELS)
    others: dict[str, Mapping[str, Pair]] = {}
    for name in CONTRASTED:
        if name == vehicle:
            continue
        other = load_vehicle(name)
        events = tuple(event for event in recording.blowouts if set(event.tires) <= {*other.tires})
        try:
            model = simulate_inputs(other, replace(recording, blowouts=events), step_s=STEP_S,
                                    impose_speed=impose_speed)  # fmt: skip
        except InputError:  # it cannot be driven so, or leaves the range of its model
            continue
        others[name] = pairs_of(recording, model)
    ratings = {name: _ratings(found, tuple(own)) for name, found in others.items()}
    common = [c for c in own if all(c in one for one in ratings.values())]
    if not common or not ratings:
        return None
    means = {name: _mean(one, common) for name, one in ratings.items()}
    best_first = dict(sorted(means.items(), key=lambda item: -item[1]))
    return Contrast(_mean(own, common), best_first, tuple(common))


def _ratings(pairs: Mapping[str, Pair], names: Sequence[str]) -> dict[str, float]:
    rated = {name: rating_of(pairs[name]) for name in names if name in pairs}
    return {name: rating.overall for name, rating in rated.items() if rating is not None}


def _mean(ratings: Mapping[str, float], names: Sequence[str]) -> float:
    return float(np.mean([ratings[name] for name in names]))
