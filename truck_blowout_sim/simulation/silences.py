"""Silences of the inputs that drive a run: bridged by a straight line or held, and told.

Validated with: test/simulation/test_silences.py.
"""

from __future__ import annotations

from truck_blowout_sim.recordings import INPUT_NAMES, Recording

# shorter ones hide no maneuver of a truck's driver; slow loggers have intervals of their own
_LEAST_S = 1.0
_INTERVALS = 2.5


def silences(recording: Recording) -> tuple[str, ...]:
    """A note on each input that has no samples for a second or more; commands are held.

    Also where the speed, from which a run starts, begins that late.
    """
    late = _late(recording, "tractor_vx_mps", "the run starts at its first value")
    if recording.inputs_are_held:
        return late
    return (*late, *(note for name in INPUT_NAMES for note in (
        *_late(recording, name, "its first value stands for them"),
        *filter(None, [_note(recording, name)]), *_early(recording, name))))


def _late(recording: Recording, name: str, then: str) -> tuple[str, ...]:
    """Words on samples that begin later than the record."""
    if name not in recording or not len(recording[name]):
        return ()
    first_s = float(recording[name].time_s[0])
    if first_s - recording.start_s < _least_s(recording, name):
        return ()
    return (f"{name} has no samples before {first_s:.2f} s: {then}",)


def _early(recording: Recording, name: str) -> tuple[str, ...]:
    """Words on samples that end earlier than the record."""
    if name not in recording or not len(recording[name]):
        return ()
    last_s = float(recording[name].time_s[-1])
    if recording.end_s - last_s < _least_s(recording, name):
        return ()
    return (f"{name} has no samples after {last_s:.2f} s: its last value is held",)


def _least_s(recording: Recording, name: str) -> float:
    series = recording[name]
    return max(_LEAST_S, _INTERVALS * series.period_s if len(series) > 1 else 0.0)


def _note(recording: Recording, name: str) -> str:
    """Words on the longest silence of an input; empty if it has none."""
    if name not in recording:
        return ""
    series = recording[name]
    found = series.gaps(_least_s(recording, name)) if len(series) > 1 else ()
    if not found:
        return ""
    start_s, end_s = max(found, key=lambda gap: gap[1] - gap[0])
    more = f", the longest of {len(found)} silences" if len(found) > 1 else ""
    return (f"{name} has no samples from {start_s:.2f} s to {end_s:.2f} s ({end_s - start_s:.2f} s"
            f"{more}): a straight line bridges it, whatever the driver did")
