"""The FMU in an importer that is not ours: the same truck as the library's, bit for bit."""

from __future__ import annotations

from pathlib import Path

import pytest

from truck_blowout_sim import InitialState, Inputs, Truck, load_vehicle
from truck_blowout_sim.fmu.__main__ import main as command

fmpy = pytest.importorskip("fmpy", reason="fmpy is not installed")
pytest.importorskip("pythonfmu3", reason="pythonfmu3 is not installed")
VEHICLE = "international_9400i_trailmobile"


@pytest.fixture(scope="module")
def unit(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("fmu")
    assert command([VEHICLE, "-o", str(folder)]) == 0
    return folder / "Truck.fmu"


def test_the_description_is_valid_and_names_every_input_and_output(unit: Path) -> None:
    from fmpy.validation import validate_fmu

    assert validate_fmu(str(unit)) == []
    described = fmpy.read_model_description(str(unit))
    assert described.fmiVersion == "3.0"
    names = {variable.name for variable in described.modelVariables}
    assert {"steering_wheel_angle_rad", "blow_steer_left", "tire_fz_steer_left_n",
            "tractor_yaw_rate_radps", "articulation_rad"} <= names


def test_a_blowout_in_the_importer_is_that_of_the_library(unit: Path) -> None:
    import numpy as np

    times = np.arange(0.0, 2.0, 0.01)
    signals = np.array(
        [(t, t >= 0.5, -0.1 * (t >= 1.0)) for t in times],
        dtype=[("time", float), ("blow_steer_left", bool), ("steering_wheel_angle_rad", float)])
    wanted = ["tractor_yaw_rate_radps", "tire_pressure_steer_left_pa"]
    found = fmpy.simulate_fmu(str(unit), stop_time=1.5, step_size=0.01, output_interval=0.01,
                              start_values={"initial_speed_mps": 22.0}, input=signals,
                              output=wanted)
    truck = Truck(load_vehicle(VEHICLE), initial=InitialState(speed_mps=22.0))
    for k in range(150):
        if k >= 50:
            truck.blow("steer_left")
        truck.advance(Inputs(steering_wheel_angle_rad=-0.1 * (k >= 100)), 10)
    for name in wanted:
        assert found[name][-1] == pytest.approx(truck.outputs()[name], rel=1e-3, abs=1e-4)
    assert found["tire_pressure_steer_left_pa"][40] > 7e5


def test_an_existing_unit_and_an_unknown_vehicle_are_refused(
    unit: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert command([VEHICLE, "-o", str(unit.parent)]) == 2
    assert "--force" in capsys.readouterr().err
    assert command(["no_such_truck", "-o", str(unit.parent / "x")]) == 2
