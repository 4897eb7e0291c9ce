"""A run counts up to where vehicle and model slide apart; turns and poor gauges part nothing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.calibration import calibrate
from truck_blowout_sim.diagnosis.case.runs import parting_notes, prepare_run
from truck_blowout_sim.diagnosis.case.sliding import Parting, partings_of
from truck_blowout_sim.diagnosis.case.study import Study
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.vehicle import Packed

EDGES_S = np.linspace(0.0, 12.0, 121)
TIME_S = 0.5 * (EDGES_S[1:] + EDGES_S[:-1])
CHANNELS = ("tractor_yaw_rate_radps", "tractor_ay_mps2", "tractor_vx_mps",
            "trailer_yaw_rate_radps", "trailer_ay_mps2")
UNITS = ("tractor", "trailer")


def motion(rate: np.ndarray, ay: np.ndarray, speed: float = 20.0, *,
           trailer: np.ndarray | None = None) -> np.ndarray:
    """[n, 5] bins of a tractor, and of a trailer that follows it or turns at a rate of its own."""
    return np.stack([rate, ay, np.full(TIME_S.size, speed),
                     rate if trailer is None else trailer, ay], axis=1)


def turn(rate_radps: float = 0.3, speed: float = 20.0) -> tuple[np.ndarray, np.ndarray]:
    """Yaw rate and lateral acceleration of a turn on its path."""
    rate = rate_radps * np.minimum(TIME_S, 1.0)
    return rate, speed * rate


def parted(measured: np.ndarray, model: np.ndarray) -> Parting | None:
    """The first parting, of a run too short to be counted again."""
    found = partings_of(EDGES_S, CHANNELS, measured, model, UNITS, least_s=20.0)
    assert len(found) < 2
    return found[0] if found else None


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_a_vehicle_that_spins_parts_from_a_model_that_does_not(sign: float) -> None:
    """0.05 rad are reached within the first bin after the rear breaks away at 1 rad/s."""
    rate, ay = turn()
    spun = motion(rate + sign * (TIME_S > 7.0), ay)
    found = parted(spun, motion(rate, ay))
    assert found is not None
    assert found.unit == "tractor"
    assert found.at_s == pytest.approx(7.1, abs=0.06)
    assert parted(motion(rate, ay), spun) == found, "or the other way round"
    assert parted(spun, spun) is None, "a spin that the model has counts"


def test_a_vehicle_that_plows_parts() -> None:
    """Its front slides: it turns and is pushed less than the model, and its nose points outward."""
    rate, ay = turn()
    late = TIME_S > 6.0
    found = parted(motion(rate - 0.2 * late, ay - 2.0 * late), motion(rate, ay))
    assert found is not None
    assert found.at_s == pytest.approx(6.5, abs=0.15)


def test_a_trailer_that_swings_out_parts() -> None:
    rate, ay = turn()
    found = parted(motion(rate, ay, trailer=rate + 0.5 * (TIME_S > 5.0)), motion(rate, ay))
    assert found is not None
    assert found.unit == "trailer"
    assert found.at_s == pytest.approx(5.1, abs=0.1)


@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_a_wrong_steering_ratio_parts_nothing(sign: float) -> None:
    """The vehicle turns 20 % more than its model, and so does its path."""
    rate, ay = turn(0.3 * sign)
    assert parted(motion(1.2 * rate, 1.2 * ay), motion(rate, ay)) is None


@pytest.mark.parametrize("lean_mps2", [-2.0, 2.0])
def test_a_leaning_accelerometer_parts_nothing(lean_mps2: float) -> None:
    rate, ay = turn()
    assert parted(motion(rate, ay + lean_mps2), motion(rate, ay)) is None


@pytest.mark.parametrize("offset_degps", [-28.0, 2.0])
def test_a_gyro_with_an_offset_parts_nothing(offset_degps: float) -> None:
    rate, ay = turn()
    off = rate + np.radians(offset_degps)
    assert parted(motion(off, ay), motion(rate, ay)) is None
    slid = off + 0.5 * (TIME_S > 8.0)
    found = parted(motion(slid, ay), motion(rate, ay))
    assert found is not None, "a slide shows beside it"
    assert found.at_s == pytest.approx(8.15, abs=0.1)


def test_a_slide_that_takes_most_of_a_run_parts_where_it_begins() -> None:
    rate, ay = turn()
    found = parted(motion(rate + 0.5 * (TIME_S > 2.5), ay), motion(rate, ay))
    assert found is not None
    assert found.at_s == pytest.approx(2.6, abs=0.1)


def test_a_vehicle_that_creeps_parts_nothing() -> None:
    rate, ay = turn(speed=4.0)
    assert parted(motion(rate + 1.0, ay, 4.0), motion(rate, ay, 4.0)) is None


def test_bins_that_were_not_measured_part_nothing() -> None:
    rate, ay = turn()
    gaps = np.where((TIME_S > 3.0) & (TIME_S < 9.0), np.nan, rate)
    assert parted(motion(gaps, ay), motion(rate, ay)) is None


def test_without_one_of_the_channels_nothing_is_said() -> None:
    rate, ay = turn()
    spun, model = motion(rate + (TIME_S > 7.0), ay), motion(rate, ay)
    for k in range(3):
        channels = [name if j != k else "other" for j, name in enumerate(CHANNELS)]
        assert partings_of(EDGES_S, channels, spun, model, UNITS[:1], 20.0) == ()


def test_a_log_counts_again_once_both_agree() -> None:
    """Two slides of a second each; at another speed after the second, nothing is alike."""
    rate, ay = turn()
    slides = ((TIME_S > 3.0) & (TIME_S < 4.0)) | ((TIME_S > 8.0) & (TIME_S < 9.0))
    model = motion(rate, ay)
    found = partings_of(EDGES_S, CHANNELS, motion(rate + slides, ay), model, UNITS, least_s=1.5)
    assert [one.at_s for one in found] == pytest.approx([3.1, 8.1], abs=0.1)
    assert [one.until_s for one in found] == pytest.approx([4.6, 9.6], abs=0.6)
    slower = motion(rate + slides, ay)
    slower[TIME_S > 8.0, 2] = 15.0
    *_, last = partings_of(EDGES_S, CHANNELS, slower, model, UNITS, least_s=1.5)
    assert last.until_s == np.inf


def spinning(straight: Recording, at_s: float) -> Recording:
    """The same run, its tractor turning at 2 rad/s from an instant on."""
    rate = straight["tractor_yaw_rate_radps"]
    return straight.with_channels({"tractor_yaw_rate_radps": Series(
        rate.time_s, np.where(rate.time_s > at_s, 2.0, rate.value))})


def test_a_run_counts_up_to_its_parting(
        truck: Packed, few: Settings, drive_it: Callable[..., Recording]) -> None:
    straight = drive_it()
    whole, spun = (prepare_run(one, role, truck, few, step_s=0.0025) for one, role in (
        (straight, "train"), (replace(spinning(straight, 4.0), name="spun"), "holdout")))
    study = Study((whole,), (spun,), truck, few)
    calibrate(study)
    kept, = study.runs
    cut, = study.holdout
    assert kept.edges_s.size == whole.edges_s.size
    assert cut.edges_s[-1] == pytest.approx(4.05, abs=0.06)
    assert cut.simulated(truck).shape == cut.measured.shape == study.holdout_models[0].shape
    assert study.holdout_columns[0].shape[0] == cut.measured.size
    note, = parting_notes((kept, cut))
    assert note.startswith("spun: from 4.")
    assert " s on the tractor slides and the model does not" in note


def test_a_slide_within_a_log_is_not_measured(
        truck: Packed, few: Settings, drive_it: Callable[..., Recording]) -> None:
    straight = drive_it()
    rate = straight["tractor_yaw_rate_radps"]
    slid = straight.with_channels({"tractor_yaw_rate_radps": Series(rate.time_s, np.where(
        (rate.time_s > 3.0) & (rate.time_s < 3.5), 2.0, rate.value))})
    run = prepare_run(slid, "train", truck, few, step_s=0.0025)
    cut, model = run.counted(run.simulated(truck), truck.vehicle.units, least_s=0.5)
    one, = cut.partings
    assert one.until_s < cut.edges_s[-1] == run.edges_s[-1]
    during = (cut.edges_s[:-1] > one.at_s) & (cut.edges_s[1:] < one.until_s)
    assert during.any()
    assert np.isnan(cut.measured[during]).all()
    assert np.isfinite(cut.measured[~during][1:-1]).sum() > 0.5 * np.isfinite(run.measured).sum()
    assert np.all(cut.residual(model).reshape(cut.measured.shape)[during] == 0.0)
    note, = parting_notes((cut,))
    assert f"from {one.at_s:.1f} s to {one.until_s:.1f} s the tractor slides" in note


def test_a_run_that_spins_at_once_keeps_enough_to_try_an_event(
        truck: Packed, few: Settings, drive_it: Callable[..., Recording]) -> None:
    run = prepare_run(spinning(drive_it(), 0.0), "train", truck, few, step_s=0.0025)
    cut, model = run.counted(run.simulated(truck), truck.vehicle.units, few.episode_s)
    assert cut.length_s == pytest.approx(1.1)
    assert model.shape == cut.measured.shape
