from __future__ import annotations

import numpy as np
import pytest
from trial_drive import make_run

from truck_blowout_sim.diagnosis.sensors import sensor_gate, stated_geometry
from truck_blowout_sim.diagnosis.sensors.case import make_case
from truck_blowout_sim.diagnosis.sensors.geometry import Geometry
from truck_blowout_sim.diagnosis.sensors.hubs import free_rolling
from truck_blowout_sim.diagnosis.sensors.identities import (
    Identity,
    body_identities,
    hitch_identities,
)
from truck_blowout_sim.diagnosis.sensors.signals import Signals, read_signals
from truck_blowout_sim.diagnosis.sensors.slow import hitch_position, yaw_closure
from truck_blowout_sim.diagnosis.sensors.system import assemble
from truck_blowout_sim.diagnosis.sensors.windows import make_windows
from truck_blowout_sim.recordings import Blowout, Series

EXACT = make_run(1, 12.0, noise=0.0)
SIGNALS = read_signals(EXACT)
GEOMETRY = stated_geometry([EXACT])
WINDOWS = make_windows(SIGNALS.period_s)
# What is left is the harness's own sampling; channel noise under a bump is 10 to 100 times it.
TOLERANCE = {"m/s2": 0.006, "m/s": 0.003, "rad/s": 1e-4, "m": 2e-3}
UNITS = ("tractor", "trailer")
BODY = [identity for unit in UNITS for identity in body_identities(unit)]


def residual(identity: Identity, signals: Signals) -> np.ndarray:
    out = WINDOWS.mean(identity.algebraic(signals))
    for channel, factor in identity.rates:
        out = out - factor * WINDOWS.derivative(signals[channel])
    return out


@pytest.mark.parametrize("identity", [*BODY, *hitch_identities(GEOMETRY)], ids=lambda i: i.name)
def test_a_rigid_truck_on_a_level_path_breaks_no_identity(identity: Identity) -> None:
    assert np.abs(residual(identity, SIGNALS)).max() < TOLERANCE[identity.unit]


@pytest.mark.parametrize("identity", BODY, ids=lambda i: i.name)
def test_a_foreign_amount_in_any_needed_channel_breaks_it(identity: Identity) -> None:
    for channel in identity.needs:
        moved = SIGNALS.with_values({channel: 1.5 * SIGNALS[channel] + 0.4})
        change = np.abs(residual(identity, moved) - residual(identity, SIGNALS)).max()
        assert change > 3.0 * TOLERANCE[identity.unit], channel


@pytest.mark.parametrize("identity", hitch_position(GEOMETRY), ids=lambda i: i.name)
def test_the_hitch_has_one_position(identity: Identity) -> None:
    assert np.abs(identity.algebraic(SIGNALS)).max() < TOLERANCE["m"]


def test_both_units_turn_alike_over_a_run() -> None:
    mean = float(np.mean(yaw_closure().algebraic(SIGNALS)))
    bend = EXACT["trailer_yaw_rad"].value - EXACT["tractor_yaw_rad"].value
    assert mean == pytest.approx((bend[-1] - bend[0]) / EXACT.duration_s, abs=1e-4)


def test_gravity_that_was_removed_is_not_looked_for() -> None:
    roll = EXACT["tractor_roll_rad"].value
    pitch = EXACT["tractor_pitch_rad"].value
    series = EXACT["tractor_ay_mps2"]
    free = EXACT.with_channels(
        {series_name: Series(series.time_s, series.value - 9.81 * np.sin(roll) * np.cos(pitch))
         for series_name in ("tractor_ay_mps2",)}
    ).with_metadata(accelerometers="gravity removed")  # fmt: skip
    identity = body_identities("tractor")[0]
    assert np.abs(residual(identity, read_signals(free))).max() < TOLERANCE["m/s2"]


