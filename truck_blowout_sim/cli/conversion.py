"""What `import` and `export` share: what they say at the end."""

from __future__ import annotations

from pathlib import Path

from truck_blowout_sim.cli.outputs import say
from truck_blowout_sim.recordings import Recording


def report(recording: Recording, output: Path, as_json: bool) -> None:
    """Say what was written."""
    tires = "+".join(dict.fromkeys(tire for b in recording.blowouts for tire in b.tires))
    event = f", {tires} blown at {recording.blowouts[0].time_s:g} s" if tires else ""
    result = {
        "output": str(output),
        "channels": sorted(recording.channels),
        "start_s": recording.start_s,
        "end_s": recording.end_s,
        "blowouts": [{"tires": list(b.tires), "at_s": b.time_s} for b in recording.blowouts],
        "missing_inputs": list(recording.missing_inputs),
        "notes": list(recording.notes),
    }
    line = (f"{output}: {len(recording.channels)} channels,"
            f" {recording.start_s:g} s to {recording.end_s:g} s{event}")
    say(as_json, result, [line])
