"""Which cases a world holds: a cycle of 24 cases, 10 of them with nothing missing.

Any run of 24 numbers holds every group in its proportions, so a quick measurement takes one cycle
and a full one as many as there is time for. Severities are continuous, a tenth of them at the
physical end (a dead brake, a road of ice).
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from proving_ground.car.table import car_case
from proving_ground.cases import CaseSpec, EffectSpec, FaultSpec, check
from proving_ground.effects import FAMILIES, LISTED, UNLISTED
from proving_ground.faults import FAULTS
from proving_ground.kept_back import KINDS as KEPT_KINDS
from proving_ground.kept_back import sealed
from proving_ground.table import MISSING
from proving_ground.worlds.draws import (
    CYCLE,
    ENDS,
    GROUP,
    WHOLE_NAMES,
    Rng,
    Turn,
    walk,
    wanted_sigma,
)
from proving_ground.worlds.runs import KINDS, choose_runs
from proving_ground.worlds.severities import settled

WORLDS = ("w1", "w2", "w3", "w4")
ORDINARY = (10, 13)               # numbers in the cycle of w4 with ordinary driving
FIRST_SEED = {"w1": 2_000_000, "w2": 3_000_000, "w3": 4_000_000, "w4": 5_000_000}


def world_cases(world: str, first: int = 0, count: int = len(CYCLE)) -> list[CaseSpec]:
    """Cases `first` to `first + count - 1` of a world.

    Raises:
        ValueError: no world of that name; severities of a later draw were not found yet.
    """
    return [settled(spec) for spec in open_cases(world, first, count)]


def open_cases(world: str, first: int, count: int) -> list[CaseSpec]:
    """The same; effects of later draws still without the severity that their sigma_b asks for.

    Raises:
        ValueError: no world of that name.
    """
    if world not in WORLDS:
        raise ValueError(f"world: {world!r}, expected one of {WORLDS}")
    return [_case(world, Turn.of(number)) for number in range(first, first + count)]


def _case(world: str, turn: Turn) -> CaseSpec:
    seed = FIRST_SEED[world] + turn.number
    rng = np.random.default_rng([seed, 101])
    if world == "w3":
        return car_case("w3", turn, seed)
    if world != "w4":
        return truck_case(world, world, turn, seed, rng)
    truth = ("w1", "w2", "w3")[turn.number % 3]
    if truth == "w3":
        return _roughened(car_case("w4", turn, seed), rng)
    spec = _roughened(truck_case("w4", truth, turn, seed, rng), rng)
    return _ordinary(spec) if turn.number % len(CYCLE) in ORDINARY else spec


def _roughened(spec: CaseSpec, rng: Rng) -> CaseSpec:
    """The same case with rough instruments, half of them without baseline runs."""
    bare = bool(rng.random() < 0.5)
    return replace(spec, rough=True, baseline=() if bare else spec.baseline, dropouts=False)


def _ordinary(spec: CaseSpec) -> CaseSpec:
    """The same case with ten minutes of ordinary driving for training, and for the holdout."""
    return replace(spec, baseline=(), train=("ordinary_drive",), holdout=("ordinary_drive",))


def truck_case(world: str, truth: str, turn: Turn, seed: int, rng: Rng) -> CaseSpec:
    """A case with a truck."""
    group = GROUP[turn.letter]
    effects, faults, without = _causes(turn, rng)
    needs = [effect.kind.needs for effect in effects] or [FAULTS[f.name].needs for f in faults]
    runs = choose_runs(needs, turn.number, rng, KEPT_KINDS if sealed(seed) else KINDS)
    choices = MISSING if not faults else tuple(
        names for names in MISSING if not any("trailer" in name for name in names))
    missing = choices[int(rng.integers(len(choices)))]
    if any(f.name == "channel_swap" for f in faults):
        missing = ()
    if effects and effects[0].name == "secondary_blowout" and rng.random() < 0.5:
        missing = ("tire_pressure",)
    return check(CaseSpec(f"{world}-{seed}", group, seed, *runs, effects, faults, missing,
                          bool(rng.random() < 0.15), without, truth))


def _causes(turn: Turn, rng: Rng
            ) -> tuple[tuple[EffectSpec, ...], tuple[FaultSpec, ...], tuple[str, ...]]:
    """What is concealed: effects, instrument faults, names taken out of the library."""
    if turn.letter == "n":
        return (), (), ()
    if turn.letter == "s":
        return (_effect(walk(tuple(LISTED), turn.before), rng, rng.random() < ENDS),), (), ()
    if turn.letter == "p":
        first, second = rng.choice(sorted(LISTED), 2, replace=False)
        pair = [_effect(str(name), rng) for name in (first, second)]
        if turn.before % 4 == 3:
            return (pair[0],), (_fault(walk(tuple(FAULTS), turn.before // 4), rng),), ()
        return tuple(pair), (), ()
    if turn.letter == "f":
        return (), (_fault(walk(tuple(FAULTS), turn.before), rng),), ()
    if turn.letter == "u":
        return (_effect(walk(tuple(UNLISTED), turn.before), rng),), (), ()
    family = walk(tuple(FAMILIES), turn.before)
    listed = [name for name in FAMILIES[family] if name in LISTED]
    return (_effect(str(rng.choice(listed)), rng),), (), FAMILIES[family]


def _effect(name: str, rng: Rng, at_end: bool = False) -> EffectSpec:
    kind = LISTED.get(name) or UNLISTED[name]
    sign = float(rng.choice([-1.0, 1.0])) if kind.signed else 1.0
    place, law = int(rng.integers(len(kind.places))), int(rng.integers(1 + len(kind.others)))
    if at_end:
        return EffectSpec(name, place, -1.0 if name == "brake_imbalance" else sign, None,
                          kind.end, law)
    return EffectSpec(name, place, sign, wanted_sigma(rng), law=law)


def _fault(name: str, rng: Rng) -> FaultSpec:
    place, sign = int(rng.integers(len(FAULTS[name].places))), float(rng.choice([-1.0, 1.0]))
    if name in WHOLE_NAMES:
        return FaultSpec(name, place, sign, None, 1.0)
    return FaultSpec(name, place, sign, wanted_sigma(rng))
