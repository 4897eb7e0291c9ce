"""Where the model is believed less: from a braked flat tire on, and near the limit of grip."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.case.trust import flat_was_braked, grip_used
from truck_blowout_sim.recordings import Blowout
from truck_blowout_sim.vehicle import Packed

Studies = Callable[..., Study]
BRAKED_FROM_S = 4.8  # in every drive of these tests


@pytest.mark.parametrize(("blown_s", "from_s"), [
    (2.0, BRAKED_FROM_S), (5.6, 5.6), (np.inf, np.inf),
])
def test_a_flat_tire_is_believed_less_from_its_first_braking_on(
    study_of: Studies, truck: Packed, blown_s: float, from_s: float
) -> None:
    (run,) = study_of().runs
    events = (Blowout(blown_s, ("steer_left",)),) if np.isfinite(blown_s) else ()
    braked = flat_was_braked(replace(run.recording, blowouts=events), run.drive, truck,
                             run.edges_s)
    middles = 0.5 * (run.edges_s[1:] + run.edges_s[:-1])
    assert not braked[middles < from_s].any()
    assert braked[middles > from_s + 0.3].all()


def test_grip_is_used_the_more_the_less_there_is(study_of: Studies) -> None:
    study = study_of()
    usual = grip_used(study)
    assert 0.02 < usual < 0.5
    slippery = replace(study, packed=study.packed.with_values({"world.friction_scale": 0.5}))
    assert grip_used(slippery) == pytest.approx(2.0 * usual)
    icy = replace(study, packed=study.packed.with_values({"world.friction_scale": 0.01}))
    assert grip_used(icy) == 1.0


def test_without_the_yaw_rate_no_turn_counts(study_of: Studies) -> None:
    study = study_of()
    runs = tuple(replace(run, channels=tuple(
        name.replace("yaw_rate", "other") for name in run.channels)) for run in study.runs)
    assert grip_used(replace(study, runs=runs)) == 0.0
