"""What trucks of a world differ by when they are given the same commands: at least 100 of them.

One run stands for a class of manoeuvres. Each truck of the world, nothing missing, repeats the
commands of that run; the channels' cosine coefficients up to 5 Hz are kept, one file a run.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.fft import dct

from proving_ground.build import CaseBuilder, Run, Values, onset
from proving_ground.cases import CaseSpec, EffectSpec
from proving_ground.channels import COMMANDS
from proving_ground.generate import builder
from proving_ground.layout import FloatArray

HIGHEST_HZ, RATE_HZ = 5.0, 100.0
LEFT_OUT = ("_x_m", "_y_m", "_yaw_rad")
DRIVEN_SEED = 71
FIRST_NULL = {"w2": 6_100_000, "w3": 6_200_000}


def coefficients(values: Values, duration_s: float) -> tuple[list[str], FloatArray]:
    """Channels and their orthonormal cosine coefficients up to 5 Hz, channels x coefficients.

    A run that ended early is continued with its last values: a truck that stops is known to.
    """
    names = [n for n in values if n not in COMMANDS and not n.endswith(LEFT_OUT)]
    length, most = round(duration_s * RATE_HZ), round(2.0 * duration_s * HIGHEST_HZ)
    rows = []
    for name in names:
        signal = values[name][:length]
        padded = np.concatenate([signal, np.full(length - len(signal), signal[-1])])
        rows.append(dct(padded, norm="ortho")[:most])
    return names, np.array(rows)


class Nulls:
    """Nulls of one world, run by run; what was simulated once is read again."""

    def __init__(self, world: str, folder: Path, trucks: int) -> None:
        self.world, self.folder, self.trucks = world, folder / world, trucks
        self._spreads: dict[tuple[str, bool], tuple[list[str], FloatArray]] = {}

    def builder(self, number: int, kind: str) -> CaseBuilder:
        """The builder of a truck of this world with one run of a kind."""
        spec = CaseSpec(f"n-{number}", "null", FIRST_NULL[self.world] + number, (), (kind,),
                        (kind,), truth=self.world)
        return builder(spec)

    @cached_property
    def leaders(self) -> dict[str, Run]:
        """The run whose commands all repeat, by kind."""
        return {}

    def leader(self, kind: str) -> Run:
        """The run of a kind with its commands."""
        if kind not in self.leaders:
            made = self.builder(0, kind)
            _, manoeuvre, _ = made.runs[0]
            self.leaders[kind] = made._drive(manoeuvre, [], DRIVEN_SEED, even=True)
        return self.leaders[kind]

    def spread(self, kind: str, even: bool = True) -> tuple[list[str], FloatArray]:
        """Channels, and coefficients of all trucks: trucks x channels x coefficients.

        On an even road, or each on a road of its own. Simulated or read once.
        """
        if (kind, even) not in self._spreads:
            self._spreads[kind, even] = self._spread(kind, even)
        return self._spreads[kind, even]

    def _spread(self, kind: str, even: bool) -> tuple[list[str], FloatArray]:
        path = self.folder / f"{kind}{'' if even else '_on_own_roads'}.npz"
        if path.is_file():
            kept = np.load(path)
            if len(kept["values"]) >= self.trucks:
                return [str(n) for n in kept["names"]], kept["values"][:self.trucks]
        leader, rows = self.leader(kind), []
        names: list[str] = []
        for number in range(1, self.trucks + 1):
            made = self.builder(number, kind)
            names, row = coefficients(made.clean(made._replay(leader, [], even)),
                                      leader.manoeuvre.duration_s)
            rows.append(row)
        self.folder.mkdir(parents=True, exist_ok=True)
        np.savez_compressed(path, names=np.array(names), values=np.array(rows, dtype=np.float32))
        return names, np.array(rows)

    def course(self, case: CaseSpec, kind: str) -> Course:
        """A case's own truck in the run of a kind."""
        made, leader = builder(replace(case, rough=False)), self.leader(kind)
        plain = coefficients(made.clean(made._replay(leader, [])), leader.manoeuvre.duration_s)[1]
        return Course(case, made, leader, plain)


@dataclass(frozen=True)
class Course:
    """A case's truck on the commands of a leader: `plain` is what it does with nothing missing."""

    case: CaseSpec
    made: CaseBuilder
    leader: Run
    plain: FloatArray

    def signature(self, effect: EffectSpec, severity: float) -> FloatArray:
        """What an effect changes, channels x coefficients."""
        manoeuvre = self.leader.manoeuvre
        active = effect.at(severity, onset(manoeuvre, effect, self.case.seed))
        other = self.made.clean(self.made._replay(self.leader, [active]))
        return np.asarray(coefficients(other, manoeuvre.duration_s)[1] - self.plain)
