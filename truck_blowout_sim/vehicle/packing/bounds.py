"""What a named parameter may be: the bounds of its file key or of `limits`, whoever sets it.

`effects:` of a vehicle file, `values:` of a scenario, `--set`, a study's variants and
`Packed.with_values` all ask here.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from truck_blowout_sim.physics import layout
from truck_blowout_sim.vehicle.document import Place
from truck_blowout_sim.vehicle.fields import Rule, rules
from truck_blowout_sim.vehicle.packing.blocks import NEUTRAL
from truck_blowout_sim.vehicle.packing.limits import own_rules
from truck_blowout_sim.vehicle.reading import LARGEST
from truck_blowout_sim.vehicle.schema import axle, body, controls, road, tire

# Sections whose bounds hold for the parameters of the same name. Positions are left out: packed
# ones are seen from the center of gravity, so a sign means something else there.
SECTIONS: dict[type[Any], tuple[type[Any], ...]] = {
    layout.WorldParams: (road.RoadSpec,),
    layout.SteeringParams: (controls.SteeringSpec,),
    layout.CouplingParams: (body.FifthWheelSpec,),
    layout.DrivelineParams: (controls.DrivelineSpec,),
    layout.AbsParams: (controls.AbsSpec,),
    layout.CircuitParams: (controls.CircuitSpec,),
    layout.UnitParams: (body.BodySpec, body.FrameSpec, body.AirSpec),
    layout.AxleParams: (axle.AxleSpec, axle.SuspensionSpec),
    layout.HubParams: (axle.AxleSpec,),
    layout.TireParams: (tire.TireSpec, tire.BlowoutSpec),
}
POSITIONS = ("_x_m", "_y_m", "_z_m")
# Parameters that hold a word's number. Whoever sets one may write the word.
WORDS: dict[tuple[type[Any], str], tuple[str, ...]] = {
    (layout.AbsParams, "mode"): controls.ABS_MODES,
    (layout.TireParams, "model"): tire.MODELS,
    (layout.TireParams, "law"): tire.LAWS,
}
SHARE_SLACK = 1e-6  # by which rounded shares may miss their sum
TRUTH = {"false": 0.0, "true": 1.0}


def check_value(block: type[Any], field: str, value: float, place: Place) -> None:
    """Check the value of one parameter.

    Args:
        block: its block of the layout; ``field``: its name there.
        value: in SI.
        place: where it was given.

    Raises:
        InputError: a value the parameter cannot have; says the bounds.
    """
    if math.isnan(value) or (abs(value) > LARGEST
                             and not (math.isinf(value) and may_be_infinite(block, field))):
        raise place.error(f"{value:g} is out of bounds", "a finite number")
    if words := WORDS.get((block, field)):
        if value not in range(len(words)):
            raise place.error(f"{value:g} is no {field}", f"one of: {', '.join(words)}")
        return
    bounded = _bounded(block, field)
    if bounded is None:
        return
    rule, low, high = bounded
    if value < low or value > high or (rule.open_low and value == low):
        raise place.error(f"{value:g} is out of bounds", f"{_bounds(rule, low, high)}: {rule.doc}")


def check_shares(shares: Mapping[str, float], place: Place) -> None:
    """Check the drive shares of all hubs together.

    Args:
        shares: by packed name; ``place``: where one of them was given.

    Raises:
        InputError: together they hand out more than there is.
    """
    whole = sum(shares.values())
    if whole > 1.0 + SHARE_SLACK:
        raise place.error(f"drive_share of all hubs adds up to {whole:g}", "at most 1")


def nearest_allowed(block: type[Any], field: str, value: float) -> float:
    """The value that a parameter can have and that is nearest to a given one."""
    bounded = _bounded(block, field)
    if bounded is None:
        return value
    rule, low, high = bounded
    if rule.open_low and value <= low:
        return math.nextafter(low, math.inf)
    return min(max(value, low), high)


def number_of(block: type[Any], field: str, text: str, place: Place) -> float:
    """The number that a text stands for: a number, or a word such as ``linear`` or ``true``.

    Raises:
        InputError: neither.
    """
    words = WORDS.get((block, field), ())
    if text in words:
        return float(words.index(text))
    rule = rule_of(block, field)
    if rule is not None and rule.kind == "switch" and text in TRUTH:
        return TRUTH[text]
    try:
        return float(text)
    except ValueError:
        expected = f"one of: {', '.join(words)}" if words else "a number"
        raise place.error(f"{text!r} is not a number", expected) from None


def may_be_infinite(block: type[Any], field: str) -> bool:
    """Whether infinity is a value: an instant or a place that never comes."""
    rule = rule_of(block, field)
    return math.isinf(NEUTRAL[block].get(field, 0.0)) or (rule is not None and rule.infinite)


def rule_of(block: type[Any], field: str) -> Rule | None:
    """The rule of the file key behind a parameter; None where there is none."""
    return _RULES[block].get(field)


def _rules_of(sections: tuple[type[Any], ...]) -> dict[str, Rule]:
    """Rules by key; where two sections have one, the first counts."""
    found: dict[str, Rule] = {}
    for section in reversed(sections):
        found |= rules(section)
    return {key: rule for key, rule in found.items()
            if not (key.endswith(POSITIONS) or key == "x_m")}


_RULES = {block: _rules_of(sections) | own_rules(block) for block, sections in SECTIONS.items()}


def _bounded(block: type[Any], field: str) -> tuple[Rule, float, float] | None:
    """The rule of a number or switch with its bounds; None where nothing bounds it."""
    rule = rule_of(block, field)
    if rule is None or rule.kind not in ("number", "switch"):
        return None
    return rule, *((0.0, 1.0) if rule.kind == "switch" else (rule.low, rule.high))


def _bounds(rule: Rule, low: float, high: float) -> str:
    bounds = f"above {low:g}" if rule.open_low else f"from {low:g}"
    return f"{bounds} to {high:g}" if math.isfinite(high) else bounds
