"""The 2013 test's log rebuilt from what the thesis says of it in words and round figures.

``config/recordings/test_2013_steer_blowout.yaml`` holds every figure with its source and, per
channel, which stretch is stated, derived or interpolated. From it this module makes the log and a
companion with one mark per sample. The channels agree with one another: position integrates speed
and heading, heading integrates yaw rate, and the free numbers (decelerations, the clockwise yaw
rate, throttle, brake pressure) follow from the stated ones. No simulation takes part.

References: thesis sections 2.3, 2.5, 3.4, 4.2, appendix A.
Known limits: side slip is neglected; shapes between stated figures are smooth steps.
Validated with: test/recordings/test_rebuild_2013.py (statements of the thesis, same bytes again).
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import yaml
from numpy.typing import NDArray

from truck_blowout_sim.recordings.atomic import replacing
from truck_blowout_sim.recordings.csv_writer import write_csv
from truck_blowout_sim.recordings.recording import Blowout, Recording, Series
from truck_blowout_sim.recordings.units import FOOT_M, GRAVITY_MPS2, MILE_PER_HOUR_MPS, PSI_PA
from truck_blowout_sim.resources import config_dir

FloatArray = NDArray[np.float64]

NAME = "test_2013_steer_blowout"
_SI = {"ft": FOOT_M, "mph": MILE_PER_HOUR_MPS, "deg": np.pi / 180, "deg/s": np.pi / 180}
_KMH_PER_MPS = 3.6
_DECIMALS = {"tractor_x_m": 4, "tractor_y_m": 4, "tractor_vx_mps": 5, "throttle": 5}
_MARKS = ("stated", "derived", "interpolated")


@dataclass(frozen=True)
class Rebuilt:
    """The log, and the mark and source of each sample by channel."""

    recording: Recording
    marks: Mapping[str, list[tuple[str, str]]]


def rebuild(source: Path) -> Rebuilt:
    """Make the log from its YAML file."""
    tree = yaml.safe_load(source.read_text(encoding="utf-8"))
    figures = {name: _si(entry) for name, entry in tree["figures"].items()}
    budget = {name: float(entry["value"]) for name, entry in tree["budget"].items()}
    time_s = np.round(figures["start"] + figures["step"] * np.arange(int(figures["samples"])), 9)
    channels = _channels(time_s, figures, budget)
    marks = {name: _marks(time_s, tree["channels"][name]) for name in channels}
    series = {
        name: Series(time_s, np.round(values, _DECIMALS.get(name, 6)) + 0.0)
        for name, values in channels.items()
    }
    metadata = {key: " ".join(str(text).split()) for key, text in tree["metadata"].items()}
    blowout = Blowout(0.0, ("steer_left",))
    return Rebuilt(Recording(NAME, series, (blowout,), metadata), marks)


def _si(entry: Mapping[str, Any]) -> float:
    return float(entry["value"]) * _SI.get(str(entry["unit"]), 1.0)


def _channels(
    time_s: FloatArray, figures: Mapping[str, float], budget: Mapping[str, float]
) -> dict[str, FloatArray]:
    vx, braking_mps2 = _speed(time_s, figures)
    zero = np.zeros_like(time_s)
    full_pa = _brake_pressure_pa(braking_mps2, vx, time_s, figures, budget)
    braked = smooth(time_s, figures["brakes_on"], figures["brake_build_up"])
    yaw_rate = _yaw_rate(time_s, vx, figures)
    heading = _integral(time_s, yaw_rate)
    return {
        "steering_wheel_angle_rad": _steering(time_s, figures),
        "throttle": _throttle(time_s, figures, budget),
        "brake_pressure_steer_pa": zero,
        "brake_pressure_drive_pa": zero,
        "brake_pressure_trailer_pa": full_pa * braked,
        "tractor_x_m": _integral(time_s, vx * np.cos(heading)),
        "tractor_y_m": _integral(time_s, vx * np.sin(heading)),
        "tractor_vx_mps": vx,
        "tractor_yaw_rate_radps": yaw_rate,
    }


def _steering(time_s: FloatArray, figures: Mapping[str, float]) -> FloatArray:
    turned_s = figures["steering_peak_start"] - figures["reaction"]
    eased_from_s = figures["steering_peak_start"] + figures["steering_peak_duration"]
    ease_s = figures["steering_hold_start"] - eased_from_s
    right = figures["steering_peak"] * smooth(time_s, figures["reaction"], turned_s)
    back = figures["steering_peak"] - figures["steering_hold"]
    return -(right - back * smooth(time_s, eased_from_s, ease_s))


def _throttle(
    time_s: FloatArray, figures: Mapping[str, float], budget: Mapping[str, float]
) -> FloatArray:
    speed = _speed_before(figures)
    needed = _resistance_n(speed, budget) + budget["engine_drag"]
    level = needed / (budget["full_throttle_power"] / speed + budget["engine_drag"])
    return level * (1 - smooth(time_s, figures["throttle_end"], figures["throttle_release"]))


def _speed(time_s: FloatArray, figures: Mapping[str, float]) -> tuple[FloatArray, float]:
    """Forward speed, and the deceleration of full braking.

    The decelerations of the three stretches (throttle, coasting, braking) follow from the speeds
    at 3 and 5 s and from the distance.
    """
    start = _speed_before(figures)
    steps = (
        smooth(time_s, 0.0, figures["deflation"]),
        smooth(time_s, figures["throttle_end"], figures["throttle_release"]),
        smooth(
            time_s,
            figures["brakes_on"],
            figures["brake_build_up"] + figures["deceleration_lag"],
        ),
    )
    lost = [_integral(time_s, step) for step in steps]
    at_3, at_5 = (
        int(np.argmin(abs(time_s - figures[name]))) for name in ("throttle_end", "brakes_on")
    )
    under_throttle = (start - figures["speed_at_throttle_end"]) / lost[0][at_3]
    coasting = (start - under_throttle * lost[0][at_5] - figures["speed_at_brakes"]) / lost[1][at_5]
    unbraked = start - under_throttle * lost[0] - coasting * lost[1]
    surplus_m = _integral(time_s, unbraked)[-1] - figures["distance"]
    braking = surplus_m / _integral(time_s, lost[2])[-1]
    return unbraked - braking * lost[2], float(braking)


def _speed_before(figures: Mapping[str, float]) -> float:
    return figures["blowout_x"] / -figures["start"]


def _brake_pressure_pa(
    braking_mps2: float,
    vx: FloatArray,
    time_s: FloatArray,
    figures: Mapping[str, float],
    budget: Mapping[str, float],
) -> float:
    """Pressure whose brake torque gives the deceleration, by the torque law solved for it.

    What the other resistances do is already in the coasting deceleration; only what they lose as
    the speed falls has to come from the brakes.
    """
    coasting_n = _resistance_n(figures["speed_at_brakes"], budget)
    mean_speed = float(vx[time_s >= figures["brakes_on"]].mean())
    force_n = budget["mass"] * braking_mps2 + coasting_n - _resistance_n(mean_speed, budget)
    torque_nm = force_n * budget["rolling_radius"] / budget["wheel_ends"]
    a, b = budget["brake_quadratic"], budget["brake_linear"]
    above_push_out = (b - np.sqrt(b * b - 4 * a * torque_nm)) / (2 * a)
    return float((budget["brake_push_out"] + above_push_out) * PSI_PA)


def _resistance_n(speed_mps: float, budget: Mapping[str, float]) -> float:
    air = 0.5 * budget["air_density"] * budget["drag_area"] * speed_mps**2
    per_speed = budget["rolling_per_speed"] * _KMH_PER_MPS * speed_mps
    return air + (budget["rolling_constant"] + per_speed) * budget["mass"] * GRAVITY_MPS2


def _yaw_rate(time_s: FloatArray, vx: FloatArray, figures: Mapping[str, float]) -> FloatArray:
    peak_s, turn_s = figures["yaw_rate_peak_time"], figures["clockwise_start"]
    rise = smooth(time_s, 0.0, peak_s) - smooth(time_s, peak_s, turn_s - peak_s)
    left = figures["yaw_rate_peak"] * rise
    phase = np.clip((time_s - turn_s) / figures["clockwise_duration"], 0.0, 1.0)
    right = np.sin(np.pi * phase) ** 2

    def displacement(clockwise: float) -> float:
        heading = _integral(time_s, left - clockwise * right)
        return float(_integral(time_s, vx * np.sin(heading))[-1])

    low, high = figures["clockwise_least"], figures["clockwise_most"]
    if displacement(low) > figures["lateral_displacement"] > displacement(high):
        for _ in range(60):
            middle = 0.5 * (low + high)
            enough = displacement(middle) > figures["lateral_displacement"]
            low, high = (middle, high) if enough else (low, middle)
    elif displacement(low) <= figures["lateral_displacement"]:
        high = low
    else:
        low = high
    return left - 0.5 * (low + high) * right


def smooth(time_s: FloatArray, start_s: float, duration_s: float) -> FloatArray:
    """Step from 0 to 1 without a jump in slope: 3u^2 - 2u^3."""
    u = np.clip((time_s - start_s) / duration_s, 0.0, 1.0)
    return np.asarray(u * u * (3.0 - 2.0 * u))


def _integral(time_s: FloatArray, values: FloatArray) -> FloatArray:
    steps = 0.5 * (values[1:] + values[:-1]) * np.diff(time_s)
    return np.concatenate(([0.0], np.cumsum(steps)))


def _marks(time_s: FloatArray, segments: list[Mapping[str, Any]]) -> list[tuple[str, str]]:
    marks: list[tuple[str, str]] = []
    for t in time_s:
        owner = [s for s in segments if s["from_s"] - 1e-6 <= t < s["to_s"] - 1e-6]
        if len(owner) != 1 or owner[0]["mark"] not in _MARKS:
            raise ValueError(f"{len(owner)} segments of {_MARKS} at {t} s, one is needed")
        marks.append((str(owner[0]["mark"]), str(owner[0]["source"])))
    return marks


def write(rebuilt: Rebuilt, folder: Path) -> tuple[Path, Path]:
    """Write the log and its companion of marks; returns both paths."""
    log, companion = folder / f"{NAME}.csv", folder / f"{NAME}.provenance.csv"
    write_csv(rebuilt.recording, log)
    names = list(rebuilt.marks)
    rows = [["time_s", *names]]
    for i, t in enumerate(rebuilt.recording[names[0]].time_s.tolist()):
        rows.append([repr(t), *(_cell(rebuilt.marks[name][i]) for name in names)])
    with replacing(companion) as temporary:
        temporary.write_text("".join(",".join(row) + "\n" for row in rows), encoding="utf-8")
    return log, companion


def _cell(mark: tuple[str, str]) -> str:
    words, _, _ = mark[1].partition(":")
    lines = words if words.startswith("T L") else ""
    return f"{mark[0]} {lines}".strip().replace(",", " and")


def main() -> None:
    """Command line: rebuild the log beside its YAML file, or in another folder."""
    parser = argparse.ArgumentParser(description="Rebuild the log of the 2013 test from its YAML.")
    shipped = config_dir() / "recordings" / f"{NAME}.yaml"
    parser.add_argument("source", type=Path, nargs="?", default=shipped, help="the YAML file")
    parser.add_argument("-o", "--output", type=Path, help="folder; that of the YAML by default")
    arguments = parser.parse_args()
    for path in write(rebuild(arguments.source), arguments.output or arguments.source.parent):
        print(path)


if __name__ == "__main__":
    main()