def test_braked_and_blown_wheels_are_not_asked() -> None:
    pressure = Series(SIGNALS.time_s, np.where(SIGNALS.time_s > 6.0, 2e5, 0.0))
    braked = EXACT.with_channels({"brake_pressure_trailer_pa": pressure})
    free = free_rolling(read_signals(braked), "trailer", Geometry())
    assert free[SIGNALS.time_s < 5.9].all()
    assert not free[SIGNALS.time_s > 6.1].any()
    blown = EXACT.__class__(
        "blown", EXACT.channels, (Blowout(3.0, ("steer_left",)),), EXACT.metadata
    )
    rows = assemble(make_case([blown], [], None), (), []).rows[0]
    assert rows is not None
    places = {i.name: k for k, i in enumerate(rows.identities)}
    asked = {unit: rows.time_s[rows.valid[:, places[f"{unit} hub speeds"]]]
             for unit in ("tractor", "trailer")}
    assert 2.0 < asked["tractor"].max() < 3.0
    assert asked["trailer"].max() > 5.0


def test_a_steered_wheel_is_asked_only_while_it_points_nearly_ahead() -> None:
    """Sliding straight on, a wheel steered by delta rolls at v cos(delta): v delta^2 / 2 slower."""
    speed_mps, ratio, radius_varies_mps = 20.0, 20.0, 0.01
    time_s = SIGNALS.time_s
    straight = {"tractor_vx_mps": Series(time_s, np.full_like(time_s, speed_mps)),
                "tractor_yaw_rate_radps": Series(time_s, np.zeros_like(time_s))}
    just_rad = np.sqrt(2.0 * radius_varies_mps / speed_mps)
    for share, asked in ((0.9, True), (1.1, False)):
        wheel = Series(time_s, np.full_like(time_s, -share * just_rad * ratio))
        turned = read_signals(EXACT.with_channels({**straight, "steering_wheel_angle_rad": wheel}))
        free = free_rolling(turned, "tractor", Geometry(steering_ratio=ratio))
        assert free.all() if asked else not free.any()
        assert free_rolling(turned, "trailer", Geometry(steering_ratio=ratio)).all()


def test_missing_channels_drop_their_identities_only() -> None:
    lean = EXACT.without_channels(["tractor_yaw_rad", "trailer_vx_mps"])
    rows = assemble(make_case([lean], [], None), (), []).rows[0]
    assert rows is not None
    assert {i.name for i in rows.identities} == {
        "tractor lateral acceleration", "tractor longitudinal acceleration", "tractor roll rate",
        "tractor pitch rate", "trailer heading rate", "trailer roll rate", "trailer pitch rate",
        "tractor hub speeds", "tractor speed against position",
    }  # fmt: skip


def test_speed_is_held_against_positions_where_no_lateral_speed_was_recorded() -> None:
    lean = make_run(60, 15.0).only_channels(["tractor_x_m", "tractor_y_m", "tractor_vx_mps"])
    assert sensor_gate([lean]).clean
    fast = lean.with_channels({"tractor_vx_mps": Series(lean["tractor_vx_mps"].time_s,
                                                        1.03 * lean["tractor_vx_mps"].value)})
    (finding,) = sensor_gate([fast]).findings
    assert finding.name == "speed_scale"
    assert finding.parameters["scale_error"].value == pytest.approx(0.03, abs=0.004)


def test_the_articulation_angle_is_held_against_both_yaw_rates() -> None:
    run = make_run(61, 15.0)
    time_s = run["tractor_yaw_rad"].time_s
    bend = run["trailer_yaw_rad"].value - run["tractor_yaw_rad"].value
    rates = run.only_channels(["tractor_yaw_rate_radps", "trailer_yaw_rate_radps"])
    rates = rates.with_channels({"articulation_rad": Series(time_s, bend)})
    assert sensor_gate([rates]).clean
    gyro = rates["tractor_yaw_rate_radps"]
    spoilt = rates.with_channels({"tractor_yaw_rate_radps": Series(time_s, gyro.value + 0.01)})
    (finding,) = sensor_gate([spoilt]).findings
    assert finding.name == "yaw_rate_bias"
    assert finding.body == "tractor"
    assert finding.parameters["bias"].value == pytest.approx(0.01, rel=0.1)
