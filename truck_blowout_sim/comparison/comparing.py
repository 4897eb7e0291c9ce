"""Drive the model with a recording's inputs and measure how it differs.

References: ISO/TS 18571:2024 for the ratings; V. Chakravarthy, Ohio State University, 2013,
chapter 4, for the figures that a comparison of a blowout test consists of.
Known limits: the initial state comes from the first second, so a recording that begins in a
manoeuvre carries its error along; position errors grow with time whatever the model.
Validated with: test/comparison/test_comparing.py.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from truck_blowout_sim.comparison.contrast import Contrast, contrast
from truck_blowout_sim.comparison.driving import STEP_S, in_table_order, side_by_side
from truck_blowout_sim.comparison.errors import ChannelError, channel_error
from truck_blowout_sim.comparison.noise import channel_sigmas
from truck_blowout_sim.comparison.pairing import Pair, pairs_of
from truck_blowout_sim.comparison.provenance import Marks, marks_of
from truck_blowout_sim.comparison.words import labels_for
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import INPUT_NAMES, Recording, read_recording
from truck_blowout_sim.recordings.channels import UNITS
from truck_blowout_sim.recordings.gravity import gravity_is_removed
from truck_blowout_sim.recordings.shipped import find_recording
from truck_blowout_sim.vehicle import Vehicle, load_vehicle
from truck_blowout_sim.vehicle.given import AnyVehicle, packed_of

# Instruments on one clock begin, and mark a blowout, within a few of their samples.
_SAME_START_S = 0.1
THE_MODEL = "the model"
DEFAULT_VEHICLE = "international_9400i_trailmobile"
Progress = Callable[[str, float], None]


@dataclass(frozen=True, eq=False)
class Comparison:
    """A recording and the model's answer to its inputs.

    Attributes:
        recording, model: as measured, as simulated.
        vehicle: the model's vehicle.
        speed_imposed: the recorded speed was imposed, as asked or for want of other inputs.
        pairs: both side by side, by channel.
        channels: errors in the order of the channel table.
        marks: for a record rebuilt from text, what each sample is (by channel); else empty.
        notes: what was assumed on the way.
        contrast: what other vehicles reach on the same record; None where it was not asked for.
        against: what the record is held against, in words: the model, or another recording.
    """

    recording: Recording
    model: Recording
    vehicle: Vehicle
    speed_imposed: bool
    pairs: Mapping[str, Pair]
    channels: tuple[ChannelError, ...]
    marks: Mapping[str, Marks]
    notes: tuple[str, ...]
    contrast: Contrast | None = None
    against: str = THE_MODEL

    @property
    def of_recordings(self) -> bool:
        """Whether ``model`` is another recording and no model ran."""
        return self.against != THE_MODEL

    @property
    def other(self) -> str:
        """What figures call the side that is held against the record."""
        return self.against if self.of_recordings else "model"

    def __getitem__(self, name: str) -> ChannelError:
        return next(channel for channel in self.channels if channel.name == name)

    def __contains__(self, name: object) -> bool:
        return any(channel.name == name for channel in self.channels)

    @property
    def interval_s(self) -> tuple[float, float]:
        """First and last instant that was compared, on the recording's clock."""
        pairs = self.pairs.values()
        return min(p.time_s[0] for p in pairs), max(p.time_s[-1] for p in pairs)

    @property
    def mean_rating(self) -> float | None:
        """Mean overall rating of the measured channels that have one and were not imposed."""
        rated = [
            c.rating.overall
            for c in self.channels
            if c.rating and not c.imposed and c.name in self.recording
        ]
        return float(np.mean(rated)) if rated else None


def compare(recording: Recording | str | os.PathLike[str],
            vehicle: AnyVehicle = DEFAULT_VEHICLE, *, step_s: float = STEP_S,
            impose_speed: bool | None = None, contrasted: bool = False,
            ask: Callable[[Sequence[str]], None] | None = None,
            progress: Progress | None = None) -> Comparison:  # fmt: skip
    """Drive a vehicle's model with a recording's inputs and report the differences.

    Args:
        recording: a recording, a path to one, or the name of one that ships with the package.
        vehicle: a vehicle, its packed parameters, a path, or the name of a shipped one.
        step_s: step of the simulation [s].
        impose_speed: make the model follow the recorded speed; ``None``: only where throttle or a
            brake pressure was not recorded.
        contrasted: also drive other vehicles, to see whether the rating tells vehicles apart.
        ask: told before the run what in the input no truck does (nothing, mostly); may raise.
        progress: called with what is being done and the share that is done, 0 to 1.

    Raises:
        InputError: unreadable files, no steering in the recording, no channel in common.
    """
    tell = progress or _silent
    packed = packed_of(vehicle)
    tell("reading", 0.0)
    recording, marks = _recording(recording, packed.vehicle)
    tell("simulating", 0.1)
    driven = side_by_side(recording, packed, step_s=step_s, impose_speed=impose_speed, ask=ask)
    recording, pairs = driven.recording, driven.pairs
    channels = _errors(recording, packed.vehicle, pairs, driven.imposed, tell)
    tell("contrasting", 0.9)
    others = (contrast(recording, pairs, packed.vehicle.name, impose_speed) if contrasted
              else None)  # fmt: skip
    tell("done", 1.0)
    return Comparison(recording, driven.model, packed.vehicle, driven.speed_imposed, pairs,
                      channels, marks, _notes(recording, driven.model), others)  # fmt: skip


