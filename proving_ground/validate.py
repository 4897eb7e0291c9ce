"""Checks of the truth itself against the sheet and against recordings of the same kind of truck."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from proving_ground.channels import ideal, quaternion_angles
from proving_ground.individual import nominal
from proving_ground.layout import Commands, FloatArray
from proving_ground.run import Rig, Truth, drive
from proving_ground.sheet import POUND_N
from proving_ground.switches import neutral
from proving_ground.task import Braking, Manoeuvre

DEG = float(np.pi / 180.0)


@dataclass(frozen=True)
class Figure:
    """One checked quantity."""

    name: str
    value: float
    unit: str
    expected: str


def figures(recordings: Path | None) -> Iterator[Figure]:
    """All checks; with a folder of recordings also the comparison on their commands."""
    rig = Rig(nominal())
    yield from axle_loads(rig)
    yield from cornering(rig)
    yield from stopping(rig)
    yield from coasting(rig)
    yield from blowing(rig)
    if recordings is not None:
        for path in sorted(recordings.glob("*.csv")):
            yield from against(rig, path)


def axle_loads(rig: Rig) -> Iterator[Figure]:
    """Loads under the wheels, rolling straight at 20 m/s."""
    truth = drive(rig, Manoeuvre("straight", "straight", 20.0, 3.0), neutral(), 1)
    loads = truth.samples[:, 72:90].mean(axis=0) / POUND_N
    groups = (("steer", slice(0, 2), 11925.0), ("drive", slice(2, 10), 20004.0),
              ("trailer", slice(10, 18), 20070.0))
    for name, tires, wanted in groups:
        yield Figure(f"{name} axle load", float(loads[tires].sum()), "lb", f"{wanted:.0f} +-1 %")


def _steady(rig: Rig, hand_wheel_rad: float, speed: float) -> Truth:
    def program(time_s: float) -> float:
        return hand_wheel_rad * float(np.clip((time_s - 1.0) / 1.0, 0.0, 1.0))

    return drive(rig, Manoeuvre("ramp_hold", "hold", speed, 14.0, program, (0.5, 1.0e9)),
                 neutral(), 1)


def cornering(rig: Rig) -> Iterator[Figure]:
    """Yaw gain past the play of the linkage, the understeer it means, and roll per g."""
    last = slice(-200, None)
    small, large = _steady(rig, 0.35, 23.42), _steady(rig, 0.75, 23.42)
    hand = float(np.mean(large.commands[last, 0] - small.commands[last, 0])) / 22.0
    rates = [float(truth.samples[last, 12].mean()) for truth in (small, large)]
    gain = (rates[1] - rates[0]) / hand
    yield Figure("yaw gain at 52.4 mph, per hand wheel / ratio", gain, "1/s", "2.61")
    speed = float(large.samples[last, 7].mean())
    under = (1.0 / gain - 5.994 / speed) / (speed / 9.81) / DEG
    yield Figure("apparent understeer at 52.4 mph", under, "deg/g", "3.1")
    wheel = float(np.mean(large.samples[last, 90:92]) - np.mean(small.samples[last, 90:92]))
    yield Figure("yaw gain per road-wheel angle", (rates[1] - rates[0]) / wheel, "1/s", "-")
    roll, _, _ = quaternion_angles(large.samples[last, 3:7])
    side = float(large.samples[last, 14].mean())
    yield Figure("tractor roll per g", float(roll.mean()) / (side / 9.81) / DEG, "deg", "6-7")


def stopping(rig: Rig) -> Iterator[Figure]:
    """Deceleration and distance with the trailer alone at 33 psi and with all axles at 40 psi."""
    for name, groups, psi, wanted in (
            ("trailer at 33 psi", ("trailer",), 33.0, "0.167-0.191 with drag"),
            ("all axles at 40 psi", ("steer", "drive", "trailer"), 40.0, "0.45-0.5")):
        run = Manoeuvre("braking_all", "braking", 23.42, 20.0, release_s=0.5,
                        brakings=(Braking(1.0, 1.0e9, psi * 6894.757, groups),))
        truth = drive(rig, run, neutral(), 1)
        speed, time = truth.samples[:, 7], truth.time_s
        low = int(np.searchsorted(-speed, -10.0))
        first = int(np.searchsorted(time, 2.0))
        decel = (speed[first] - speed[low]) / (time[low] - time[first]) / 9.81
        yield Figure(f"deceleration, {name}", float(decel), "g", wanted)
        start = int(np.searchsorted(time, 1.0))
        end = speed[-1] ** 2 / (2.0 * 9.81 * decel)
        distance = truth.samples[-1, 0] - truth.samples[start, 0] + end
        yield Figure(f"stop from 52.4 mph, {name}", float(distance), "m", "-")


def coasting(rig: Rig) -> Iterator[Figure]:
    """Deceleration off throttle at 25 m/s."""
    run = Manoeuvre("coast_down", "coast", 25.5, 8.0, release_s=0.5)
    truth = drive(rig, run, neutral(), 1)
    v = truth.samples[:, 7]
    yield Figure("coast-down at 25 m/s", float((v[100] - v[-1]) / 0.01 / (len(v) - 101)), "m/s2",
                 "0.20-0.22")


def blowing(rig: Rig) -> Iterator[Figure]:
    """Left steer tire blown at 52.4 mph, hand wheel held still."""
    run = Manoeuvre("blowout_free", "blowout", 23.42, 7.0, blowout_s=2.0, blown=("steer_left",),
                    corrects=False)
    truth = drive(rig, run, neutral(), 1)
    s, after = truth.samples, slice(200, 320)
    peak = int(np.argmax(s[after, 12]))
    yield Figure("peak yaw rate within 1.2 s", float(np.max(s[after, 12])) / DEG, "deg/s", "2-2.5")
    yield Figure("time of that peak", 0.01 * peak, "s", "0.6-1.2")
    pressure = s[200:, 42]
    empty = float(0.01 * np.argmax(pressure < 0.02 * pressure[0]))
    yield Figure("time to empty", empty, "s", "0.3-0.5")
    before, later = s[100:200], s[260:320]
    drops = []
    for part in (before, later):
        roll, pitch, _ = quaternion_angles(part[:, 3:7])
        drops.append(float(np.mean(part[:, 2] - 2.42 * pitch)))
        drops.append(float(np.mean(part[:, 2] - 2.42 * pitch + 1.025 * roll)))
    yield Figure("drop of the frame over the steer axle", drops[0] - drops[2], "m", "0.069")
    yield Figure("drop of its left corner", drops[1] - drops[3], "m", "-")
    yield Figure("load on the flat", float(s[400:, 72].mean()), "N", "24100")
    yield Figure("load on its partner", float(s[400:, 73].mean()), "N", "28900")


class _Recorded:
    """Commands as a recording has them, the throttle closed-loop in the lead-in."""

    def __init__(self, commands: FloatArray, speed: float) -> None:
        self._commands = commands
        self._speed = speed

    def act(self, time_s: float, x: float, y: float, heading: float, yaw_rate: float,
            speed: float) -> Commands:
        """The recorded row at this time."""
        row = self._commands[int(np.clip(round(100.0 * time_s), 0, len(self._commands) - 1))]
        throttle = float(row[1])
        if time_s < 0.0:
            need = 1500.0 + 3.3 * speed * speed + 6000.0 * (self._speed - speed)
            throttle = float(np.clip(need / (300.0e3 / speed + 1500.0), 0.0, 1.0))
        return Commands(float(row[0]), throttle, float(row[2]), float(row[3]), float(row[4]))


def read_columns(path: Path) -> dict[str, list[str]]:
    """Columns of a CSV recording as text."""
    with path.open(encoding="utf-8", newline="") as stream:
        rows = csv.reader(line for line in stream if not line.startswith("#"))
        header = next(rows)
        return dict(zip(header, map(list, zip(*rows, strict=True)), strict=True))


def against(rig: Rig, path: Path) -> Iterator[Figure]:
    """The nominal truck on a recording's commands: slope of model over measurement, rms error."""
    columns = read_columns(path)
    numbers = {name: np.array(text, dtype=float) for name, text in columns.items()
               if name != "blowout"}
    events = [k for k, text in enumerate(columns["blowout"]) if text]
    names = list(numbers)[1:6]
    commands = np.stack([numbers[name] for name in names], axis=1)
    commands[:, 2:] = np.where(commands[:, 2:] < 3000.0, 0.0, commands[:, 2:])
    quiet = slice(0, 200)
    commands[:, 0] -= float(commands[quiet, 0].mean())
    speed = float(numbers["tractor_vx_mps"][:20].mean())
    time = float(numbers["time_s"][-1])
    run = Manoeuvre("recorded", path.stem, speed, time)
    if events:
        run = Manoeuvre("recorded", path.stem, speed, time, blowout_s=0.01 * events[0],
                        blown=tuple(columns["blowout"][events[0]].split("+")))
    model = ideal(rig.drive(run, neutral(), _Recorded(commands, speed)))
    for name in ("tractor_vx_mps", "tractor_yaw_rate_radps", "tractor_ay_mps2",
                 "tractor_roll_rad", "tractor_az_mps2", "trailer_yaw_rate_radps",
                 "trailer_roll_rad"):
        count = min(len(model[name]), len(numbers[name]))
        mine, theirs = model[name][:count], numbers[name][:count]
        slope = float(np.polyfit(theirs, mine, 1)[0])
        rms = float(np.sqrt(np.mean((mine - theirs - np.mean(mine - theirs)) ** 2)))
        yield Figure(f"{path.stem}: {name}", rms, "rms error", f"slope {slope:.3f}, "
                     f"measured std {float(np.std(theirs)):.4g}")
