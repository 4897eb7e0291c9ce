"""How far packed parameters may lie from the truth, where a vehicle file states it.

Known limits: only numbers that are packed as they stand in the file, and those few of `_OTHERS`; a
spread of another number (a damper, a yield point) is told by `truck-blowout vehicle`, no more.
Validated with: test/vehicle/test_spreads.py.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import NamedTuple

from truck_blowout_sim.vehicle.packing.packed import Packed
from truck_blowout_sim.vehicle.vehicle import Vehicle, hubs_of_axle


class _Target(NamedTuple):
    """A packed number that a key of the file stands for.

    Attributes:
        name: of the number.
        share_of: number of which the spread is a share; ``name``, a factor, moves by that share.
        part: of the spread that the number has.
    """

    name: str
    share_of: str = ""
    part: float = 1.0


# key of the file that is packed under another name
_OTHERS: Mapping[str, _Target] = {
    "unit body.x_m": _Target("origin_x_m"),
    "unit body.z_m": _Target("cg_height_m"),
    "unit frame.torsion_nmprad": _Target("torsion_rear_nmprad"),
    "unit hitch.x_m": _Target("hitch_x_m"),
    "unit hitch.z_m": _Target("hitch_z_m"),
    "axle spring_spacing_m": _Target("half_spacing_m", part=0.5),
    "hub track_m": _Target("y_m", part=0.5),  # a hub lies half a track from the middle
    "hub brake.pushout_pa": _Target("brake_pushout_pa"),
    "hub brake.linear_nmppa": _Target("brake_gain", "brake_linear_nmppa"),
    "tire dual_spacing_m": _Target("y_m", part=0.5),  # from the middle of the two
    "tire cornering_peak": _Target("cornering_scale", "cornering_peak"),
}


def packed_spreads(packed: Packed) -> dict[str, float]:
    """One standard deviation of packed parameters, in their own unit, by name."""
    found: dict[str, float] = {}
    for key, spread in packed.vehicle.spreads.items():
        for name, share_of, part in _targets(packed.vehicle, key):
            if name in packed.index:
                share = packed[name] / packed[share_of] if share_of else 1.0
                found[name] = part * spread * share
    return found


def _targets(vehicle: Vehicle, key: str) -> Iterator[_Target]:
    """Packed numbers that a key of the file stands for."""
    section, _, rest = key.partition(".")
    part, _, inside = rest.partition(".")
    last = key.rpartition(".")[2]
    if section in ("steering", "driveline", "fifth_wheel"):
        yield _Target(f"{section}.{rest}")
    elif section == "circuits":
        yield _Target(f"circuit.{rest}")
    elif section == "units":
        yield _as("unit", part, inside, last)
    elif section == "axles":
        yield _as("axle", part, inside, last)
        for hub in hubs_of_axle(part):
            yield _as("hub", hub, inside, last)
            if last == "dual_spacing_m":
                yield from (_as("tire", tire, inside, last) for tire in vehicle.tires_of_hub(hub))
    elif section == "tires":
        for tire, file in vehicle.tire_files.items():
            if file == part:
                yield _as("tire", tire, inside, last)


def _as(kind: str, part: str, inside: str, last: str) -> _Target:
    own = _OTHERS.get(f"{kind} {inside}", _Target(last))
    at = f"{kind}.{part}."
    return own._replace(name=at + own.name, share_of=at + own.share_of if own.share_of else "")
