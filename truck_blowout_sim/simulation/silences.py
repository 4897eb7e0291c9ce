"""Silences of the inputs that drive a run: bridged by a straight line, and told.

Validated with: test/simulation/test_silences.py.
"""

from __future__ import annotations

from truck_blowout_sim.recordings import INPUT_NAMES, Recording

# shorter ones hide no maneuver of a truck's driver; slow loggers have intervals of their own
_LEAST_S = 1.0
_INTERVALS = 2.5


def silences(recording: Recording) -> tuple[str, ...]:
    """A note on each input that has no samples for a second or more; commands are held."""
    if recording.inputs_are_held:
        return ()
    return tuple(note for name in INPUT_NAMES for note in [_note(recording, name)] if note)


def _note(recording: Recording, name: str) -> str:
    """Words on the longest silence of an input; empty if it has none."""
    if name not in recording:
        return ""
    series = recording[name]
    found = series.gaps(max(_LEAST_S, _INTERVALS * series.period_s)) if len(series) > 1 else ()
    if not found:
        return ""
    start_s, end_s = max(found, key=lambda gap: gap[1] - gap[0])
    more = f", the longest of {len(found)} silences" if len(found) > 1 else ""
    return (f"{name} has no samples from {start_s:.2f} s to {end_s:.2f} s ({end_s - start_s:.2f} s"
            f"{more}): a straight line bridges it, whatever the driver did")
