"""Which wheel lags: the hub at which a drag acts, where no known drag acts there.

A wheel that is held back turns slower than it rolls freely, by its drag over its slip stiffness.
What is left of a hub's speed after everything named is fitted with a share of that speed, in
training and while nothing brakes; the gain of its tachometer, which baseline runs hold, and all
other nuisances are projected out. Hubs that a blown tire or something named holds are not asked.
Where the wheel on the other side of the axle lags alike, it is no matter of one wheel: the speed of
the model, or a drag of the whole axle, is a little off.

References: wheel slip under a drive or brake force (Pacejka 2012, chapter 1); as `scatter.py`.
Known limits: without baseline runs a lag is a gain of the tachometer, and nothing is said; hubs
that were not recorded cannot lag.
Validated with: test/diagnosis/test_lagging.py (a hub that is held back is named, and by how much).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.quantiles import NINETY
from truck_blowout_sim.diagnosis.case.runs import Run
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.effects.hypothesis import Hypothesis
from truck_blowout_sim.diagnosis.fit.one_channel import (
    ChannelChange,
    Weighed,
    ask_channel,
    asked_of,
)
from truck_blowout_sim.diagnosis.fit.scatter import Scatter
from truck_blowout_sim.vehicle import Vehicle

# 1 sigma of a rolling radius from truck to truck, half of it from day to day: 3 % of load or
# pressure move a deflection of 25 mm by 0.8 mm, the radius of 0.5 m by a third of that
_RADIUS = 0.001
_SHARED = 0.5  # of its lag: what the opposite wheel has of it where it is no matter of one wheel
_DOUBT = 0.05  # share of drags that may be called a wheel's: asked only where a drag is named


@dataclass(frozen=True)
class Lag:
    """A wheel that turns slower than the model, everything named in force, lets it roll.

    Attributes:
        slip: share of its speed by which it lags; ``sigma`` its standard error.
        evidence: its support, see `scatter.py`.
    """

    hub: str
    slip: float
    sigma: float
    evidence: float

    @property
    def equation(self) -> str:
        """For an engineer."""
        return (f"omega({self.hub}) = (1 - {self.slip:.5f}) * omega of the model  "
                f"(+- {NINETY * self.sigma:.5f}, 90 %)")

    @property
    def sentence(self) -> str:
        """For a driver."""
        return (f"What drags acts at hub {self.hub}: its wheels turn {1000.0 * self.slip:.1f} per "
                "mille slower than they roll freely, as a dragging brake or a seizing bearing "
                "would have it, and none of the known drags.")

    @property
    def next_test(self) -> str:
        """What would find its cause."""
        return (f"Drive without braking and compare the temperature of hub {self.hub} with that of "
                "the others; then turn its wheels by hand, off the ground.")


def lagging_wheel(study: Study, named: Sequence[Hypothesis], scatter: Scatter) -> Lag | None:
    """The wheel that lags most clearly, where a drag is named and one lags beyond chance.

    Study's models have ``named`` in force; ``scatter``: of the case.
    """
    if not any(h.effect.drags for h in named):
        return None
    vehicle, left = study.packed.vehicle, Weighed.of(study, named)
    taken = {h.place.hub for h in named} | {
        vehicle.hub_of_tire(tire) for i in study.train
        for event in study.runs[i].recording.blowouts for tire in event.tires}
    asked = {hub: one for hub in vehicle.hubs if hub not in taken and (one := ask_channel(
        study, left, scatter, f"hub_speed_{hub}_radps",
        lambda run, mean: mean * _free(run), _RADIUS))}
    least = asked_of(_DOUBT, len(asked))
    behind = [Lag(hub, -one.score.amount, one.score.sigma, one.support)
              for hub, one in asked.items() if one.score.amount < 0.0 and one.support > least
              and not _shared(vehicle, hub, asked)]
    return max(behind, key=lambda lag: lag.evidence, default=None)


def _shared(vehicle: Vehicle, hub: str, asked: Mapping[str, ChannelChange]) -> bool:
    """Whether another wheel of the axle lags alike."""
    axle, lag = vehicle.axle_of_hub(hub), asked[hub].score.amount
    return any(other != hub and vehicle.axle_of_hub(other) == axle
               and one.score.amount / lag >= _SHARED for other, one in asked.items())


def _free(run: Run) -> NDArray[np.bool_]:
    """Bins in which no brake is applied."""
    rows = np.clip(((run.edges_s - run.drive.initial.time_s) / run.drive.step_s).astype(np.int64),
                   0, run.drive.inputs.shape[0] - 1)
    pressed = np.asarray(run.braked.any(axis=1))
    return ~np.asarray(pressed[rows[:-1]] | pressed[rows[1:]])
