"""Drive a truck with a recording's inputs and hold it beside the record, without judging it.

Whoever needs no more than the size of the errors asks :func:`rms_errors`: lags and ratings take ten
times as long as the simulation.

Validated with: test/comparison/test_driving.py.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from truck_blowout_sim.comparison.pairing import Pair, pairs_of
from truck_blowout_sim.comparison.resets import longest_run
from truck_blowout_sim.comparison.words import labels_for
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation.plausible import implausible
from truck_blowout_sim.simulation.rates import check_delays
from truck_blowout_sim.simulation.replay import drive_from, replayed
from truck_blowout_sim.vehicle import Packed, Vehicle

STEP_S = 0.001
_IMPOSED = "tractor_vx_mps"  # the channel that an imposed speed follows


@dataclass(frozen=True, eq=False)
class SideBySide:
    """A record and the truck that was driven with its inputs.

    Attributes:
        recording: the part that was driven, without resets of the clock.
        model: as simulated; ``pairs``: both by channel.
        speed_imposed: the recorded speed was imposed.
    """

    recording: Recording
    model: Recording
    pairs: Mapping[str, Pair]
    speed_imposed: bool

    @property
    def imposed(self) -> frozenset[str]:
        """Channels that the model was made to follow, so that their errors say nothing."""
        return frozenset({_IMPOSED} if self.speed_imposed else ())


def side_by_side(recording: Recording, packed: Packed, *, step_s: float = STEP_S,
                 impose_speed: bool | None = None,
                 ask: Callable[[Sequence[str]], None] | None = None) -> SideBySide:
    """Drive a truck with a recording's inputs.

    Args:
        recording: as measured; ``packed``: the truck.
        step_s, impose_speed, ask: as in :func:`truck_blowout_sim.comparison.compare`.

    Raises:
        InputError: no steering in the recording, no channel in common.
    """
    check_delays(packed, step_s)
    recording = longest_run(recording)
    drive = drive_from(recording, packed.vehicle, step_s=step_s, impose_speed=impose_speed)
    if ask:
        ask(implausible(packed, drive))
    model = replayed(recording, packed, drive)
    pairs = pairs_of(recording, model)
    if not pairs:
        raise InputError("no output channel to compare", file=recording.name,
                         expected="at least one of " + ", ".join(list(model.channels)[:12]))
    return SideBySide(recording, model, pairs, bool(drive.speed.size))


def rms_errors(recording: Recording, packed: Packed, *, impose_speed: bool | None = None
               ) -> Mapping[str, float]:
    """Rms error of every channel in which the truck was free, as ``compare`` has it; SI."""
    driven = side_by_side(recording, packed, impose_speed=impose_speed)
    return {name: driven.pairs[name].rms for name in in_table_order(driven.pairs, packed.vehicle)
            if name not in driven.imposed}


def in_table_order(names: Iterable[str], vehicle: Vehicle) -> list[str]:
    """Channels in the order of the channel table; those that it lacks come last."""
    order = {name: k for k, name in enumerate(labels_for(vehicle))}
    return sorted(names, key=lambda name: order.get(name, len(order)))
