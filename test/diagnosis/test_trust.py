"""Where the model is believed less: near the limit of grip."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.case.trust import grip_mps2, grip_used
from truck_blowout_sim.diagnosis.effects.base import AT_THE_LIMIT

Studies = Callable[..., Study]


def test_grip_is_used_the_more_the_less_there_is(study_of: Studies) -> None:
    study = study_of()
    usual = grip_used(study).side
    assert 0.02 < usual < 0.5
    slippery = replace(study, packed=study.packed.with_values({"world.friction_scale": 0.5}))
    assert grip_used(slippery).side == pytest.approx(2.0 * usual)
    icy = replace(study, packed=study.packed.with_values({"world.friction_scale": 0.01}))
    assert grip_used(icy) == AT_THE_LIMIT


def test_without_the_yaw_rate_no_turn_counts(study_of: Studies) -> None:
    study = study_of()
    runs = tuple(replace(run, channels=tuple(
        name.replace("yaw_rate", "other") for name in run.channels)) for run in study.runs)
    assert grip_used(replace(study, runs=runs)).side == 0.0


def test_braking_uses_grip_in_another_direction(study_of: Studies) -> None:
    """Braked by 3 m/s2 while it turns as before, by recording or by model."""
    study = study_of()
    before = grip_used(study)
    i, = study.train[:1]
    run = study.runs[i]
    speed = run.channels.index("tractor_vx_mps")
    slower = study.models[i].copy()
    slower[:, speed] -= 3.0 * (run.edges_s[1:] - run.edges_s[0])
    study.models[i] = slower
    braked = grip_used(study)
    assert braked.side == pytest.approx(before.side)
    assert braked.whole > max(before.whole, 3.0 / grip_mps2(study.packed) - 0.05)
    assert braked.whole <= np.hypot(before.side, before.whole + 3.0 / grip_mps2(study.packed))
