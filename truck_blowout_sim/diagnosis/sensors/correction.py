"""Take found sensor faults out of a recording.

Validated with: test/diagnosis/test_sensors_correct.py.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.sensors.distortions import Convention
from truck_blowout_sim.diagnosis.sensors.findings import SensorFinding
from truck_blowout_sim.diagnosis.sensors.signals import read_signals
from truck_blowout_sim.recordings import Recording, Series

FloatArray = NDArray[np.float64]


def correct(recording: Recording, findings: Sequence[SensorFinding]) -> Recording:
    """The recording as sound instruments would have made it.

    Args:
        recording: one that has the faults (of the baseline, pass only findings ``in_baseline``).
        findings: of the sensor gate; those on channels that the recording lacks do nothing.

    Returns:
        A copy; late channels keep their samples with earlier stamps, nothing is resampled.
    """
    meant = [f for f in findings if isinstance(f.distortion, Convention)]
    late = [f for f in findings if f.name == "channel_delay"]
    other = [f for f in findings if f not in meant and f not in late]
    for finding in meant:
        assert isinstance(finding.distortion, Convention)
        recording = finding.distortion.mended(recording)
    for finding in [*late, *other]:
        recording = _without(recording, finding)
    if findings:
        said = "; ".join(f"{f.name} of {f.instrument} taken out" for f in [*meant, *late, *other])
        recording = recording.with_metadata(sensor_correction=said)
    return recording


def _without(recording: Recording, finding: SensorFinding) -> Recording:
    touched = [c for c in finding.channels if c in recording and len(recording[c]) > 1]
    if not touched:
        return recording
    smooth = read_signals(recording).smooth()
    changed = {}
    for channel in touched:
        series = recording[channel]

        def read(name: str, times: FloatArray = series.time_s) -> FloatArray:
            values = smooth[name]
            known = np.isfinite(values)
            if not known.any():
                return np.zeros_like(times)
            return np.asarray(np.interp(times, smooth.time_s[known], values[known]))

        time_s, value = finding.distortion.undo(
            finding.amounts, channel, series.time_s, series.value, read
        )
        changed[channel] = Series(time_s, value)
    return recording.with_channels(changed)
