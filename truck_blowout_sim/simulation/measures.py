"""What a run comes to in a few numbers: lane, hand wheel, articulation, load transfer, rollover.

References: load transfer ratio |left - right| / (left + right) of the tire loads (Preston-Thomas &
Woodrooffe 1990); the other measures are largest values. A truck leaves its lane when the outermost
tire of any axle is beyond the lane's edge.
Known limits: the lane runs along the path that is followed, else straight on from the start, so the
lane's measures mean little where a steering table drives a turn; a trailer is placed in the lane by
its base_link, its axles by their distance from it.
Validated with: test/simulation/test_measures.py.
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.physics.layout import INPUT
from truck_blowout_sim.simulation.drive import Drive, Ran, names_of
from truck_blowout_sim.vehicle import Packed

Floats = NDArray[np.float64]
STANDING_MPS = 0.05


@dataclass(frozen=True)
class Measures:
    """Largest values since the first tire burst, or since the start where none did.

    Attributes:
        blown_s: instant of the first burst; None: nothing burst.
        rolled_over: whether a unit rolled over; ``rolled_over_unit``, ``rolled_over_s``.
        ended_s: instant at which the run ended; ``ended_speed_mps`` then.
        stopped_s: instant of standstill, None: it was still rolling.
        distance_m: driven since the burst.
        lane_departure_m: farthest that a base_link came from the middle of the lane.
        sideways_m: farthest that a base_link moved across the lane from where it was at the burst.
        left_lane_s: instant at which a tire left the lane, also before the burst; None: none did.
        peak_hand_wheel_rad, peak_hand_wheel_rate_radps: largest turn of the hand wheel from where
            it was, and its fastest.
        peak_articulation_rad, peak_yaw_rate_radps, peak_lateral_acceleration_mps2, peak_roll_rad:
            to either side; acceleration and roll of the unit that has more.
        peak_load_transfer: of the unit that has more; 1: all tires of one side are in the air.
    """

    blown_s: float | None
    rolled_over: bool
    rolled_over_unit: str | None
    rolled_over_s: float | None
    ended_s: float
    ended_speed_mps: float
    stopped_s: float | None
    distance_m: float
    lane_departure_m: float
    sideways_m: float
    left_lane_s: float | None
    peak_hand_wheel_rad: float
    peak_hand_wheel_rate_radps: float
    peak_articulation_rad: float
    peak_yaw_rate_radps: float
    peak_lateral_acceleration_mps2: float
    peak_roll_rad: float
    peak_load_transfer: float

    def as_row(self) -> dict[str, float | str | bool | None]:
        """By name."""
        return asdict(self)


def whole_speed(forward_mps: Floats, lateral_mps: Floats) -> Floats:
    """[n] Speed with the sign of the forward one: a truck that slides sideways does not stand."""
    return np.copysign(np.hypot(forward_mps, lateral_mps), forward_mps)


def measure(packed: Packed, drive: Drive, ran: Ran, lane_width_m: float) -> Measures:
    """Measures of a run that did not fail.

    Args:
        lane_width_m: of the lane the truck starts in the middle of.
    """
    good = np.isfinite(ran.out).all(axis=1)
    n = int(np.argmin(good)) if not good.all() else good.size
    table = dict(zip(names_of(packed.vehicle), ran.out[:n].T, strict=True))
    times, every = drive.times_s[:n], drive.every
    blown = _first_blown_s(drive, ran)
    since = slice(0 if blown is None else min(int(np.searchsorted(times, blown)), n - 1), n)
    inputs = ran.inputs[:max((n - 1) * every, 1)]
    wheel = inputs[min(since.start * every, len(inputs) - 1):, INPUT.steering_wheel_angle_rad]
    speed = whole_speed(table["tractor_vx_mps"], table["tractor_vy_mps"])
    standing = np.flatnonzero(np.abs(speed[since]) < STANDING_MPS)
    departure, sideways, left = _lane(packed, drive, table, since, lane_width_m)
    over = ran.ending if ran.ending and ran.ending.rolled_over else None
    units = packed.names.units
    return Measures(
        blown_s=blown,
        rolled_over=over is not None,
        rolled_over_unit=over.unit if over else None,
        rolled_over_s=over.time_s if over else None,
        ended_s=float(over.time_s if over else times[-1]),
        ended_speed_mps=float(speed[-1]),
        stopped_s=float(times[since][standing[0]]) if standing.size else None,
        distance_m=float(np.hypot(np.diff(table["tractor_x_m"][since]),
                                  np.diff(table["tractor_y_m"][since])).sum()),
        lane_departure_m=departure,
        sideways_m=sideways,
        left_lane_s=None if left is None else float(times[left]),
        peak_hand_wheel_rad=float(np.abs(wheel - wheel[0]).max()),
        peak_hand_wheel_rate_radps=float(np.abs(np.diff(wheel)).max(initial=0.0) / drive.step_s),
        peak_articulation_rad=_largest(table["articulation_rad"][since]),
        peak_yaw_rate_radps=_largest(table["tractor_yaw_rate_radps"][since]),
        peak_lateral_acceleration_mps2=max(_largest(table[f"{u}_ay_mps2"][since]) for u in units),
        peak_roll_rad=max(_largest(table[f"{u}_roll_rad"][since]) for u in units),
        peak_load_transfer=max(_transfer(packed, table, u, since) for u in units),
    )


def _first_blown_s(drive: Drive, ran: Ran) -> float | None:
    n, end = len(drive.inputs), ran.ending.time_s if ran.ending else math.inf
    times = [drive.initial.time_s + int(k) * drive.step_s for k in ran.blow_steps if 0 <= k < n]
    return min((t for t in times if t <= end), default=None)


def _largest(values: Floats) -> float:
    return float(np.abs(values).max())


def _transfer(packed: Packed, table: dict[str, Floats], unit: str, since: slice) -> float:
    """Largest load transfer ratio of a unit's tires."""
    sides = {"left": np.zeros(1), "right": np.zeros(1)}
    for hub in packed.names.hubs:
        if packed.vehicle.spec.axles[packed.vehicle.axle_of_hub(hub)].unit == unit:
            side = hub.rpartition("_")[2]
            for tire in packed.vehicle.tires_of_hub(hub):
                sides[side] = sides[side] + np.maximum(table[f"tire_fz_{tire}_n"][since], 0.0)
    whole = sides["left"] + sides["right"]
    carried = whole > 0.0
    ratio = np.abs(sides["left"] - sides["right"])[carried] / whole[carried]
    return float(ratio.max(initial=0.0))


