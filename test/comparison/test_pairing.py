from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim.comparison.pairing import pairs_of
from truck_blowout_sim.recordings import Recording, Series

FINE = np.linspace(0.0, 10.0, 1001)
COARSE = np.array([0.0, 0.5, 1.0, 2.0, 9.0, 9.5])


def made(times: np.ndarray, metadata: dict[str, str] | None = None, **values: object) -> Recording:
    series = {
        name: Series(times, np.broadcast_to(np.asarray(value, float), times.shape))
        for name, value in values.items()
    }
    return Recording("made", series, metadata=metadata or {})


def test_the_measured_instants_are_kept_gap_and_all() -> None:
    pairs = pairs_of(
        made(COARSE, tractor_vx_mps=2 * COARSE + 1), made(FINE, tractor_vx_mps=2 * FINE)
    )
    pair = pairs["tractor_vx_mps"]
    assert np.array_equal(pair.time_s, COARSE)
    assert pair.error == pytest.approx(np.full(6, -1.0))


def test_instants_that_the_model_did_not_reach_are_left_out() -> None:
    short = made(FINE[:201], tractor_vx_mps=0.0)
    pair = pairs_of(made(COARSE, tractor_vx_mps=1.0), short)["tractor_vx_mps"]
    assert pair.time_s.tolist() == [0.0, 0.5, 1.0, 2.0]


def test_inputs_and_spin_angles_are_not_compared() -> None:
    both = made(FINE, throttle=0.5, hub_spin_angle_steer_left_rad=FINE)
    assert not pairs_of(both, both)


def test_headings_are_compared_on_the_same_turn() -> None:
    wrapped = (FINE + np.pi) % (2 * np.pi) - np.pi
    pair = pairs_of(
        made(FINE, tractor_yaw_rad=wrapped + 2 * np.pi), made(FINE, tractor_yaw_rad=wrapped - 0.01)
    )["tractor_yaw_rad"]
    assert pair.error == pytest.approx(np.full(FINE.size, -0.01))


def test_position_errors_are_along_and_across_the_first_course() -> None:
    course = np.radians(30.0)
    x, y = 20 * FINE * np.cos(course), 20 * FINE * np.sin(course)
    ahead = (x + 3 * np.cos(course), y + 3 * np.sin(course))
    left = (ahead[0] - 0.5 * np.sin(course), ahead[1] + 0.5 * np.cos(course))
    model = made(FINE, tractor_x_m=left[0], tractor_y_m=left[1])
    for heading in ({}, {"tractor_yaw_rad": course}):
        pairs = pairs_of(made(FINE, tractor_x_m=x, tractor_y_m=y, **heading), model)
        assert pairs["tractor_along_m"].error == pytest.approx(np.full(FINE.size, 3.0))
        assert pairs["tractor_across_m"].error == pytest.approx(np.full(FINE.size, 0.5))
        assert pairs["tractor_along_m"].measured[0] == 0.0


def test_gravity_leaves_the_model_where_the_recording_is_free_of_it() -> None:
    roll, pitch, g = 0.05, 0.02, 9.81
    felt = {"ax": -g * np.sin(pitch), "ay": g * np.sin(roll) * np.cos(pitch),
            "az": g * np.cos(roll) * np.cos(pitch)}  # fmt: skip
    model = made(FINE, tractor_roll_rad=roll, tractor_pitch_rad=pitch,
                 **{f"tractor_{axis}_mps2": value for axis, value in felt.items()})  # fmt: skip
    zero = {f"tractor_{axis}_mps2": 0.0 for axis in felt}
    free = pairs_of(made(FINE, {"accelerometers": "gravity removed"}, **zero), model)
    strapdown = pairs_of(made(FINE, {"accelerometers": "strapdown"}, **zero), model)
    for axis, value in felt.items():
        name = f"tractor_{axis}_mps2"
        assert free[name].error == pytest.approx(np.zeros(FINE.size), abs=1e-12)
        assert strapdown[name].error == pytest.approx(np.full(FINE.size, value))
