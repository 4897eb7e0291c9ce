"""What every recording goes through after it was read: events, exclusions, origin of the map.

References: REP-103 (axes), REP-105 (map); rigid-body kinematics: v_b = v_s - w x r,
a_b = a_s - dw/dt x r - w x (w x r), with r from base_link to the instrument.
Validated with: test/recordings/test_mapping.py.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.errors import InputError, nearest, quoted
from truck_blowout_sim.recordings.blowout_words import ONCE, second_burst
from truck_blowout_sim.recordings.channels import DEFAULT_TIRES, UNITS
from truck_blowout_sim.recordings.mapping.clocks import CLOCK_START
from truck_blowout_sim.recordings.mapping.rules import Mount, Rules
from truck_blowout_sim.recordings.names import parts_of
from truck_blowout_sim.recordings.recording import Blowout, Recording, Series
from truck_blowout_sim.recordings.resets import reset_times_s, run_at
from truck_blowout_sim.recordings.topic_names import channels_on

FloatArray = NDArray[np.float64]

_OPTION = "--blow"
MAP_ORIGIN = "map_origin_m"
# A test track is not larger; what lies farther away is a coordinate of the earth (UTM).
_FARTHEST_M = 1.0e5
_SMOOTHED_S = 0.1


def with_blowouts(
    recording: Recording, events: Iterable[Blowout], *, tires: Iterable[str] = (),
    hubs: Iterable[str] = (), file: object = _OPTION,
) -> Recording:
    """A copy with further blowouts; that of a tire in the same run is moved to the new instant.

    Raises:
        InputError: an unknown tire, an instant outside the recording, or a tire that is added
            twice in the same run.
    """
    added = [_on_clock(event, recording) for event in events]
    parts = parts_of(recording.channels, hubs, tires)
    for event in added:
        for tire in event.tires:
            if not parts.knows_tire(tire):
                known = (*parts.tires, *DEFAULT_TIRES)
                raise InputError(f"unknown tire {quoted(tire)}", file=str(file),
                                 expected=nearest(tire, known))  # fmt: skip
        if not recording.start_s <= event.time_s <= recording.end_s:
            raise InputError(
                f"{'+'.join(event.tires)} at {event.time_s:g} s", file=str(file),
                expected=f"an instant of {recording.name},"
                f" {recording.start_s:g} s to {recording.end_s:g} s",
            )  # fmt: skip
    _check_once(added, recording, file)
    return replace(recording, blowouts=(*_not_moved(recording, added), *added))


def _check_once(added: Sequence[Blowout], recording: Recording, file: object) -> None:
    """Refuse a tire that is added twice in the same run; a reset begins another run."""
    resets_s = reset_times_s(recording.channels)
    if again := second_burst(added, lambda time_s: run_at(time_s, resets_s)):
        raise InputError(again[1], file=str(file), where="" if file == _OPTION else "key blowouts",
                         expected=ONCE)


def _not_moved(recording: Recording, added: Iterable[Blowout]) -> list[Blowout]:
    """Blowouts of tires for which none is added in the same run; a reset begins another run."""
    resets_s = reset_times_s(recording.channels)
    named = {(run_at(event.time_s, resets_s), tire) for event in added for tire in event.tires}
    return [Blowout(b.time_s, left) for b in recording.blowouts
            for left in [tuple(t for t in b.tires if (run_at(b.time_s, resets_s), t) not in named)]
            if left]  # fmt: skip


def _on_clock(event: Blowout, recording: Recording) -> Blowout:
    """An instant of the log's own absolute clock, on the recording's clock; each tire once."""
    tires, time_s = tuple(dict.fromkeys(event.tires)), event.time_s
    start_s = recording.metadata.get(CLOCK_START)
    if start_s and time_s > 0.5 * float(start_s) > recording.end_s:
        time_s -= float(start_s)
    return Blowout(time_s, tires)


def without_excluded(recording: Recording, rules: Rules) -> Recording:
    """A copy without the channels that the mapping excludes.

    Raises:
        InputError: one that the recording does not have, and the mapping does not name either.
    """
    named = {*rules.channels, *channels_on(rules.topics, recording.channels)}
    for name in rules.exclude:
        if name not in recording and name not in named:
            raise InputError(
                f"{quoted(name)} is not recorded", file=rules.file or "mapping",
                where="key exclude", expected=nearest(name, recording.channels),
            )  # fmt: skip
    return recording.without_channels(rules.exclude)


def with_local_origin(recording: Recording) -> Recording:
    """A copy whose positions begin near zero, where they are coordinates of the earth."""
    shift = {}
    for axis in ("x_m", "y_m"):
        units = [unit for unit in UNITS if f"{unit}_{axis}" in recording]
        firsts = [float(recording[f"{unit}_{axis}"].value[0]) for unit in units]
        if firsts and abs(firsts[0]) > _FARTHEST_M:
            shift[axis] = float(np.floor(firsts[0]))
    if not shift:
        return recording
    origin = (shift.get("x_m", 0.0), shift.get("y_m", 0.0))
    moved = {
        name: Series(recording[name].time_s, recording[name].value - shift[axis])
        for axis in shift
        for name in (f"{unit}_{axis}" for unit in UNITS)
        if name in recording
    }
    note = ("positions are coordinates of the earth: counted from"
            f" x {origin[0]:.0f} m, y {origin[1]:.0f} m")
    out = recording.with_channels(moved).with_metadata(
        **{MAP_ORIGIN: f"{origin[0]:.0f} {origin[1]:.0f}"})  # fmt: skip
    return replace(out, notes=(*recording.notes, note))


def without_planar_zeros(recording: Recording, foreign: Collection[str]) -> Recording:
    """A copy without numbers that planar odometry fills with zeros while the truck moves.

    Args:
        recording: what was read.
        foreign: channels that others recorded; a simulated truck's zeros are true.
    """
    dropped = []
    for unit in UNITS:
        moving = [f"{unit}_{stem}" for stem in ("vx_mps", "yaw_rad", "x_m")]
        moves = any(name in recording and np.ptp(recording[name].value) > 0.0 for name in moving)
        for stem in ("roll_rad", "pitch_rad", "roll_rate_radps", "pitch_rate_radps", "vy_mps",
                     "z_m"):  # fmt: skip
            name = f"{unit}_{stem}"
            series = recording.channels.get(name)
            constant = series is not None and len(series) > 10 and not series.value.any()
            if moves and constant and name in foreign:
                dropped.append(name)
    if not dropped:
        return recording
    note = ("exactly zero while the truck moves, so not measured (planar odometry):"
            f" {', '.join(dropped)}")
    return replace(recording.without_channels(dropped), notes=(*recording.notes, note))


def at_base_link(recording: Recording, mounts: Mapping[str, Mount]) -> Recording:
    """A copy in which velocities, accelerations and positions are those of ``base_link``."""
    for unit, mount in mounts.items():
        moved = _moved(recording, unit, (mount.x_m, mount.y_m, mount.z_m))
        words = f"{unit}: {', '.join(n.removeprefix(unit + '_') for n in moved) or 'nothing'} moved"
        note = (f"{words} from the instrument ({mount.x_m:g} m forward, {mount.y_m:g} m left,"
                f" {mount.z_m:g} m up) to base_link; rates that are not recorded count as zero")
        recording = replace(recording.with_channels(moved), notes=(*recording.notes, note))
    return recording


def _moved(recording: Recording, unit: str, arm: tuple[float, float, float]) -> dict[str, Series]:
    out: dict[str, Series] = {}
    for k, (velocity, acceleration) in enumerate(
        (("vx_mps", "ax_mps2"), ("vy_mps", "ay_mps2"), ("", "az_mps2"))
    ):
        for stem, term in ((velocity, _velocity), (acceleration, _acceleration)):
            name = f"{unit}_{stem}"
            if stem and name in recording:
                series = recording[name]
                extra = term(recording, unit, series.time_s, arm)[k]
                out[name] = Series(series.time_s, series.value - extra)
    if f"{unit}_yaw_rad" in recording and {f"{unit}_x_m", f"{unit}_y_m"} <= set(recording.channels):
        for k, axis in enumerate(("x_m", "y_m")):
            series = recording[f"{unit}_{axis}"]
            yaw = _interpolated(recording, f"{unit}_yaw_rad", series.time_s)
            ahead = (np.cos(yaw) * arm[0] - np.sin(yaw) * arm[1],
                     np.sin(yaw) * arm[0] + np.cos(yaw) * arm[1])  # fmt: skip
            out[f"{unit}_{axis}"] = Series(series.time_s, series.value - ahead[k])
    return out


def _velocity(recording: Recording, unit: str, times: FloatArray, arm: tuple[float, float, float]
              ) -> FloatArray:  # fmt: skip
    """Rotation times lever, w x r, shape (3, n)."""
    return np.cross(_rates(recording, unit, times), np.asarray(arm), axis=0).reshape(3, -1)


def _acceleration(
    recording: Recording, unit: str, times: FloatArray, arm: tuple[float, float, float]
) -> FloatArray:
    """dw/dt x r + w x (w x r), shape (3, n); rates smoothed over a tenth of a second."""
    rates = np.stack([_smooth(rate, times) for rate in _rates(recording, unit, times)])
    turning = np.gradient(rates, times, axis=1) if times.size > 2 else np.zeros_like(rates)
    lever = np.asarray(arm)[:, None] * np.ones_like(rates)
    inner = np.cross(rates, lever, axis=0)
    return np.cross(turning, lever, axis=0) + np.cross(rates, inner, axis=0)


def _rates(recording: Recording, unit: str, times: FloatArray) -> FloatArray:
    names = (f"{unit}_{stem}_rate_radps" for stem in ("roll", "pitch", "yaw"))
    return np.stack([_interpolated(recording, name, times) for name in names])


def _interpolated(recording: Recording, name: str, times: FloatArray) -> FloatArray:
    if name not in recording:
        return np.zeros_like(times)
    series = recording[name]
    return np.interp(times, series.time_s, series.value)


def _smooth(values: FloatArray, times: FloatArray) -> FloatArray:
    period_s = float(np.median(np.diff(times))) if times.size > 1 else _SMOOTHED_S
    width = min(2 * int(0.5 * _SMOOTHED_S / max(period_s, 1e-6)) + 1, values.size)
    if width < 3:
        return values
    padded = np.pad(values, width // 2, mode="edge")
    return np.convolve(padded, np.full(width, 1.0 / width), mode="valid")[: values.size]
