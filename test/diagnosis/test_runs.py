"""Bins, weights and residuals of a recording."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from truck_blowout_sim.diagnosis.case.runs import Run, prepare_run
from truck_blowout_sim.diagnosis.case.widths import swings
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.fit.instants import grid_of
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording, Series
from truck_blowout_sim.simulation.drive import run_drive
from truck_blowout_sim.vehicle import Packed

Drives = Callable[..., Recording]


@pytest.fixture(scope="module")
def run(drive_it: Drives, truck: Packed, few: Settings) -> Run:
    return prepare_run(drive_it(), "train", truck, few, step_s=0.0025)


def with_channel(recording: Recording, name: str, series: Series | None) -> Recording:
    channels = {k: s for k, s in recording.channels.items() if k != name}
    return replace(recording, channels=channels if series is None else {**channels, name: series})


def test_a_bin_is_the_plain_mean_of_its_samples(run: Run) -> None:
    k = run.channels.index("tractor_vx_mps")
    series = run.recording["tractor_vx_mps"]
    for b in (0, 17, len(run.edges_s) - 2):
        inside = (series.time_s >= run.edges_s[b] - 1e-9) & (
            series.time_s < run.edges_s[b + 1] - 1e-9)
        assert inside.sum() == 10
        assert run.measured[b, k] == pytest.approx(series.value[inside].mean(), rel=1e-12)


def test_model_and_measurement_are_averaged_over_the_same_instants(run: Run) -> None:
    times = run.drive.times_s
    out = np.repeat(times[:, None], max(run.columns) + 1, axis=1)
    clock = replace(run.recording, channels={
        **run.recording.channels, "tractor_vx_mps": Series(times, times)})
    place = np.searchsorted(run.edges_s, times + 1e-9, side="right") - 1
    measured = [clock["tractor_vx_mps"].value[place == b].mean()
                for b in range(run.measured.shape[0])]
    np.testing.assert_allclose(run.bins_of(out)[:, 0], measured, rtol=1e-12)


def test_the_start_is_left_out(run: Run, few: Settings) -> None:
    assert run.edges_s[0] == pytest.approx(run.recording.start_s + few.skip_s)
    np.testing.assert_allclose(np.diff(run.edges_s), few.bin_s)


def test_the_true_truck_leaves_noise_and_no_more(run: Run, truck: Packed) -> None:
    model = run.bins_of(run_drive(truck, run.drive))
    plain = (run.measured - model) / run.noise
    assert 0.7 < float(np.sqrt(np.nanmean(plain**2))) < 1.5
    assert float(np.mean(run.residual(model) ** 2)) < 1.0
    assert np.isfinite(plain).any(axis=0).all()


def test_the_estimated_noise_is_the_one_that_was_added(run: Run) -> None:
    expected = {"tractor_vx_mps": 0.01, "trailer_ay_mps2": 0.03, "tractor_yaw_rate_radps": 3e-4}
    for name, sigma in expected.items():
        k = run.channels.index(name)
        assert np.median(run.noise[:, k]) == pytest.approx(sigma / np.sqrt(10.0), rel=0.25)


def test_weights_grow_with_the_distance_from_rest_and_never_below_the_noise(
    run: Run, few: Settings
) -> None:
    assert (run.sigma >= run.noise).all()
    k = run.channels.index("tractor_ay_mps2")
    rule = few.rule("tractor_ay_mps2")
    assert rule is not None
    swing = swings(run.measured, few)[:, k]
    model = np.sqrt((rule.floor**2 + (rule.relative * swing) ** 2)
                    * few.correlation_s / few.bin_s)
    np.testing.assert_allclose(run.sigma[:, k], np.hypot(run.noise[:, k], model), rtol=1e-9)


def test_a_gap_says_nothing(drive_it: Drives, truck: Packed, few: Settings) -> None:
    recording = drive_it()
    series = recording["tractor_vx_mps"]
    kept = (series.time_s < 3.0) | (series.time_s > 4.0)
    gappy = prepare_run(with_channel(recording, "tractor_vx_mps", Series(
        series.time_s[kept], series.value[kept])), "train", truck, few, step_s=0.0025)
    model = gappy.bins_of(run_drive(truck, gappy.drive))
    k = gappy.channels.index("tractor_vx_mps")
    silent = np.isnan(gappy.measured[:, k])
    assert 8 <= silent.sum() <= 10
    left = gappy.residual(model + 5.0).reshape(gappy.measured.shape)
    assert (left[silent, k] == 0.0).all()
    assert (left[~silent, k] != 0.0).all()
    assert (gappy.change(model + 1.0, model).reshape(left.shape)[silent, k] == 0.0).all()


def test_a_simulation_that_broke_down_is_far_off_not_perfect(run: Run) -> None:
    model = np.full(run.measured.shape, np.nan)
    assert (run.residual(model)[np.isfinite(run.measured).ravel()] > 100.0).all()
    assert np.isfinite(run.change(model, run.measured)).all()


def test_an_imposed_speed_is_no_evidence_of_what_drives_or_brakes(
    drive_it: Drives, truck: Packed, few: Settings
) -> None:
    without = with_channel(drive_it(), "throttle", None)
    run = prepare_run(without, "train", truck, few, step_s=0.0025)
    assert run.drive.speed_imposed
    assert not any("_vx_" in c or "_ax_" in c or c.startswith("hub_") for c in run.channels)
    assert "tractor_yaw_rate_radps" in run.channels


def test_a_recording_without_hand_wheel_cannot_drive(
    drive_it: Drives, truck: Packed, few: Settings
) -> None:
    blind = with_channel(drive_it(), "steering_wheel_angle_rad", None)
    with pytest.raises(InputError, match="steering_wheel_angle_rad"):
        prepare_run(blind, "train", truck, few, step_s=0.0025)


def test_what_a_run_can_show(run: Run, drive_it: Drives, truck: Packed, few: Settings) -> None:
    assert run.shows("any")
    assert run.shows("brakes")
    assert not run.shows("blowout")
    n = run.drive.inputs.shape[0]
    coasting = replace(run, drive=replace(run.drive, inputs=np.zeros((n, 5))))
    assert not coasting.shows("brakes")


def test_a_step_that_does_not_divide_the_samples_corrects_as_well(
    truck: Packed, few: Settings, drive_it: Drives
) -> None:
    odd, fine = (prepare_run(drive_it(), "train", truck, few, step_s=step_s).corrected(truck)
                 for step_s in (0.004, 0.001))
    z = fine.residual(fine.simulated(truck)) - odd.residual(odd.simulated(truck))
    assert np.sqrt(np.mean(z**2)) < 0.3


def test_where_the_coarse_step_is_no_use_the_fine_one_is_taken(
    truck: Packed, few: Settings, drive_it: Drives
) -> None:
    run = prepare_run(drive_it(), "train", truck, few, step_s=0.001)
    assert run.corrected(truck).drive.step_s == few.trial_step_s
    stiff = truck.with_values({name: 3e7 for name in truck.index
                               if name.endswith("stiffness_npm") and name.startswith("tire.")})
    assert run.corrected(stiff).drive.step_s == 0.001


def test_a_truck_that_leaves_the_range_of_the_model_is_an_error(
    truck: Packed, few: Settings, drive_it: Drives
) -> None:
    run = prepare_run(drive_it(), "train", truck, few, step_s=0.001)
    wild = truck.with_values({"tire.steer_left.stiffness_npm": 1e9})
    with pytest.raises(InputError, match="left the range of the model"):
        run.corrected(wild)


def test_a_run_too_short_for_any_event_is_refused_with_the_least_length(
    drive_it: Drives, truck: Packed, few: Settings
) -> None:
    recording = drive_it()
    start_s = recording.start_s
    with pytest.raises(InputError, match=r"lasts 1\.\d+ s, which is too short.*at least 1\.5 s"):
        prepare_run(recording.between(start_s, start_s + 1.45), "holdout", truck, few,
                    step_s=0.0025)
    shortest = prepare_run(recording.between(start_s, start_s + 1.52), "holdout", truck, few,
                           step_s=0.0025)
    assert all(grid_of(shortest, effect).size for effect in LIBRARY if effect.timed)