def _lane(packed: Packed, drive: Drive, table: dict[str, Floats], since: slice,
          lane_width_m: float) -> tuple[float, float, int | None]:
    """How far base_links came off the lane, and moved in it; the row at which it was left.

    A truck that was outside when the first tire burst had left it before.
    """
    path = drive.path
    if not path.size:
        start = np.array([table["tractor_x_m"][0], table["tractor_y_m"][0]])
        heading = table["tractor_yaw_rad"][0]
        path = start + np.outer([0.0, 1.0], [math.cos(heading), math.sin(heading)])
    farthest, moved, first = 0.0, 0.0, None
    for unit in packed.names.units:
        x, y = table[f"{unit}_x_m"][since], table[f"{unit}_y_m"][since]
        beside = _beside(path, x, y)
        farthest, moved = max(farthest, _largest(beside)), max(moved, _largest(beside - beside[0]))
        yaw = table[f"{unit}_yaw_rad"][since]
        for along, half_m in _axles(packed, unit):
            off = _beside(path, x + along * np.cos(yaw), y + along * np.sin(yaw))
            out = np.flatnonzero(np.abs(off) + half_m > 0.5 * lane_width_m)
            if out.size and (first is None or since.start + out[0] < first):
                first = int(since.start + out[0])
    if first == since.start > 0:
        first = _lane(packed, drive, table, slice(0, since.start + 1), lane_width_m)[2]
    return farthest, moved, first


def _axles(packed: Packed, unit: str) -> list[tuple[float, float]]:
    """Each axle: its place ahead of the unit's base_link, half its width over tire middles."""
    specs = [a for a in packed.vehicle.spec.axles.values() if a.unit == unit]
    base = packed.vehicle.unit_specs[unit].base_link.x_m
    return [(base - a.x_m, 0.5 * (a.track_m + a.dual_spacing_m)) for a in specs]


def _beside(path: Floats, x: Floats, y: Floats) -> Floats:
    """Distance from the nearest piece of a path, whose ends go straight on; left is positive."""
    best, off = np.full(x.size, np.inf), np.zeros(x.size)
    for i in range(len(path) - 1):
        ahead = path[i + 1] - path[i]
        length = float(np.hypot(*ahead))
        along = ((x - path[i, 0]) * ahead[0] + (y - path[i, 1]) * ahead[1]) / length
        low, high = (-math.inf if i == 0 else 0.0), (math.inf if i == len(path) - 2 else length)
        miss = along - np.clip(along, low, high)
        side = ((y - path[i, 1]) * ahead[0] - (x - path[i, 0]) * ahead[1]) / length
        distance = np.hypot(side, miss)
        nearer = distance < best
        best, off = np.where(nearer, distance, best), np.where(nearer, side, off)
    return off
