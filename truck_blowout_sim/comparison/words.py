"""Channels and findings in words a person reads."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from truck_blowout_sim.comparison.iso18571 import grade
from truck_blowout_sim.recordings import Channel, channels_for
from truck_blowout_sim.vehicle import Vehicle

if TYPE_CHECKING:
    from truck_blowout_sim.comparison.comparing import Comparison
    from truck_blowout_sim.comparison.errors import ChannelError

SIDEWAYS_KEY = "lateral_direction"  # metadata: the record had to choose a side
NOTICED_LAG_S = 0.1  # a driver's hand or a valve takes as long; instruments are faster

_SHORT = {
    "hub_speed": "spin speed",
    "tire_pressure": "tire pressure",
    "brake_chamber": "chamber pressure",
}


def labels_for(vehicle: Vehicle) -> Mapping[str, str]:
    """Quantity of each channel in words, in the order of the channel table."""
    steered = [f"{axle}_{side}" for axle in vehicle.axles if vehicle.spec.axles[axle].steered
               for side in ("left", "right")]  # fmt: skip
    rows = channels_for(vehicle.hubs, vehicle.tires, vehicle.units, steered)
    labels = {}
    for row in rows:
        labels[row.name] = _label(row)
        if row.name.endswith("_y_m"):
            unit = row.part
            labels[f"{unit}_along_m"] = f"position of the {unit}, along"
            labels[f"{unit}_across_m"] = f"position of the {unit}, across"
    return labels


def _label(row: Channel) -> str:
    """The table's words without what a reader of the name knows anyway."""
    if row.group in _SHORT:
        return f"{_SHORT[row.group]}, {row.part}"
    return row.quantity.partition(",")[0]


def verdict(comparison: Comparison) -> str:
    """The comparison in a few words: speed, yaw rates, where it ends, mean rating."""
    start, end = comparison.interval_s
    said = [*_speed(comparison), *_yaw_rates(comparison)]
    if not said:
        worst = max(comparison.channels, key=lambda c: c.rms_sigma or 0.0)
        said = [f"{worst.label} within {_brief(worst, worst.rms)} rms"]
    imposed = "with the recorded speed imposed, " if comparison.speed_imposed else ""
    head = f"Over {end - start:.1f} s, {imposed}{comparison.against} follows {_joined(said)}"
    return head + _position(comparison) + _rating(comparison) + "." + _late(comparison)


def _speed(comparison: Comparison) -> list[str]:
    if comparison.speed_imposed or "tractor_vx_mps" not in comparison:
        return []
    speed = comparison["tractor_vx_mps"]
    return [f"the speed within {_brief(speed, speed.rms)} rms"]


def _yaw_rates(comparison: Comparison) -> list[str]:
    found = []
    for unit in comparison.vehicle.units:
        name = f"{unit}_yaw_rate_radps"
        if name in comparison:
            rate = comparison[name]
            peak = f"{_brief(rate, abs(rate.peak))} at {rate.peak_time_s:.1f} s"
            rms = _brief(rate, rate.rms)
            found.append(f"the {unit}'s yaw rate within {rms} rms (at most {peak})")
    return found


def _position(comparison: Comparison) -> str:
    if "tractor_along_m" not in comparison:
        return ""
    along, across = comparison["tractor_along_m"], comparison["tractor_across_m"]
    left = "left" if across.final > 0 else "right"
    ahead = "ahead" if along.final > 0 else "behind"
    said = (
        f"; it ends {_brief(along, abs(along.final))} {ahead} and"
        f" {_brief(across, abs(across.final))} to the {left} of the recorded position"
    )
    if SIDEWAYS_KEY not in comparison.recording.metadata:
        return said
    pair = comparison.pairs["tractor_across_m"]
    mirrored = _brief(across, abs(float(pair.model[-1] + pair.measured[-1])))
    return (f"{said}, if the truck went to the side that the record assumes; {mirrored} beside it"
            " if it went to the other side, which the record leaves open")


def _rating(comparison: Comparison) -> str:
    overall = comparison.mean_rating
    if overall is None:
        return ""
    said = f"; mean ISO/TS 18571 rating {overall:.2f} ({grade(overall)})"
    found = comparison.contrast
    if found is None:
        return said
    name, best = next(iter(found.others.items()))
    tells = "tells" if found.separates else "hardly tells"
    return (f"{said}. The rating {tells} vehicles apart: over {len(found.channels)} channels this"
            f" model has {found.rating:.2f}, {name} {best:.2f}")


def _late(comparison: Comparison) -> str:
    """Channels that fit best at another time, worst first; a rating forgives such a shift."""
    late = [c for c in comparison.channels
            if c.lag_s is not None and abs(c.lag_s) >= NOTICED_LAG_S and not c.imposed]  # fmt: skip
    if not late:
        return ""
    worst = max(late, key=lambda c: abs(c.lag_s or 0.0))
    others = f" ({len(late) - 1} more are shifted, too)" if len(late) > 1 else ""
    side = "late" if (worst.lag_s or 0.0) > 0.0 else "early"
    lag = f"{abs(worst.lag_s or 0.0):.2f} s {side}"
    return (f" The record of the {worst.label} is {lag}: shifted by that, both agree far"
            f" better{others}.")


def _brief(channel: ChannelError, value: float) -> str:
    """Two significant digits and the unit."""
    return channel.shown(float(f"{value * channel.unit.per_si:.2g}") / channel.unit.per_si)


def _joined(parts: list[str]) -> str:
    return parts[0] if len(parts) == 1 else ", ".join(parts[:-1]) + " and " + parts[-1]
