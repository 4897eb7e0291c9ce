from __future__ import annotations

import numpy as np
import pytest
import trial_faults as faults
from trial_drive import make_run

from truck_blowout_sim.diagnosis.sensors import sensor_gate

WHEEL = "steering_wheel_angle_rad"
RUNS = [make_run(40 + k, 12.0, steer=0.3) for k in range(3)]
BASELINE = [make_run(50 + k, 12.0, steer=0.3) for k in range(2)]


def test_the_zero_of_each_run_is_found() -> None:
    shifted = [faults.offset(WHEEL, np.radians(d))(r) for d, r in zip((2, 0, 0), RUNS, strict=True)]
    zero = sensor_gate(shifted).steering
    assert zero is not None
    found = np.degrees([zero.by_recording[run.name] for run in RUNS])
    assert found == pytest.approx([2.0, 0.0, 0.0], abs=0.4)
    assert zero.baseline_rad is None


def test_play_and_wander_are_no_fault() -> None:
    slightly = [faults.offset(WHEEL, np.radians(2.5))(run) for run in RUNS]
    assert sensor_gate(slightly, BASELINE).clean


@pytest.mark.parametrize("degrees", [-9.0, 9.0])
def test_a_zero_that_is_far_off_is_named_with_its_alias(degrees: float) -> None:
    spoilt = [faults.offset(WHEEL, np.radians(degrees))(run) for run in RUNS]
    findings = sensor_gate(spoilt, BASELINE).findings
    assert [finding.name for finding in findings] == ["steering_angle_offset"]
    offset = findings[0].parameters["offset"]
    assert np.degrees(offset.value) == pytest.approx(degrees, abs=0.5)
    assert offset.ci90[0] < np.radians(degrees) < offset.ci90[1]
    assert "axle_misalignment" in findings[0].aliases


def test_a_truck_that_stands_differently_is_not_blamed_on_the_sensor() -> None:
    crabbing = [
        faults.offset("trailer_yaw_rad", np.radians(0.4))(faults.offset(WHEEL, np.radians(9.0))(r))
        for r in RUNS
    ]
    result = sensor_gate(crabbing, BASELINE)
    assert "steering_angle_offset" not in [finding.name for finding in result.findings]
    assert any("not the sensor" in note for note in result.notes)


def test_no_wheel_no_answer() -> None:
    result = sensor_gate([run.without_channels([WHEEL]) for run in RUNS])
    assert result.steering is None
    assert any("hand-wheel zero" in note for note in result.notes)


def test_a_zero_that_differs_from_run_to_run_is_not_the_sensor() -> None:
    wandering = [faults.offset(WHEEL, np.radians(d))(run)
                 for d, run in zip((3.0, 9.0, 15.0), RUNS, strict=True)]
    findings = sensor_gate(wandering, BASELINE).findings
    assert "steering_angle_offset" not in [finding.name for finding in findings]


def test_a_hand_wheel_that_reads_late_is_named_because_no_truck_leads_it() -> None:
    drive = make_run(70, 90.0)
    assert "channel_delay" not in [f.name for f in sensor_gate([drive]).findings]
    late = faults.delayed([WHEEL], 0.2)(drive)
    (finding,) = sensor_gate([late]).findings
    assert (finding.name, finding.instrument) == ("channel_delay", "hand wheel")
    assert finding.parameters["delay"].value == pytest.approx(0.2, abs=0.05)


def test_a_truck_that_follows_late_is_not_the_instrument() -> None:
    early = faults.delayed([WHEEL], -0.2)(make_run(70, 90.0))
    assert sensor_gate([early]).clean
