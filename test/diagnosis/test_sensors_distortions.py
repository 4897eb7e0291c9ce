from __future__ import annotations

import numpy as np
import pytest
import trial_faults as faults
from trial_drive import make_run

from truck_blowout_sim.diagnosis.sensors.distortions import (
    Bias,
    Delay,
    Distortion,
    LevelAxes,
    LeverArm,
    RollLeak,
    Scale,
    Turn,
)
from truck_blowout_sim.diagnosis.sensors.identities import channel_names

EXACT = make_run(4, 12.0, noise=0.0)
N = channel_names("tractor")
CASES = [
    (Bias("yaw_rate_bias", "tractor", "", (N["r"],)), (0.01,), faults.offset(N["r"], 0.01)),
    (Scale("speed_scale", "tractor", "", (N["vx"],)), (0.03,), faults.scaled(N["vx"], 0.03)),
    (RollLeak("lateral_accel_roll", "tractor", "", (N["ay"],)), (0.4,),
     faults.leaking("tractor", 0.4)),
    (LeverArm("lever_arm", "tractor", "", (N["vx"], N["vy"])), (0.6, 0.0),
     faults.displaced("tractor", 0.6, "velocity")),
    (LeverArm("lever_arm", "tractor", "", (N["ay"],)), (0.6, 0.0),
     faults.displaced("tractor", 0.6, "accelerometer")),
    (LeverArm("lever_arm", "tractor", "", (N["x"], N["y"])), (0.6, 0.0),
     faults.displaced("tractor", 0.6, "position")),
]  # fmt: skip
IDS = [f"{case[0].name} {len(case[0].channels)} {case[0].channels[0]}" for case in CASES]


def read(name: str) -> np.ndarray:
    return EXACT[name].value


@pytest.mark.parametrize(("distortion", "amounts", "inject"), CASES, ids=IDS)
def test_a_known_amount_is_taken_out(
    distortion: Distortion, amounts: tuple[float, ...], inject: faults.Change
) -> None:
    spoilt = inject(EXACT)
    for channel in distortion.channels:
        series = spoilt[channel]
        time_s, value = distortion.undo(amounts, channel, series.time_s, series.value, read)
        error = np.abs(value - EXACT[channel].value)[20:-20].max()
        did = np.abs(series.value - EXACT[channel].value).max()
        assert np.array_equal(time_s, series.time_s)
        assert error < 1e-6 + 0.05 * did
    assert any(not np.array_equal(spoilt[c].value, EXACT[c].value) for c in distortion.channels)


def test_a_delay_is_taken_out_of_the_stamps() -> None:
    late = faults.delayed([N["r"]], 0.05)(EXACT)[N["r"]]
    time_s, value = Delay("channel_delay", "tractor", "", (N["r"],)).undo(
        (0.05,), N["r"], late.time_s, late.value, read
    )
    inside = time_s > 0.0
    assert value[inside] == pytest.approx(EXACT.at(N["r"], time_s[inside]), abs=1e-4)


@pytest.mark.parametrize(("distortion", "amounts", "inject"), CASES, ids=IDS)
def test_slopes_are_what_a_small_amount_does(
    distortion: Distortion, amounts: tuple[float, ...], inject: faults.Change
) -> None:
    spoilt = inject(EXACT)
    for channel in distortion.channels:
        slope = distortion.slope(0, channel, read, 0.01)
        did = (spoilt[channel].value - EXACT[channel].value) / amounts[0]
        assert slope[20:-20] == pytest.approx(did[20:-20], abs=0.05 * (1e-9 + np.abs(did).max()))


def test_a_turned_velocity_instrument_reads_speed_as_slip() -> None:
    turn = Turn("velocity_mounting", "tractor", "", (N["vx"], N["vy"]))
    assert turn.slope(0, N["vy"], read, 0.01) == pytest.approx(-EXACT[N["vx"]].value)
    assert turn.slope(0, N["vx"], read, 0.01) == pytest.approx(EXACT[N["vy"]].value)


def test_lever_arm_up_is_felt_by_roll_only() -> None:
    arm = LeverArm("lever_arm", "tractor", "", (N["vy"], N["vx"]), ("up",))
    assert arm.slope(0, N["vy"], read, 0.01) == pytest.approx(-EXACT[N["p"]].value)
    assert arm.slope(0, N["vx"], read, 0.01) == pytest.approx(EXACT[N["q"]].value)


def test_a_velocity_along_level_axes_lacks_what_a_pitched_body_has_as_it_rolls() -> None:
    level = LevelAxes("level_axes", "tractor", "", (N["vy"],))
    along = EXACT[N["vx"]].value * np.cos(EXACT[N["pitch"]].value)
    body = np.sin(EXACT[N["pitch"]].value) * np.sin(EXACT[N["roll"]].value) * along
    assert level.slope(0, N["vy"], read, 0.01) == pytest.approx(-body, rel=1e-3)
