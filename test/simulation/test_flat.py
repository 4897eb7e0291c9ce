"""A run that begins after a burst begins on the flat tire."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim import load_vehicle, simulate
from truck_blowout_sim.recordings import read_recording, write_recording
from truck_blowout_sim.simulation import simulate_inputs

VEHICLE = load_vehicle("international_9400i_trailmobile")


@pytest.mark.parametrize("suffix", ["csv", "mcap"])
def test_a_cut_behind_the_burst_goes_on_as_the_whole_run_did(tmp_path: Path, suffix: str) -> None:
    run = simulate(VEHICLE, "steer_axle_blowout")
    path = write_recording(run.between(2.0, 5.0), tmp_path / f"cut.{suffix}")
    cut = read_recording(path)
    assert cut.blowouts == run.blowouts
    assert cut.start_s == pytest.approx(2.0, abs=0.011)
    model = simulate_inputs(VEHICLE, cut)
    assert "steer_left burst 2.00 s before the first input" in model.notes[-1]
    assert not model["tire_pressure_steer_left_pa"].value.any()
    apart = model["tractor_yaw_rate_radps"].value - cut.at(
        "tractor_yaw_rate_radps", model["tractor_yaw_rate_radps"].time_s)  # fmt: skip
    assert np.sqrt(np.nanmean(apart**2)) < np.deg2rad(0.2)


def test_a_cut_while_the_air_leaves_begins_at_the_pressure_that_is_left() -> None:
    cut = simulate(VEHICLE, "steer_axle_blowout").between(0.05, 0.5)
    name = "tire_pressure_steer_left_pa"
    model = simulate_inputs(VEHICLE, cut)
    assert model[name].value[0] == pytest.approx(cut[name].value[0], rel=0.1)
