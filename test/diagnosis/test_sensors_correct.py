from __future__ import annotations

import numpy as np
import pytest
import trial_faults as faults
from trial_drive import make_run

from truck_blowout_sim.diagnosis.sensors import correct, sensor_gate

RUN = make_run(30, 12.0)


def test_nothing_found_nothing_changed() -> None:
    assert correct(RUN, ()) == RUN


@pytest.mark.parametrize(
    ("channel", "change"),
    [
        ("tractor_yaw_rate_radps", faults.scaled("tractor_yaw_rate_radps", 0.06)),
        ("tractor_ay_mps2", faults.leaking("tractor", 0.8)),
        ("trailer_vx_mps", faults.scaled("trailer_vx_mps", -0.02)),
        ("trailer_vy_mps", faults.displaced("trailer", 0.8, "velocity")),
    ],
)
def test_the_spoilt_channel_is_mended(channel: str, change: faults.Change) -> None:
    spoilt = change(RUN)
    mended = correct(spoilt, sensor_gate([spoilt], [make_run(31, 12.0)]).findings)
    before = float(np.std(spoilt[channel].value - RUN[channel].value))
    after = float(np.std(mended[channel].value - RUN[channel].value))
    assert after < 0.3 * before
    untouched = set(RUN.channels) - set(sensor_gate([spoilt]).findings[0].channels)
    assert all(mended[name] == RUN[name] for name in untouched if name != channel)


def test_a_late_channel_keeps_its_samples() -> None:
    spoilt = faults.delayed(["tractor_ay_mps2"], 0.09)(RUN)
    findings = sensor_gate([spoilt], [make_run(31, 12.0)]).findings
    mended = correct(spoilt, findings)
    assert np.array_equal(mended["tractor_ay_mps2"].value, spoilt["tractor_ay_mps2"].value)
    shift = spoilt["tractor_ay_mps2"].time_s - mended["tractor_ay_mps2"].time_s
    assert shift == pytest.approx(0.09, abs=0.01)
    assert "channel_delay" in mended.metadata["sensor_correction"]


def test_a_recording_without_the_channel_is_left_alone() -> None:
    spoilt = faults.scaled("trailer_ay_mps2", 0.2)(RUN)
    findings = sensor_gate([spoilt]).findings
    lean = RUN.without_channels(["trailer_ay_mps2"])
    assert correct(lean, findings).channels.keys() == lean.channels.keys()
