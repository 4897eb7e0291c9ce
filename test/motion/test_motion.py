"""Where parts of a truck were: what is recorded is kept, what is not follows from what is."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim import Blowout, InputError, Recording, Series, Vehicle, load_vehicle
from truck_blowout_sim.motion import motion_of

TIME = np.arange(0.0, 10.001, 0.01)
SPEED, RATE = 10.0, 0.1  # m/s and rad/s: a circle of 100 m


@pytest.fixture(scope="module")
def vehicle() -> Vehicle:
    return load_vehicle("international_9400i_trailmobile")


def recording(blowouts: tuple[Blowout, ...] = (), **channels: float | np.ndarray) -> Recording:
    series = {name: Series(TIME, np.broadcast_to(value, TIME.shape))
              for name, value in channels.items()}
    return Recording("run", series, blowouts)


def test_a_path_follows_from_speed_and_yaw_rate(vehicle: Vehicle) -> None:
    motion = motion_of(recording(tractor_vx_mps=SPEED, tractor_yaw_rate_radps=RATE), vehicle)
    track = motion.units["tractor"]
    radius = SPEED / RATE
    assert track.x_m[-1] == pytest.approx(radius * math.sin(1.0), abs=0.01)
    assert track.y_m[-1] == pytest.approx(radius * (1 - math.cos(1.0)), abs=0.01)
    assert any("integrated" in words for words in motion.assumptions)


def test_recorded_positions_are_kept_and_say_nothing(vehicle: Vehicle) -> None:
    motion = motion_of(recording(tractor_x_m=3.0 * TIME, tractor_y_m=7.0, tractor_yaw_rad=0.0,
                                 tractor_vx_mps=99.0), vehicle)
    assert motion.units["tractor"].x_m[-1] == pytest.approx(30.0)
    assert motion.units["tractor"].y_m == pytest.approx(7.0)
    assert not any("place of the tractor" in words for words in motion.assumptions)


def test_a_trailer_without_instruments_cuts_the_corner_by_the_tractrix(vehicle: Vehicle) -> None:
    """On a long circle an axle towed without slip runs on the radius sqrt(R^2 - L^2)."""
    slow = recording(tractor_vx_mps=20.0, tractor_yaw_rate_radps=0.2)
    motion = motion_of(slow, vehicle)
    tractor, trailer = motion.units["tractor"], motion.units["trailer"]
    fold = trailer.yaw_rad[-1] - tractor.yaw_rad[-1]
    reach, kingpin = 11.2265, 2.42 - 5.50  # behind the kingpin; kingpin ahead of base_link
    radius = math.hypot(100.0, kingpin)
    assert fold == pytest.approx(-(math.asin(reach / radius) + math.asin(-kingpin / radius)),
                                 abs=0.005)


def test_a_trailer_without_instruments_is_as_high_as_its_tractor(vehicle: Vehicle) -> None:
    """A satellite receiver gives the altitude of the tractor; the trailer hangs on it."""
    level = motion_of(recording(tractor_vx_mps=SPEED), vehicle).units
    high = motion_of(recording(tractor_vx_mps=SPEED, tractor_z_m=200.0), vehicle).units
    assert high["tractor"].z_m == pytest.approx(200.0)
    drop_m = level["tractor"].z_m[0] - level["trailer"].z_m[0]
    assert high["tractor"].z_m - high["trailer"].z_m == pytest.approx(drop_m)


def test_the_kingpin_holds_both_units_together(vehicle: Vehicle) -> None:
    motion = motion_of(recording(tractor_vx_mps=SPEED, tractor_yaw_rate_radps=RATE,
                                 articulation_rad=-0.3), vehicle)
    a, b = motion.units["tractor"], motion.units["trailer"]
    front, own = 2.42 - 5.50, 5.613
    assert a.x_m + front * np.cos(a.yaw_rad) == pytest.approx(b.x_m + own * np.cos(b.yaw_rad))
    assert a.y_m + front * np.sin(a.yaw_rad) == pytest.approx(b.y_m + own * np.sin(b.yaw_rad))
    assert b.yaw_rad - a.yaw_rad == pytest.approx(-0.3)


def test_a_blown_tire_without_gauge_is_flat_after_half_a_second(vehicle: Vehicle) -> None:
    run = recording((Blowout(4.0, ("steer_left",)),), tractor_vx_mps=SPEED)
    wheel = motion_of(run, vehicle).wheels["steer_left"]
    at = {t: round(t * 50) for t in (3.9, 4.5, 10.0)}
    assert wheel.air["steer_left"][at[3.9]] == 1.0
    assert wheel.air["steer_left"][at[4.5]] == pytest.approx(0.0)
    assert wheel.height_m[at[10.0]] == pytest.approx(vehicle.blowout.rim_contact_radius_m)


def test_a_twin_carries_the_wheel_beside_a_flat_one(vehicle: Vehicle) -> None:
    run = recording((Blowout(4.0, ("drive_1_left_outer",)),), tractor_vx_mps=SPEED)
    wheel = motion_of(run, vehicle).wheels["drive_1_left"]
    assert wheel.air["drive_1_left_outer"][-1] == pytest.approx(0.0)
    assert np.ptp(wheel.height_m) == pytest.approx(0.0)


def test_road_wheels_follow_the_hand_wheel_over_the_ratio(vehicle: Vehicle) -> None:
    wheels = motion_of(recording(steering_wheel_angle_rad=2.2), vehicle).wheels
    assert wheels["steer_left"].steer_rad == pytest.approx(2.2 / 22)
    assert not wheels["drive_1_left"].steer_rad.any()


def test_a_heading_that_jumps_by_a_turn_does_not_spin_the_truck(vehicle: Vehicle) -> None:
    yaw = np.where(TIME < 5.0, math.pi - 0.001, -math.pi + 0.001)
    motion = motion_of(recording(tractor_yaw_rad=yaw, tractor_x_m=-TIME, tractor_y_m=0.0), vehicle)
    assert np.ptp(motion.units["tractor"].yaw_rad) < 0.01


def test_an_empty_recording_and_a_foreign_tire_are_refused(vehicle: Vehicle) -> None:
    with pytest.raises(InputError, match="no samples"):
        motion_of(Recording("empty", {}), vehicle)
    with pytest.raises(InputError, match="front_left"):
        motion_of(recording((Blowout(1.0, ("front_left",)),), throttle=0.0), vehicle)


def test_the_2013_record_moves(vehicle: Vehicle) -> None:
    from truck_blowout_sim import read_recording

    path = Path(__file__).parents[2] / "config/recordings/test_2013_steer_blowout.csv"
    motion = motion_of(read_recording(path), vehicle)
    assert motion.units["tractor"].x_m[-1] - motion.units["tractor"].x_m[0] > 300
    assert any("roll of the tractor: none" in words for words in motion.assumptions)
