"""All recordings of a case as one linear system with priors on the normal imperfections.

Validated with: test/diagnosis/test_sensors_windows.py, test/diagnosis/test_sensors_solve.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.case import Applied, Case, asked, undone
from truck_blowout_sim.diagnosis.sensors.distortions import Distortion
from truck_blowout_sim.diagnosis.sensors.rows import Rows, build_rows, whiten
from truck_blowout_sim.diagnosis.sensors.slow import SlowRows, slow_rows

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class System:
    """Rows of every recording at given faults taken out.

    Attributes:
        case: what was asked.
        faults: distortions that have columns here.
        rows: of each recording; ``None`` where no identity can be asked.
        slow: of each recording.
    """

    case: Case
    faults: tuple[Distortion, ...]
    rows: tuple[Rows | None, ...]
    slow: tuple[tuple[SlowRows, ...], ...]


def assemble(
    case: Case, applied: Sequence[Applied] = (), faults: Sequence[Distortion] | None = None
) -> System:
    """Build the rows of all recordings.

    Args:
        case: the recordings.
        applied: faults to take out first.
        faults: distortions to give columns; all candidates by default.
    """
    asked_for = case.faults if faults is None else tuple(dict.fromkeys(faults))
    columns = case.columns(asked_for)
    rows: list[Rows | None] = []
    slow = []
    for k, measured in enumerate(case.signals):
        clean = undone(measured, applied, baseline=case.is_baseline[k])
        identities = asked(case, clean)
        rows.append(
            build_rows(clean, identities, columns, case.noise[k], case.covariances[k])
            if identities
            else None
        )
        slow.append(slow_rows(clean, case.geometry, columns))
    return System(case, asked_for, tuple(rows), tuple(slow))


@dataclass(frozen=True)
class Normal:
    """Sums of squares of the whitened system: everything that tests need.

    Attributes:
        faults: distortions that have columns.
        gram: JᵀJ split by recordings (index 0) and baseline (index 1).
        right: Jᵀe, likewise.
        energy: eᵀe in total.
        count: valid rows.
    """

    faults: tuple[Distortion, ...]
    gram: tuple[FloatArray, FloatArray]
    right: tuple[FloatArray, FloatArray]
    energy: float
    count: int


def normal_equations(system: System, inflation: Mapping[str, float]) -> Normal:
    """Whiten and sum.

    Args:
        system: the rows.
        inflation: factor on the noise of each identity by name; 1 where not given.
    """
    size = len(system.case.columns(system.faults))
    gram = (np.zeros((size, size)), np.zeros((size, size)))
    right = (np.zeros(size), np.zeros(size))
    energy, count = 0.0, 0
    for k, is_baseline in enumerate(system.case.is_baseline):
        for _, e, j in whitened_parts(system.rows[k], system.slow[k], inflation):
            gram[int(is_baseline)][...] += j.T @ j
            right[int(is_baseline)][...] += j.T @ e
            energy += float(e @ e)
        rows = system.rows[k]
        count += sum(s.residual.size for s in system.slow[k])
        count += int(rows.valid.sum()) if rows is not None else 0
    return Normal(system.faults, gram, right, energy, count)


def whitened_parts(
    rows: Rows | None, slow: Sequence[SlowRows], inflation: Mapping[str, float]
) -> list[tuple[FloatArray, FloatArray, FloatArray]]:
    """Time, residual and slopes of a recording's whitened rows: slow relations, then bumps."""
    parts = []
    for s in slow:
        factor = inflation.get(s.identity.name, 1.0)
        parts.append((s.time_s, s.residual / factor, s.slopes / factor))
    if rows is not None:
        factors = np.array([inflation.get(i.name, 1.0) for i in rows.identities])
        time_s = np.repeat(rows.time_s, factors.size)
        parts.append((time_s, *whiten(rows, factors)))
    return parts
