from __future__ import annotations

import numpy as np
import pytest
from trial_drive import METADATA, make_run

from truck_blowout_sim.diagnosis.sensors.case import make_case
from truck_blowout_sim.diagnosis.sensors.rows import whiten
from truck_blowout_sim.diagnosis.sensors.system import assemble, normal_equations
from truck_blowout_sim.diagnosis.sensors.windows import make_windows
from truck_blowout_sim.recordings import Recording, Series

TIME = np.arange(0.0, 12.0, 0.01)


def test_straight_lines_are_reproduced_exactly() -> None:
    windows = make_windows(0.01)
    line = 3.0 - 0.7 * TIME
    assert windows.mean(line) == pytest.approx(line[windows.centres(TIME.size)], abs=1e-12)
    assert windows.derivative(line) == pytest.approx(-0.7, abs=1e-12)


def test_the_weak_derivative_is_the_mean_of_the_derivative() -> None:
    windows = make_windows(0.01)
    phase = 2 * np.pi * 1.1 * TIME
    weak = windows.derivative(np.sin(phase))
    assert weak == pytest.approx(windows.mean(2 * np.pi * 1.1 * np.cos(phase)), abs=2e-3)


def test_slow_sampling_widens_the_bumps() -> None:
    assert make_windows(0.05).length >= 7
    assert make_windows(0.05).step == 2


def test_whitened_noise_is_white() -> None:
    """Monte Carlo of the covariance: whitened residuals of exact runs have unit variance."""
    energy, count, lag = 0.0, 0, 0.0
    for seed in range(6):
        case = make_case([make_run(seed, 10.0)], [], None)
        system = assemble(case, (), [])
        rows = system.rows[0]
        assert rows is not None
        white, _ = whiten(rows, np.ones(len(rows.identities)))
        # Hubs and hitch carry an allowance for the relation itself, not only channel noise.
        kept = [k for k, i in enumerate(rows.identities) if "h" not in i.name[:1] + i.name[8:9]]
        table = white.reshape(rows.residual.shape)[:, kept]
        energy += float((table**2).sum())
        lag += float((table[1:] * table[:-1]).sum())
        count += table.size
    # 6 x 97 bumps x 14 identities: 1 sigma of the mean square is 1.5 %.
    assert energy / count == pytest.approx(1.0, abs=0.06)
    assert lag / count == pytest.approx(0.0, abs=0.04)


def test_gaps_drop_rows_and_nothing_else() -> None:
    run = make_run(1, 10.0)
    series = run["tractor_ay_mps2"]
    kept = (series.time_s < 4.0) | (series.time_s > 6.0)
    gappy = run.with_channels({"tractor_ay_mps2": Series(series.time_s[kept], series.value[kept])})
    whole, holed = (assemble(make_case([r], [], None), (), []).rows[0] for r in (run, gappy))
    assert whole is not None
    assert holed is not None
    lost = whole.valid & ~holed.valid
    names = [i.name for i in whole.identities]
    assert set(np.flatnonzero(lost.any(axis=0))) == {names.index("tractor lateral acceleration")}
    time_s = whole.time_s[lost.any(axis=1)]
    assert time_s.min() > 3.7
    assert time_s.max() < 6.3
    normal = normal_equations(assemble(make_case([gappy], [], None), (), []), {})
    assert normal.count == int(holed.valid.sum()) + 4


def test_channels_on_another_time_base_are_interpolated() -> None:
    run = make_run(2, 10.0, noise=0.0)
    series = run["tractor_roll_rad"]
    sparse = Recording(
        "sparse",
        {**run.channels, "tractor_roll_rad": Series(series.time_s[::2], series.value[::2])},
        (), METADATA,
    )  # fmt: skip
    rows = assemble(make_case([sparse], [], None), (), []).rows[0]
    assert rows is not None
    at = [i.name for i in rows.identities].index("tractor lateral acceleration")
    assert np.abs(rows.residual[:, at]).max() < 0.005
