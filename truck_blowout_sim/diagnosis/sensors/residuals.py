"""How well every identity holds, recording by recording, before and after.

Validated with: test/diagnosis/test_sensors_gate.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.findings import IdentityResidual
from truck_blowout_sim.diagnosis.sensors.identities import Identity
from truck_blowout_sim.diagnosis.sensors.search import SearchResult
from truck_blowout_sim.diagnosis.sensors.system import System

FloatArray = NDArray[np.float64]

_STRETCH = 10  # bumps of 0.1 s
_BROKEN_SIGMA = 1.5
_LEAST_ROWS = 30


def identity_residuals(result: SearchResult) -> tuple[IdentityResidual, ...]:
    """Residuals of every identity in every recording."""
    out = []
    before, after = result.before, result.after
    for k, signals in enumerate(before.case.signals):
        is_baseline = before.case.is_baseline[k]
        usual = result.usual_in_baseline if is_baseline else result.usual
        after_by_name = {n: (v, s) for _, _, v, s, n in _series(after, k, usual)}
        zero = np.zeros_like(result.usual)
        for identity, time_s, value, sigma, name in _series(before, k, zero):
            later = after_by_name.get(name)
            out.append(_statistics(identity, signals.name, time_s, value, sigma, later))
    return tuple(out)


def broken_identities(
    result: SearchResult, residuals: tuple[IdentityResidual, ...]
) -> tuple[str, ...]:
    """Identities that scatter well beyond their noise even after all corrections."""
    names = dict.fromkeys(r.identity for r in residuals if r.count >= _LEAST_ROWS)
    return tuple(name for name in names if result.inflation.get(name, 1.0) > _BROKEN_SIGMA)


def _series(
    system: System, k: int, usual: FloatArray
) -> list[tuple[Identity, FloatArray, FloatArray, FloatArray, str]]:
    """Identity, time, residual, sigma and name of each identity of one recording."""
    found = []
    rows = system.rows[k]
    if rows is not None:
        left = rows.residual - rows.slopes[:, :, : usual.size] @ usual
        sigma = np.sqrt(rows.variance)
        for a, identity in enumerate(rows.identities):
            valid = rows.valid[:, a]
            if valid.any():
                found.append((identity, rows.time_s[valid], left[valid, a], sigma[valid, a],
                              identity.name))  # fmt: skip
    for slow in system.slow[k]:
        left = slow.value - slow.raw_slopes[:, : usual.size] @ usual
        found.append((slow.identity, slow.time_s, left, slow.sigma, slow.identity.name))
    return found


def _statistics(
    identity: Identity, recording: str, time_s: FloatArray, value: FloatArray, sigma: FloatArray,
    later: tuple[FloatArray, FloatArray] | None,
) -> IdentityResidual:  # fmt: skip
    after = float(np.sqrt(np.mean((later[0] / later[1]) ** 2))) if later else float("nan")
    return IdentityResidual(
        identity=identity.name,
        recording=recording,
        equation=identity.equation,
        unit=identity.unit,
        count=value.size,
        sigma=float(np.median(sigma)),
        rms=float(np.sqrt(np.mean(value**2))),
        rms_sigma=float(np.sqrt(np.mean((value / sigma) ** 2))),
        rms_sigma_after=after,
        mean=float(value.mean()),
        time_s=_stretches(time_s),
        stretch_sigma=_stretches(value / sigma),
        stretch_sigma_after=_stretches(later[0] / later[1]) if later else np.zeros(0),
    )


def _stretches(values: FloatArray) -> FloatArray:
    parts = np.array_split(values, max(1, values.size // _STRETCH))
    return np.array([float(part.mean()) for part in parts])