def compare_recordings(first: Recording | str | os.PathLike[str],
                       second: Recording | str | os.PathLike[str], *,
                       vehicle: Vehicle | str | os.PathLike[str] = DEFAULT_VEHICLE,
                       progress: Progress | None = None) -> Comparison:  # fmt: skip
    """Hold two recordings against each other, on the clock they share, without a model.

    Args:
        first: what counts as measured.
        second: what is held against it.
        vehicle: names the hubs and tires.
        progress: called with what is being done and the share that is done, 0 to 1.

    Raises:
        InputError: unreadable files, or no output channel in common at common times.
    """
    tell = progress or _silent
    loaded = vehicle if isinstance(vehicle, Vehicle) else load_vehicle(vehicle)
    (one, marks), (other, _) = _recording(first, loaded), _recording(second, loaded)
    pairs = pairs_of(one, other)
    if not pairs:
        raise InputError(f"no output channel in common with {other.name}", file=one.name,
                         expected="a channel that both recorded at common times")
    channels = _errors(one, loaded, pairs, (), tell)
    tell("done", 1.0)
    notes = (*one.notes, *other.notes, *_clocks_apart(one, other))
    return Comparison(one, other, loaded, False, pairs, channels, marks, notes, None, other.name)


def _clocks_apart(one: Recording, other: Recording) -> tuple[str, ...]:
    """A note where nothing shows that two recordings are on one clock."""
    theirs = {event.time_s for event in other.blowouts}
    on_one_clock = any(abs(event.time_s - time_s) < _SAME_START_S
                       for event in one.blowouts for time_s in theirs)  # fmt: skip
    if on_one_clock or abs(one.start_s - other.start_s) < _SAME_START_S:
        return ()
    return (f"the clocks start at different instants, {one.start_s:g} s in {one.name} and"
            f" {other.start_s:g} s in {other.name}: no shift was applied",)  # fmt: skip


def _errors(recording: Recording, vehicle: Vehicle, pairs: Mapping[str, Pair],
            imposed: Collection[str], tell: Progress) -> tuple[ChannelError, ...]:
    """Errors of all pairs in the order of the channel table."""
    sigmas = channel_sigmas(recording)
    labels = labels_for(vehicle)
    found = []
    for k, name in enumerate(in_table_order(pairs, vehicle)):
        tell("measuring " + labels.get(name, name), 0.4 + 0.5 * k / len(pairs))
        found.append(channel_error(pairs[name], labels.get(name, name),
                                   sigmas.get(name), imposed=name in imposed))  # fmt: skip
    return tuple(found)


def _recording(recording: Recording | str | os.PathLike[str], vehicle: Vehicle
               ) -> tuple[Recording, Mapping[str, Marks]]:  # fmt: skip
    if isinstance(recording, Recording):
        return recording, {}
    path = find_recording(recording)
    read = read_recording(path, tires=vehicle.tires, hubs=vehicle.hubs)
    return read, marks_of(path, read)


def _notes(recording: Recording, model: Recording) -> tuple[str, ...]:
    notes = recording.notes + model.notes
    if "rebuilt" in recording.metadata.get("origin", ""):
        notes += (f"the record is {recording.metadata['origin']}",)
    if any(gravity_is_removed(recording, unit) for unit in UNITS):
        notes += ("accelerations are compared without gravity, as the recording gives them",)
    strange = sorted(set(recording.channels) - set(model.channels) - set(INPUT_NAMES))
    if strange:
        notes += (f"not compared, this vehicle has no such part: {', '.join(strange)}",)
    return notes


def _silent(stage: str, share: float) -> None:
    """Say nothing."""
