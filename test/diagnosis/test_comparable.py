"""A tire that only training lost: what follows is no sign of something that the model lacks."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.case.trust import comparable_until_s
from truck_blowout_sim.diagnosis.locate.comparable import Left
from truck_blowout_sim.diagnosis.locate.left_over import mean_squares
from truck_blowout_sim.diagnosis.locate.wrench import missing_wrench
from truck_blowout_sim.recordings import Blowout

Studies = Callable[..., Study]
PUSHED = {"unit.trailer.probe_fy_n": 6000.0, "unit.trailer.probe_start_s": 2.4,
          "unit.trailer.probe_end_s": 4.4}


def lost_at(study: Study, time_s: float, run: int) -> Study:
    """The same case, one run of it with a tire lost on command."""
    runs = list(study.runs)
    recording = replace(runs[run].recording, blowouts=(Blowout(time_s, ("steer_left",)),))
    runs[run] = replace(runs[run], recording=recording)
    return replace(study, runs=tuple(runs))


def test_a_tire_that_only_training_lost_is_nothing_that_baseline_runs_tell_of(
    study_of: Studies
) -> None:
    sound = study_of(baseline=True)
    (train,), (baseline,) = sound.train, sound.baseline
    assert comparable_until_s(sound, sound.runs[train]) == np.inf
    lost = lost_at(sound, 2.0, train)
    assert comparable_until_s(lost, lost.runs[train]) == 2.0
    assert comparable_until_s(lost_at(lost, 3.0, baseline), lost.runs[train]) == np.inf
    alone = lost_at(study_of(), 2.0, 0)
    assert comparable_until_s(alone, alone.runs[0]) == np.inf


def test_what_a_lost_tire_does_is_not_judged(study_of: Studies) -> None:
    """A push from 2.4 to 4.4 s explains nothing of a run that counts up to 2 s only."""
    pushed = study_of(PUSHED, baseline=True)
    (train,) = pushed.train
    lost = lost_at(pushed, 2.0, train)
    found = {}
    for study in (pushed, lost):
        left = Left.of(study, study.models, comparable=True)
        assert left.worst(study) == train
        found[study is lost] = missing_wrench(study, train, "trailer", study.models, left=left)
    assert found[False].delta > 2.0 * found[False].degrees
    assert found[True].delta < 2.0 * found[True].degrees < 2.0 * found[False].degrees


def test_squares_are_those_of_the_rows_up_to_then(study_of: Studies) -> None:
    pushed = study_of(PUSHED, baseline=True)
    (train,), (baseline,) = pushed.train, pushed.baseline
    whole, before = mean_squares(pushed), mean_squares(lost_at(pushed, 2.0, train))
    assert whole[train] > 2.0 * whole[baseline]
    assert before[train] == pytest.approx(before[baseline], rel=1.0)
