"""The sensor gate: is an instrument at fault, before any vehicle model is asked?

References: fault isolation by parity relations, e.g. R. Isermann, Fault-Diagnosis Systems (2006),
chapter 10; here the parity relations are kinematic identities in weak form.
Known limits: channels that no identity reads (pressures, throttle) pass unchecked and are listed;
a fault shared by all instruments of the truck alike cannot show.
Validated with: test/diagnosis/test_sensors_gate.py; figures in docs/diagnosis_sensors.md.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.algebra.threads import one_blas_thread
from truck_blowout_sim.diagnosis.sensors.case import Case, make_case, undone
from truck_blowout_sim.diagnosis.sensors.conventions import FoundConvention, find_conventions
from truck_blowout_sim.diagnosis.sensors.findings import Amount, GateResult, SensorFinding
from truck_blowout_sim.diagnosis.sensors.geometry import Geometry, stated_geometry
from truck_blowout_sim.diagnosis.sensors.judgement import FALSE_ALARMS, determined
from truck_blowout_sim.diagnosis.sensors.residuals import broken_identities, identity_residuals
from truck_blowout_sim.diagnosis.sensors.search import Found, SearchResult, applied, search
from truck_blowout_sim.diagnosis.sensors.signals import read_signals
from truck_blowout_sim.diagnosis.sensors.steering import late_hand_wheel, steering_zero
from truck_blowout_sim.diagnosis.sensors.words import equation, next_test, sentence
from truck_blowout_sim.recordings import Recording

FloatArray = NDArray[np.float64]
_ALL_OF_IT_SIGMAS = 3.0  # a leak as near as this to all of gravity may be all of it


@one_blas_thread
def sensor_gate(
    recordings: Sequence[Recording],
    baseline: Sequence[Recording] = (),
    geometry: Geometry | None = None,
    false_alarms: float = FALSE_ALARMS,
) -> GateResult:
    """Check the instruments of a case against kinematics.

    Args:
        recordings: runs that may have a fault; one individual truck, one set of instruments.
        baseline: runs of the same truck in which the effect is not at work; they show what its
            normal mounting errors are.
        geometry: lengths of the combination; instrument positions that the recordings' metadata
            state take precedence.
        false_alarms: share of sound logs in which anything may be named.

    Returns:
        Findings, residuals of every identity, what could not be asked.

    Raises:
        InputError: a recording has no motion channel.
        ValueError: no recording is given.
    """
    if not recordings:
        raise ValueError("at least one recording is needed")
    stated, recordings, baseline = _as_meant(recordings, baseline, geometry)
    case = make_case(recordings, baseline, geometry)
    result = search(case, false_alarms)
    findings = [*stated]
    findings += [
        _finding(found, case.signals[0].gravity.get(found.hypothesis.distortion.unit, 1.0),
                 knows_roll=_has_roll(case, found.hypothesis.distortion.unit))
        for found in result.found
    ]
    signals = [
        undone(s, applied(result.found), baseline=b)
        for s, b in zip(case.signals, case.is_baseline, strict=True)
    ]
    zero, wheel, notes = steering_zero(signals, case.is_baseline, case.geometry.steering_ratio)
    late = late_hand_wheel(signals, case.is_baseline)
    findings += [one for one in (late, wheel) if one is not None]
    residuals = identity_residuals(result)
    return GateResult(
        findings=tuple(findings),
        identities=residuals,
        broken=broken_identities(result, residuals),
        untestable=_untestable(case, recordings, result),
        steering=zero,
        inflation=result.inflation,
        chi2=result.chi2,
        rows=result.rows,
        mounting=_mounting(case, result),
        notes=(*_notes(case), *notes),
    )


def _as_meant(
    recordings: Sequence[Recording], baseline: Sequence[Recording], geometry: Geometry | None
) -> tuple[list[SensorFinding], list[Recording], list[Recording]]:
    """Signs, axes and gravity that are not as stated, and the recordings read as they are meant."""
    everything = [*recordings, *baseline]
    flags = [False] * len(recordings) + [True] * len(baseline)
    found = find_conventions([read_signals(r) for r in everything], flags,
                             stated_geometry(everything, geometry))  # fmt: skip
    runs, sound = list(recordings), list(baseline)
    for one in found:
        runs = [one.convention.mended(r) for r in runs]
        sound = [one.convention.mended(r) for r in sound] if one.everywhere else sound
    return [_convention(one) for one in found], runs, sound


def _convention(found: FoundConvention) -> SensorFinding:
    kind = found.convention
    names = tuple(dict.fromkeys([kind.name, *(rival.name for rival in found.rivals),
                                 *found.amounts]))
    return SensorFinding(
        name=kind.name,
        body=kind.unit,
        instrument=kind.instrument,
        channels=kind.channels,
        parameters={},
        delta_chi2=2.0 * found.log_ratio,
        p_value=min(1.0, found.tests * float(np.exp(-found.log_ratio))),
        aliases=names,
        in_baseline=found.everywhere,
        sentence=sentence(kind, (), ()),
        equation=equation(kind.name),
        next_test=next_test(kind.name, names),
        distortion=kind,
    )


def _finding(found: Found, gravity: float, *, knows_roll: bool) -> SensorFinding:
    distortion = found.hypothesis.distortion
    names = tuple(dict.fromkeys([distortion.name, *[h.distortion.name for h, _ in found.rivals]]))
    if distortion.name == "lateral_accel_scale" and not knows_roll:
        # Roll follows lateral acceleration: without its channel a leak looks like a gain.
        names = tuple(dict.fromkeys([*names, "lateral_accel_roll"]))
    sigmas = np.sqrt(np.diag(found.covariance))
    if distortion.name == "lateral_accel_roll" and np.isclose(
            found.amounts[0], 1.0 - 2.0 * gravity, atol=_ALL_OF_IT_SIGMAS * sigmas[0]):
        # all of gravity, which the recording says is read or is not
        names = tuple(dict.fromkeys([*names, "gravity_convention"]))
    shown = determined(found.amounts, sigmas)
    parameters = {
        name: Amount.about(value, unit, sigma)
        for k, ((name, unit), value, sigma) in enumerate(
            zip(distortion.parameters, found.amounts, sigmas.tolist(), strict=True)
        )
        if k in shown
    }
    kept = [list(distortion.parameters).index((n, a.unit)) for n, a in parameters.items()]
    return SensorFinding(
        name=distortion.name,
        body=distortion.unit,
        instrument=distortion.instrument,
        channels=distortion.channels,
        parameters=parameters,
        delta_chi2=found.delta_chi2,
        p_value=found.p_value,
        aliases=names,
        in_baseline=found.hypothesis.everywhere,
        sentence=sentence(distortion, found.amounts, sigmas.tolist(), kept),
        equation=equation(distortion.name),
        next_test=next_test(distortion.name, names),
        distortion=distortion,
    )


def _has_roll(case: Case, unit: str) -> bool:
    return any(f"{unit}_roll_rad" in signals for signals in case.signals)


def _mounting(case: Case, result: SearchResult) -> Mapping[str, Amount]:
    out = {}
    k = 0
    for item in case.usual:
        for (name, unit), usual in zip(item.distortion.parameters, item.usual, strict=True):
            value = float(result.usual[k])
            label = f"{item.distortion.name} of {item.distortion.instrument} ({name})"
            sigma = min(usual, float(result.usual_sigma[k]))
            out[label] = Amount.about(value, unit, sigma)
            k += 1
    return out


def _untestable(
    case: Case, recordings: Sequence[Recording], result: SearchResult
) -> tuple[str, ...]:
    read: set[str] = set()
    for rows, slow in zip(result.before.rows, result.before.slow, strict=True):
        if rows is not None:
            for a, identity in enumerate(rows.identities):
                if rows.valid[:, a].any():
                    read.update(identity.channels)
        read.update(c for row in slow for c in row.identity.channels)
    present = {name for recording in recordings for name in recording.channels}
    return tuple(sorted(present - read))


def _notes(case: Case) -> tuple[str, ...]:
    notes = []
    if not case.geometry.knows_hitch and any("trailer_vx_mps" in s for s in case.signals):
        notes.append("hitch identities not asked: metadata do not state where instruments sit")
    if not any(case.is_baseline) and case.radii:
        notes.append("no baseline: hub speeds show changes, not a common gain of the speed channel")
    unsaid = [s for s in case.signals if "tractor_roll_rad" not in s]
    if unsaid:
        notes.append("roll not recorded: gravity in the lateral acceleration cannot be taken out")
    return tuple(notes)
