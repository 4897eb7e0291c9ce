"""The seeded tables of cases: `dev` to develop against, `test` to be scored once.

The two share no seed, no severity and no manoeuvre kind. `ci` is a short list of its own.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from proving_ground.cases import CaseSpec, EffectSpec, FaultSpec, check
from proving_ground.ci import ci_cases
from proving_ground.effects import FAMILIES, IN_TABLES, LISTED, UNLISTED
from proving_ground.faults import FAULTS
from proving_ground.faults import IN_TABLES as FAULTS_IN_TABLES

Pools = dict[str, tuple[tuple[str, ...], tuple[str, ...]]]

DEV_POOLS: Pools = {
    "blowout": (("blowout", "blowout"), ("blowout", "blowout")),
    "quick steer": (("lane_change", "sine_sweep"), ("sine_sweep", "ramp_hold")),
    "hard steer": (("lane_change", "hard_ramp"), ("hard_ramp", "sine_sweep")),
    "steer": (("lane_change", "ramp_hold"), ("sine_sweep", "lane_change")),
    "small steer": (("sine_sweep", "straight"), ("lane_change", "straight")),
    "kingpin": (("lane_change", "ramp_hold", "blowout"), ("sine_sweep", "blowout")),
    "limit": (("braking_all", "hard_ramp"), ("braking_all", "hard_ramp")),
    "brake": (("braking_all", "braking_all"), ("braking_all", "braking_all")),
    "coast": (("coast_down", "straight"), ("coast_down", "braking_trailer")),
    "straight": (("straight", "coast_down"), ("straight", "braking_trailer")),
    "any": (("straight", "lane_change"), ("sine_sweep", "coast_down")),
}
TEST_POOLS: Pools = {
    "blowout": (("blowout_pull_over", "blowout_quick_hands"),
                ("blowout_quick_hands", "blowout_pull_over")),
    "quick steer": (("swerve_and_return", "growing_triangles"),
                    ("lift_in_turn", "tightening_turn")),
    "hard steer": (("hard_tightening", "hard_swerve"), ("hard_swerve", "hard_tightening")),
    "steer": (("tightening_turn", "lift_in_turn"), ("swerve_and_return", "growing_triangles")),
    "small steer": (("slow_drift", "dragging_brake"), ("growing_triangles", "slow_drift")),
    "kingpin": (("slow_drift", "tightening_turn", "blowout_pull_over"),
                ("growing_triangles", "blowout_quick_hands")),
    "limit": (("braking_taper", "hard_tightening"), ("braking_added", "hard_swerve")),
    "brake": (("braking_added", "braking_taper"), ("braking_taper", "braking_added")),
    "coast": (("roll_and_dabs", "dragging_brake"), ("dragging_brake", "roll_and_dabs")),
    "straight": (("dragging_brake", "roll_and_dabs"), ("roll_and_dabs", "braking_taper")),
    "any": (("dragging_brake", "growing_triangles"), ("slow_drift", "roll_and_dabs")),
}
BASELINES = {"dev": (("lane_change", "coast_down"), ("ramp_hold", "braking_all")),
             "test": (("swerve_and_return", "roll_and_dabs"),
                      ("tightening_turn", "braking_added"))}
MISSING: tuple[tuple[str, ...], ...] = (
    (), (), (), ("hub_speed",), ("tire_pressure",), ("brake_chamber",),
    ("trailer_x_m", "trailer_y_m", "trailer_vx", "trailer_vy", "trailer_yaw_rad",
     "trailer_roll_rad", "trailer_pitch_rad"),
    ("hub_speed", "tire_pressure", "brake_chamber"))
TEST_SIGMAS = (5.0, 10.0, 20.0, 50.0)
DEV_SIGMAS = (8.0, 16.0, 32.0, 80.0)


@dataclass(frozen=True)
class Counts:
    """Cases of each group in a set."""

    null: int
    single: int
    pair: int
    sensor: int
    unknown: int


COUNTS = {"dev": Counts(40, 84, 16, 16, 16), "test": Counts(120, 160, 40, 40, 40)}
FIRST_SEED = {"dev": 10_000, "test": 1_400_000}
SETS = ("dev", "test", "ci")


def cases_of(name: str) -> list[CaseSpec]:
    """All cases of a set."""
    return ci_cases() if name == "ci" else Table(name).cases()


class Table:
    """Draws the cases of a set one after the other, repeatable from the set's first seed."""

    def __init__(self, name: str) -> None:
        self.name = name
        self._pools = DEV_POOLS if name == "dev" else TEST_POOLS
        self._sigmas = DEV_SIGMAS if name == "dev" else TEST_SIGMAS
        self._seed = FIRST_SEED[name]

    def cases(self) -> list[CaseSpec]:
        """All cases of the set."""
        counts = COUNTS[self.name]
        listed, unlisted, faults = list(IN_TABLES), list(UNLISTED), list(FAULTS_IN_TABLES)
        rows = [self._null(i) for i in range(counts.null)]
        for i in range(counts.single):
            rows.append(self._physics("single", [listed[i % len(listed)]],
                                      self._turn(i, len(listed))))
        for i in range(counts.pair):
            first = listed[(3 * i) % len(listed)]
            second = listed[(3 * i + 5 + i // len(listed)) % len(listed)]
            rows.append(self._pair(first, second, i))
        for i in range(counts.sensor):
            sigma = self._sigmas[(i // len(faults)) % len(self._sigmas)]
            rows.append(self._sensor(faults[i % len(faults)], sigma))
        for i in range(counts.unknown):
            rows.append(self._unknown(i // 2, unlisted) if i % 2 else self._taken_out(i // 2))
        return [check(row) for row in rows]

    def _next(self, group: str) -> tuple[str, int, np.random.Generator]:
        self._seed += 1
        return f"{self.name}-{self._seed}", self._seed, np.random.default_rng([self._seed, 71])

    def _build(self, group: str, needs: str, effects: tuple[EffectSpec, ...] = (),
               faults: tuple[FaultSpec, ...] = (), blind: bool = False) -> CaseSpec:
        """A case whose runs excite what it needs."""
        name, seed, rng = self._next(group)
        train, holdout = self._pools[needs]
        if rng.random() < 0.4 and len(train) < 3:
            extra = self._pools["any" if needs == "blowout" else "steer"][0]
            train = (*train, extra[int(rng.integers(len(extra)))])
        choices = MISSING
        if faults:
            choices = tuple(names for names in MISSING if not any("trailer" in n for n in names))
        missing = choices[int(rng.integers(len(choices)))]
        if blind:
            missing = ("tire_pressure",)
        base = BASELINES[self.name]
        return CaseSpec(name, group, seed, base[int(rng.integers(len(base)))], train, holdout,
                        effects, faults, missing, bool(rng.random() < 0.15))

    def _null(self, number: int) -> CaseSpec:
        needs = list(self._pools)
        return self._build("null", needs[number % len(needs)])

    def _effect(self, name: str, sigma: float | None) -> EffectSpec:
        rng = np.random.default_rng([self._seed + 1, 73])
        kind = LISTED.get(name) or UNLISTED[name]
        sign = float(rng.choice([-1.0, 1.0])) if kind.signed else 1.0
        return EffectSpec(name, int(rng.integers(len(kind.places))), sign, sigma)

    def _physics(self, group: str, names: list[str], sigma: float) -> CaseSpec:
        effects = tuple(self._effect(name, sigma) for name in names)
        blind = names == ["secondary_blowout"] and self._seed % 2 == 0
        return self._build(group, effects[0].kind.needs, effects, blind=blind)

    def _turn(self, number: int, count: int) -> float:
        """The severity whose turn it is, shifted by one each time all names have been met."""
        return self._sigmas[(number // count + number) % len(self._sigmas)]

    def _unknown(self, number: int, names: list[str]) -> CaseSpec:
        """An effect that no list ever held."""
        sigma = max(self._turn(number, len(names)), 10.0)
        return self._physics("unknown", [names[number % len(names)]], sigma)

    def _taken_out(self, number: int) -> CaseSpec:
        """An effect whose whole family the diagnosis must do without."""
        family = list(FAMILIES.values())[number % len(FAMILIES)]
        family = tuple(name for name in family if name in IN_TABLES or name in FAULTS)
        listed = [name for name in family if name in LISTED]
        sigma = max(self._turn(number, len(FAMILIES)), 10.0)
        case = self._physics("unknown", [listed[(number // len(FAMILIES)) % len(listed)]], sigma)
        return replace(case, without=family)

    def _pair(self, first: str, second: str, number: int) -> CaseSpec:
        """Two effects, or an effect with an instrument fault in every fourth case."""
        sigma = self._sigmas[2 + number % 2]
        one = self._effect(first, sigma)
        if number % 4 == 3:
            fault = FAULTS_IN_TABLES[number % len(FAULTS_IN_TABLES)]
            return self._build("pair", one.kind.needs, (one,),
                               (FaultSpec(fault, number, 1.0, sigma),))
        two = self._effect(second, sigma)
        case = self._build("pair", one.kind.needs, (one, two))
        train, holdout = self._pools[two.kind.needs]
        return CaseSpec(case.id, "pair", case.seed, case.baseline,
                        (case.train[0], case.train[1], train[0]), (case.holdout[0], holdout[0]),
                        case.effects, (), case.missing, case.dropouts)

    def _sensor(self, name: str, sigma: float) -> CaseSpec:
        rng = np.random.default_rng([self._seed + 1, 79])
        kind = FAULTS[name]
        fault = FaultSpec(name, int(rng.integers(len(kind.places))),
                          float(rng.choice([-1.0, 1.0])), sigma)
        return self._build("sensor", kind.needs, (), (fault,))
