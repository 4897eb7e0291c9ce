"""Recordings as CSV, one row an instant, with the header lines that state the instruments."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from proving_ground.channels import COMMANDS
from proving_ground.layout import FloatArray
from proving_ground.task import Manoeuvre

HEADER = (
    "vehicle: tractor-semitrailer, mass set B (52,000 lb), spec sheet params_setB.json",
    "tractor_base_link: 2.420 m behind the steer axle, on the centre line, 0.90 m above the road",
    "trailer_base_link: 5.6132 m behind the kingpin, on the centre line, 1.20 m above the road",
    "tilt: roll and pitch are against the true horizontal; pitch nose-down positive",
    "filters: rates, accelerations, velocities zero-phase 20 Hz; hub speeds zero-phase 10 Hz; "
    "100 Hz sampling",
    "noise_1sigma_tractor: velocity 0.012 m/s, rate 0.02 deg/s, acceleration 0.03 m/s2, "
    "tilt 0.02 deg, heading 0.04 deg, position 0.02 m",
    "noise_1sigma_trailer: velocity 0.025 m/s, rate 0.05 deg/s, acceleration 0.06 m/s2, "
    "tilt 0.05 deg, heading 0.08 deg, position 0.03 m",
    "noise_1sigma_other: hub speed 0.2 %, tire pressure 0.5 %, chamber pressure 0.5 % + 500 Pa",
    "throttle: net force at the drive wheels = throttle x 300 kW / speed - 1500 N x "
    "(1 - throttle), top gear, clutch closed",
    "tires: 110 psig set in all 18",
    "road: proving ground, taken as level and dry",
)
STRAPDOWN = ("accelerometers: strapdown: specific force along the unit's own rolling and "
             "pitching axes, gravity included (az reads +9.81 at rest)")


def decimals(channel: str) -> int:
    """Digits behind the point: enough for the channel's quantum."""
    if channel.endswith("_pa"):
        return 0
    if channel.endswith(("_mps", "_mps2")):
        return 2
    return 3 if channel.endswith(("_m", "radps")) and "rate" not in channel else 6


def write_csv(path: Path, name: str, manoeuvre: Manoeuvre, readings: dict[str, FloatArray],
              gravity_removed: bool, time_s: FloatArray | None = None,
              about: tuple[str, ...] = HEADER, stated: bool = True) -> None:
    """Write one recording; a channel that is absent has no column, a gap is an empty cell.

    `time_s`: time stamps, every 10 ms if None. `about`: lines of the head. `stated`: whether the
    head tells filters and noise.
    """
    count = len(next(iter(readings.values())))
    accelerometers = "accelerometers: gravity removed" if gravity_removed else STRAPDOWN
    rest = [line for line in about[3:] if stated or not line.startswith(("noise", "filters"))]
    head = [f"recording: {name}", f"test: {manoeuvre.words}",
            f"target_speed_mps: {manoeuvre.speed_mps:.3f}", *about[:3], accelerometers, *rest]
    stamps = 0.01 * np.arange(count) if time_s is None else time_s
    event = [""] * count
    at = int(np.searchsorted(stamps, manoeuvre.blowout_s - 0.005))
    if at < count:
        event[at] = "+".join(manoeuvre.blown)
    names, texts = ["time_s"], [[f"{stamp:.2f}" for stamp in stamps.tolist()]]
    for channel, values in readings.items():
        if "blowout" not in names and channel not in COMMANDS:
            names.append("blowout")
            texts.append(event)
        names.append(channel)
        texts.append(_cells(values, decimals(channel)))
    lines = [f"# {line}" for line in head] + [",".join(names)]
    lines += [",".join(row) for row in zip(*texts, strict=True)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def _cells(values: FloatArray, digits: int) -> list[str]:
    form = f"%.{digits}f"
    return [form % value if value == value else "" for value in np.asarray(values).tolist()]
