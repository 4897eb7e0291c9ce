"""How far an effect is from what listed effects can imitate, into `sigma_b.json` beside the cases.

An effect of no list is told from a listed one only by what the listed one leaves of it. So sigma_b
is measured once more with the listed effect beside it, in whatever amount explains most: the least
over all listed names and places is `apart`. Of a pair, each effect is measured beside the other.

Known limits: instants and places on the road are those of the case, though a diagnosis is free to
choose them; one name at a time, though it may state several. So an effect is hardly as far apart
as stated here.
Validated with: test/proving_ground/test_apart.py.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from proving_ground.car.effects import CAR_LISTED, CarEffect
from proving_ground.cases import CaseSpec, EffectSpec
from proving_ground.effects import LISTED
from proving_ground.effects.base import EffectKind
from proving_ground.ensemble import Nulls
from proving_ground.layout import FloatArray
from proving_ground.visibility import RESULT, Seen, spec_of, world_of, write_result

Apart = tuple[float, str]     # sigma_b beside the nearest other effect, and its name


def measure_apart(out: Path, nulls: Path, trucks: int) -> Iterator[tuple[str, list[Apart]]]:
    """Measure what is not measured yet, of no list or of a pair; keeps each, and yields it.

    Raises:
        ValueError: a case is of no world, or its sigma_b was not measured.
    """
    path, worlds = out / RESULT, dict[str, Nulls]()
    if not path.is_file():
        raise ValueError(f"no {path}: expected what `python -m proving_ground sigma` writes")
    done: dict[str, Any] = json.loads(path.read_text(encoding="utf-8"))
    for name in sorted(done):
        spec = spec_of(name)
        if "apart" in done[name] or not (spec.group == "unknown" or len(spec.effects) > 1):
            continue
        told = json.loads((out / "answers" / f"{name}.json").read_text(encoding="utf-8"))
        world = worlds.setdefault(world_of(spec), Nulls(world_of(spec), nulls, trucks))
        found = apart(spec, [one["severity"] for one in told["effects"]], Seen(spec, world))
        done[name] |= {"apart": [size for size, _ in found], "nearest": [near for _, near in found]}
        write_result(out, done)
        yield name, found


def apart(spec: CaseSpec, severities: Sequence[float], seen: Seen) -> list[Apart]:
    """Of each effect of a case, how far it is from the nearest that may explain it."""
    own = [seen.signature(effect, severity)
           for effect, severity in zip(spec.effects, severities, strict=False)]
    if spec.group == "unknown":
        return [nearest(signature, seen, others(spec)) for signature in own]
    return [(_three_digits(seen.detector.separation(signature, other)), effect.name)
            for signature, other, effect in zip(own, own[::-1], spec.effects[::-1], strict=True)]


def others(spec: CaseSpec) -> list[EffectSpec]:
    """Every listed effect at each of its places, but those that the case does without."""
    car = spec.truth == "w3"
    kinds: Mapping[str, EffectKind] = CAR_LISTED if car else LISTED
    one = CarEffect if car else EffectSpec
    away = {*spec.without, *(effect.name for effect in spec.effects)}
    return [one(name, place) for name, kind in kinds.items() if name not in away
            for place in range(len(kind.places))]


def nearest(signature: FloatArray, seen: Seen, listed: Sequence[EffectSpec]) -> Apart:
    """What the best listed effect leaves of a signature.

    Each is tried where it would be as visible alone; the best of them at its best severity, too.
    """
    whole, found = seen.detector.separation(signature), []
    for effect in listed:
        start = min(max(whole / effect.kind.guess, effect.kind.lowest), effect.kind.end)
        found.append(_left(signature, seen, effect, start, whole))
    best = min(found, key=lambda one: one.apart)
    again = _left(signature, seen, best.effect, best.severity, whole)
    return _three_digits(min(best.apart, again.apart)), best.effect.name


@dataclass(frozen=True)
class _Left:
    """What a listed effect leaves, and at what severity it would leave less."""

    apart: float
    effect: EffectSpec
    severity: float


def _left(signature: FloatArray, seen: Seen, effect: EffectSpec, severity: float, whole: float
          ) -> _Left:
    kind = effect.kind
    try:
        other = seen.signature(effect, severity)
    except FloatingPointError:
        return _Left(whole, effect, severity)     # stronger than the vehicle can bear
    share = seen.detector.amount(signature, other)
    if share <= 0.0 and not kind.signed:
        return _Left(whole, effect, severity)     # it would have to act backwards
    better = min(max(severity * abs(share), kind.lowest), kind.end)
    turned = replace(effect, sign=effect.sign if share > 0.0 else -effect.sign)
    return _Left(seen.detector.separation(signature, other), turned, better)


def _three_digits(value: float) -> float:
    return float(f"{value:.3g}")
