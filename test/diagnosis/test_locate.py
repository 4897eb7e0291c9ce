"""Synthetic wrenches: body, time, line of action."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.locate.wrench import missing_wrench

Studies = Callable[..., Study]


def push(body: str, fy_n: float, x_m: float) -> dict[str, float]:
    """A side force on a body from 2.4 to 4.4 s, ``x_m`` forward of base_link."""
    return {f"unit.{body}.probe_fy_n": fy_n, f"unit.{body}.probe_mz_nm": fy_n * x_m,
            f"unit.{body}.probe_start_s": 2.4, f"unit.{body}.probe_end_s": 4.4}


@pytest.mark.parametrize(("body", "fy_n", "x_m"), [("trailer", 6000.0, 3.0),
                                                   ("tractor", -4000.0, 1.5)])
def test_a_push_is_found_on_its_body_in_its_time_along_its_line(
    study_of: Studies, body: str, fy_n: float, x_m: float
) -> None:
    study = study_of(push(body, fy_n, x_m))
    found = {b: missing_wrench(study, 0, b, study.models) for b in ("tractor", "trailer")}
    other = next(b for b in found if b != body)
    right = found[body]
    assert right.delta > found[other].delta
    assert right.delta > 2.0 * right.degrees
    history = right.history
    assert (history.body, history.recording) == (body, "run 1")
    during = (history.time_s > 2.4) & (history.time_s < 4.4)
    room = 4.0 * history.fy_sigma_n[during].max()
    np.testing.assert_allclose(history.fy_n[during], fy_n, atol=room)
    assert np.abs(history.fy_n[during]).min() > 2.0 * np.abs(history.fy_n[~during]).max()
    assert right.x_m == pytest.approx(x_m, abs=max(3.0 * right.x_sigma_m, 0.3))
    assert right.x_sigma_m < 2.0


def test_where_nothing_is_missing_no_line_of_action_is_claimed(study_of: Studies) -> None:
    study = study_of()
    found = missing_wrench(study, 0, "trailer", study.models)
    assert found.delta < 2.0 * found.degrees
    z = np.abs(found.history.fy_n) / found.history.fy_sigma_n
    assert z.max() < 4.0
    assert found.x_m == np.inf or found.x_sigma_m > 0.0
