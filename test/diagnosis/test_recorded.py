"""Recordings become runs of their role, corrected where an instrument was at fault."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case import recorded
from truck_blowout_sim.diagnosis.case.recorded import Recorded
from truck_blowout_sim.diagnosis.case.resume import Keeps
from truck_blowout_sim.diagnosis.effort import QUICK
from truck_blowout_sim.diagnosis.sensors import SensorFinding
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.vehicle import Packed

RATE = "tractor_yaw_rate_radps"


@pytest.fixture
def case(truck: Packed, few: Settings, drive_it: Callable[..., Recording]) -> Recorded:
    train, baseline, holdout = (drive_it(seed=k, name=f"run {k}") for k in (1, 2, 3))
    return Recorded([train], [baseline], [holdout], truck, few, QUICK, workers=2)


def test_every_recording_has_its_role(case: Recorded) -> None:
    study = case.study()
    assert [(run.recording.name, run.role) for run in (*study.runs, *study.holdout)] == [
        ("run 2", "baseline"), ("run 1", "train"), ("run 3", "holdout")]
    assert [one.name for one in case.every] == ["run 1", "run 2", "run 3"]
    assert (study.workers, study.refits) == (2, QUICK.refits)


@pytest.mark.parametrize("in_baseline", [True, False])
def test_an_instrument_is_corrected_where_it_was_at_fault(
    case: Recorded, monkeypatch: pytest.MonkeyPatch, in_baseline: bool
) -> None:
    def shifted(recording: Recording, findings: list[SensorFinding]) -> Recording:
        shift = 0.1 * len(findings)
        series = recording[RATE]
        return Recording(recording.name, {
            **recording.channels, RATE: Series(series.time_s, series.value + shift)})

    monkeypatch.setattr(recorded, "correct", shifted)
    finding = cast(SensorFinding, SimpleNamespace(in_baseline=in_baseline))
    plain, corrected = case.study(), case.study([finding])
    moved = [float(np.nanmean((b.measured - a.measured)[:, a.channels.index(RATE)]))
             for a, b in zip((*plain.runs, *plain.holdout), (*corrected.runs, *corrected.holdout),
                             strict=True)]
    assert moved == pytest.approx([0.1 * in_baseline, 0.1, 0.1])


def test_what_was_simulated_before_is_known(case: Recorded) -> None:
    kept = cast(Keeps, SimpleNamespace(simulated=object(), simulated_abreast=object()))
    study = Recorded(case.train, (), (), case.packed, case.rules, kept=kept).study()
    assert study.simulated is kept.simulated
    assert study.simulated_abreast is kept.simulated_abreast
