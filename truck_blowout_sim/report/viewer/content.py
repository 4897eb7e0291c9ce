"""What a page holds about each run: the motion, every channel, the shape of the vehicle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from truck_blowout_sim.comparison.units import axes_sign, display_unit
from truck_blowout_sim.motion import Motion
from truck_blowout_sim.motion.source import Floats
from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.recordings.channels import by_name
from truck_blowout_sim.recordings.names import parts_of
from truck_blowout_sim.report.viewer.packing import Packer
from truck_blowout_sim.report.viewer.shapes import DRAWN, vehicle_shape
from truck_blowout_sim.vehicle import Vehicle

_MOST_SAMPLES = 6000  # of one channel: five minutes at 20 Hz; more is thinned
_MM, _MICRORAD, _CENTIRAD, _TEN_N, _PERCENT = 1e-3, 2e-6, 1e-2, 10.0, 1e-2


@dataclass(frozen=True)
class RunToShow:
    """One run of a page: what was recorded, how the truck moved, and the truck itself."""

    recording: Recording
    motion: Motion
    vehicle: Vehicle


def run_content(run: RunToShow, origin: tuple[float, float], moved: tuple[float, float, float],
                said: str) -> dict[str, Any]:
    """Plain data of one run.

    Args:
        run: what is shown.
        origin: point of the map that becomes the page's origin, m.
        moved: shift (x, y) and turn about the run's start that bring it beside the first run.
        said: a sentence about that, or nothing.
    """
    packer = Packer()
    motion = _motion(run.motion, packer, origin, moved)
    channels, times, thinned = _channels(run.recording, packer)
    notes = [*run.motion.assumptions, *([said] if said else []), *([thinned] if thinned else [])]
    return {
        "name": run.recording.name,
        "title": run.recording.metadata.get("title", run.recording.metadata.get("test", "")),
        "blowouts": [{"t": event.time_s, "tires": list(event.tires)}
                     for event in run.recording.blowouts],
        "rollover": _rollover(run.recording),
        "notes": list(run.recording.notes), "assumptions": [*notes, DRAWN],
        "vehicle": vehicle_shape(run.vehicle),
        "t0": float(run.motion.times_s[0]), "t1": float(run.motion.times_s[-1]),
        "n": int(run.motion.times_s.size),
        "motion": motion, "times": times, "channels": channels, "bytes": packer.text(),
    }


def _rollover(recording: Recording) -> dict[str, Any] | None:
    """Instant, unit and words of a rollover, which ends a simulated run."""
    unit = recording.metadata.get("rolled_over_unit")
    if not unit:
        return None
    time_s = float(recording.metadata["rolled_over_s"])
    return {"t": time_s, "unit": unit, "words": f"the {unit} rolled over at {time_s:.2f} s"}


def _motion(motion: Motion, packer: Packer, origin: tuple[float, float],
            moved: tuple[float, float, float]) -> dict[str, Any]:
    units: dict[str, Any] = {}
    hubs: dict[str, Any] = {}
    for name, track in motion.units.items():
        x, y = _placed(track.x_m, track.y_m, motion, origin, moved)
        units[name] = {
            "x": packer.add(x, _MM), "y": packer.add(y, _MM), "z": packer.add(track.z_m, _MM / 10),
            "yaw": packer.add(track.yaw_rad + moved[2], _MICRORAD * 10),
            "roll": packer.add(track.roll_rad, _MICRORAD * 10),
            "pitch": packer.add(track.pitch_rad, _MICRORAD * 10),
        }
    for name, wheel in motion.wheels.items():
        tires: dict[str, Any] = {}
        for tire, air in wheel.air.items():
            tires[tire] = {"air": packer.add(air, _PERCENT)}
            if tire in wheel.forces_n:
                tires[tire]["f"] = [packer.add(part, _TEN_N) for part in wheel.forces_n[tire]]
        hubs[name] = {"steer": packer.add(wheel.steer_rad, _MICRORAD * 10),
                      "spin": packer.add(wheel.spin_rad, _CENTIRAD),
                      "h": packer.add(wheel.height_m, _MM / 10), "tires": tires}
    return {"units": units, "hubs": hubs}


def _placed(x: Floats, y: Floats, motion: Motion, origin: tuple[float, float],
            moved: tuple[float, float, float]) -> tuple[Floats, Floats]:
    """Map positions on the page: turned about the run's start, shifted, origin taken off."""
    first = next(iter(motion.units.values()))
    x0, y0, (dx, dy, turn) = float(first.x_m[0]), float(first.y_m[0]), moved
    c, s = np.cos(turn), np.sin(turn)
    along, across = x - x0, y - y0
    return (x0 + c * along - s * across + dx - origin[0],
            y0 + s * along + c * across + dy - origin[1])


def _channels(recording: Recording, packer: Packer
              ) -> tuple[list[dict[str, Any]], list[dict[str, Any]], str]:
    table = by_name(parts_of(recording.channels).table())
    clocks: dict[bytes, int] = {}
    times: list[dict[str, Any]] = []
    found, most = [], 0
    for name, series in recording.channels.items():
        if not len(series):
            continue
        every = -(-len(series) // _MOST_SAMPLES)
        most = max(most, every)
        time_s, value = _thinned(series, every)
        key = time_s.tobytes()
        if key not in clocks:
            clocks[key] = len(times)
            times.append(packer.add(time_s, 1e-5))
        us, si = display_unit(name, "us"), display_unit(name, "si")
        found.append({
            "name": name, "words": table[name].quantity if name in table else name,
            "us": [us.symbol, us.per_si], "si": [si.symbol, si.per_si],
            "sae": axes_sign(name, "sae"), "time": clocks[key], "v": packer.add(value),
        })
    words = f"plots: every {most}th sample of the longest channels" if most > 1 else ""
    return found, times, words


def _thinned(series: Series, every: int) -> tuple[Floats, Floats]:
    return (series.time_s, series.value) if every == 1 else (series.time_s[::every],
                                                             series.value[::every])
