"""Cases with the car, in the same cycle as those with a truck."""

from __future__ import annotations

import numpy as np

from proving_ground.car.channels import columns
from proving_ground.car.effects import CAR_LISTED, CAR_UNLISTED, CarEffect
from proving_ground.car.manoeuvres import KINDS
from proving_ground.cases import CaseSpec, FaultSpec
from proving_ground.effects import FAMILIES
from proving_ground.faults import FAULTS
from proving_ground.worlds.draws import ENDS, GROUP, WHOLE_NAMES, Rng, Turn, walk, wanted_sigma

FAMILIES_HERE = {name: tuple(n for n in names if n in CAR_LISTED)
                 for name, names in FAMILIES.items() if set(names) & set(CAR_LISTED)}
MISSING: tuple[tuple[str, ...], ...] = (
    (), (), (), ("hub_speed",), ("tractor_x_m", "tractor_y_m", "tractor_yaw_rad"),
    ("tractor_vy",), ("hub_speed", "tractor_vy", "tractor_roll_rad", "tractor_pitch_rad"))


def car_case(world: str, turn: Turn, seed: int) -> CaseSpec:
    """A case with the car."""
    rng = np.random.default_rng([seed, 137])
    effects, faults, without = _causes(turn, rng)
    needs = [e.kind.needs for e in effects] or ["steer"]
    if turn.letter == "n":
        needs = [list(KINDS)[turn.number // 2 % len(KINDS)]]
    train, holdout = (tuple(map(str, rng.choice(KINDS[needs[0]], 2, replace=False)))
                      for _ in range(2))
    if len(needs) > 1 or rng.random() < 0.4:
        other = KINDS[needs[1] if len(needs) > 1 else "steer"]
        train = (*train, str(rng.choice(other)))
        holdout = (holdout[0], str(rng.choice(other)))
    baseline = (str(rng.choice(KINDS["steer"])), str(rng.choice(KINDS["straight"])))
    missing = () if faults else MISSING[int(rng.integers(len(MISSING)))]
    return CaseSpec(f"{world}-{seed}", GROUP[turn.letter], seed, baseline, train, holdout, effects,
                    faults, missing, False, without, "w3")


def _causes(turn: Turn, rng: Rng
            ) -> tuple[tuple[CarEffect, ...], tuple[FaultSpec, ...], tuple[str, ...]]:
    if turn.letter == "n":
        return (), (), ()
    if turn.letter == "s":
        return (_effect(walk(tuple(CAR_LISTED), turn.before), rng, rng.random() < ENDS),), (), ()
    if turn.letter == "p":
        first, second = rng.choice(sorted(CAR_LISTED), 2, replace=False)
        if turn.before % 4 == 3:
            return (_effect(str(first), rng),), (_fault(turn.before // 4, rng),), ()
        return (_effect(str(first), rng), _effect(str(second), rng)), (), ()
    if turn.letter == "f":
        return (), (_fault(turn.before, rng),), ()
    if turn.letter == "u":
        return (_effect(walk(tuple(CAR_UNLISTED), turn.before), rng),), (), ()
    family = walk(tuple(FAMILIES_HERE), turn.before)
    return (_effect(str(rng.choice(FAMILIES_HERE[family])), rng),), (), FAMILIES[family]


def _effect(name: str, rng: Rng, at_end: bool = False) -> CarEffect:
    kind = CAR_LISTED.get(name) or CAR_UNLISTED[name]
    sign = float(rng.choice([-1.0, 1.0])) if kind.signed else 1.0
    place, law = int(rng.integers(len(kind.places))), int(rng.integers(1 + len(kind.others)))
    if at_end:
        return CarEffect(name, place, -1.0 if name == "brake_imbalance" else sign, None, kind.end,
                         law)
    return CarEffect(name, place, sign, wanted_sigma(rng), law=law)


def _fault(number: int, rng: Rng) -> FaultSpec:
    """A fault that the car's instruments can have."""
    here = set(columns())
    able = {name: [k for k, channels in enumerate(kind.places) if here >= set(channels)]
            for name, kind in FAULTS.items()}
    name = walk(tuple(name for name, places in able.items() if places), number)
    place, sign = int(rng.choice(able[name])), float(rng.choice([-1.0, 1.0]))
    if name in WHOLE_NAMES:
        return FaultSpec(name, place, sign, None, 1.0)
    return FaultSpec(name, place, sign, wanted_sigma(rng))
