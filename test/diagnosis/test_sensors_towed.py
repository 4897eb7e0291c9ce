from __future__ import annotations

import numpy as np
import pytest
import trial_faults as faults
from trial_drive import make_run

from truck_blowout_sim.diagnosis.sensors import sensor_gate, stated_geometry
from truck_blowout_sim.diagnosis.sensors.signals import read_signals
from truck_blowout_sim.diagnosis.sensors.towed import (
    BEND,
    ROLL,
    bend_change,
    hitch_force,
    with_reckoned,
)
from truck_blowout_sim.diagnosis.sensors.windows import make_windows
from truck_blowout_sim.recordings import Recording

LOST = ("x_m", "y_m", "yaw_rad", "roll_rad", "pitch_rad", "vx_mps", "vy_mps")


def bare(run: Recording) -> Recording:
    return run.without_channels([f"trailer_{stem}" for stem in LOST])


RUNS = [bare(make_run(60 + k, 15.0)) for k in range(3)]
BASELINE = [bare(make_run(70, 15.0))]


def test_reckoned_roll_and_bend_follow_the_truth() -> None:
    run = make_run(1, 15.0, noise=0.0)
    reckoned = with_reckoned(read_signals(bare(run)))
    bend = run["trailer_yaw_rad"].value - run["tractor_yaw_rad"].value
    assert reckoned[ROLL] == pytest.approx(run["trailer_roll_rad"].value, abs=0.004)
    assert reckoned[BEND] == pytest.approx(bend, abs=0.01)
    change, sigma = bend_change(reckoned, stated_geometry([run]))
    assert change == pytest.approx(bend[-1] - bend[0], abs=2.0 * sigma)


def test_force_at_the_hitch_is_one() -> None:
    run = bare(make_run(1, 15.0, noise=0.0))
    signals = with_reckoned(read_signals(run))
    (identity,) = hitch_force(signals, stated_geometry([run]))
    windows = make_windows(signals.period_s)
    left = windows.mean(identity.algebraic(signals))
    for channel, factor in identity.rates:
        left -= factor * windows.derivative(signals[channel])
    assert np.sqrt(np.mean(left**2)) < 0.05
    assert np.std(run["trailer_ay_mps2"].value) > 0.5


def test_it_is_not_asked_where_the_velocity_says_more() -> None:
    run = make_run(1, 8.0)
    assert hitch_force(read_signals(run), stated_geometry([run])) == ()


def test_sound_runs_stay_clean() -> None:
    result = sensor_gate(RUNS, BASELINE)
    assert result.clean
    asked = {r.identity for r in result.identities}
    assert {"hitch force sideways", "yaw rates of both units"} <= asked


def test_a_biased_trailer_gyro_is_found() -> None:
    spoilt = [faults.offset("trailer_yaw_rate_radps", np.radians(0.3))(run) for run in RUNS]
    (finding,) = sensor_gate(spoilt, BASELINE).findings
    assert (finding.name, finding.body) == ("yaw_rate_bias", "trailer")
    assert finding.parameters["bias"].value == pytest.approx(np.radians(0.3), rel=0.3)


def test_a_wrong_gain_of_the_trailer_accelerometer_is_found() -> None:
    spoilt = [faults.scaled("trailer_ay_mps2", 0.15)(run) for run in RUNS]
    (finding,) = sensor_gate(spoilt, BASELINE).findings
    assert "lateral_accel_scale" in finding.aliases
    assert finding.body == "trailer"
