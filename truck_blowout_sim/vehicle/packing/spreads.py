"""How far packed parameters may lie from the truth, where a vehicle file states it.

Known limits: only numbers that are packed as they stand in the file, and those few of `_OTHERS`; a
spread of another number (a damper, a yield point) is told by `truck-blowout vehicle`, no more.
Validated with: test/vehicle/test_spreads.py.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from truck_blowout_sim.vehicle.packing.packed import Packed
from truck_blowout_sim.vehicle.vehicle import Vehicle, hubs_of_axle

# key of the file that is packed under another name; relative: the spread is a share of the number
# in the second name, and moves the first, a factor, by that share
_OTHERS: Mapping[str, tuple[str, str]] = {
    "unit body.x_m": ("origin_x_m", ""),
    "unit body.z_m": ("cg_height_m", ""),
    "unit frame.torsion_nmprad": ("torsion_rear_nmprad", ""),
    "hub brake.linear_nmppa": ("brake_gain", "brake_linear_nmppa"),
    "hub track_m": ("y_m", ""),
    "tire cornering_peak": ("cornering_scale", "cornering_peak"),
}
# how much of the spread in the file the packed number has: a hub is half a track from the middle
_PARTS: Mapping[str, float] = {"track_m": 0.5}


def packed_spreads(packed: Packed) -> dict[str, float]:
    """One standard deviation of packed parameters, in their own unit, by name."""
    found: dict[str, float] = {}
    for key, stated in packed.vehicle.spreads.items():
        spread = _PARTS.get(key.rpartition(".")[2], 1.0) * stated
        for name, share_of in _names(packed.vehicle, key):
            if name in packed.index:
                value = packed[share_of] if share_of else 1.0
                found[name] = spread * (packed[name] / value if share_of else 1.0)
    return found


def _names(vehicle: Vehicle, key: str) -> Iterator[tuple[str, str]]:
    """Packed names that a key of the file stands for, and what its spread is a share of."""
    section, _, rest = key.partition(".")
    part, _, inside = rest.partition(".")
    last = key.rpartition(".")[2]
    if section in ("steering", "driveline", "fifth_wheel"):
        yield f"{section}.{rest}", ""
    elif section == "circuits":
        yield f"circuit.{rest}", ""
    elif section == "units":
        yield _as("unit", part, inside, last)
    elif section == "axles":
        yield _as("axle", part, inside, last)
        for hub in hubs_of_axle(part):
            yield _as("hub", hub, inside, last)
    elif section == "tires":
        for tire, file in vehicle.tire_files.items():
            if file == part:
                yield _as("tire", tire, inside, last)


def _as(kind: str, part: str, inside: str, last: str) -> tuple[str, str]:
    name, share_of = _OTHERS.get(f"{kind} {inside}", (last, ""))
    return f"{kind}.{part}.{name}", f"{kind}.{part}.{share_of}" if share_of else ""
