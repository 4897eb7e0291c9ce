"""Many simulations of a case at once: same bits in any number of threads, and by any neighbor."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.case import simulations
from truck_blowout_sim.diagnosis.case.fingerprints import simulation_key
from truck_blowout_sim.diagnosis.case.resume import Kept
from truck_blowout_sim.diagnosis.case.runs import Run, prepare_run
from truck_blowout_sim.diagnosis.case.simulations import simulate_bins, simulated_abreast
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.proof.memory import Memory
from truck_blowout_sim.recordings import Recording
from truck_blowout_sim.simulation.course import drive_course
from truck_blowout_sim.vehicle import Packed

Drives = Callable[..., Recording]
MASS = "unit.trailer.mass_kg"


@pytest.fixture(scope="module")
def run(drive_it: Drives, truck: Packed, few: Settings) -> Run:
    return prepare_run(drive_it(), "train", truck, few, step_s=0.0025)


@pytest.fixture(scope="module")
def jobs(run: Run, truck: Packed) -> list[tuple[Run, Packed]]:
    """Two parts of eight, and one that is alone."""
    return [(run, truck.with_values({MASS: truck[MASS] * (1.0 + 0.01 * k)})) for k in range(17)]


def test_two_threads_give_the_bits_of_one(run: Run, truck: Packed) -> None:
    heavier = truck.with_values({MASS: 1.1 * truck[MASS]})
    trucks = [truck, heavier, truck, heavier]
    alone, together = (simulate_bins([(run, one) for one in trucks], workers)
                       for workers in (1, 2))
    assert all(np.array_equal(a, b) for a, b in zip(alone, together, strict=True))
    assert np.array_equal(alone[0], alone[2])
    assert not np.array_equal(alone[0], alone[1])


def test_many_go_abreast_and_give_the_same_to_rounding(
    jobs: list[tuple[Run, Packed]], monkeypatch: pytest.MonkeyPatch
) -> None:
    shares = list[float]()
    monkeypatch.setattr(simulations, "MANY_SIMULATIONS", len(jobs) + 1)
    alone = simulate_bins(jobs, 2)
    monkeypatch.setattr(simulations, "MANY_SIMULATIONS", len(jobs))
    one, two = (simulate_bins(jobs, workers, tell=shares.append) for workers in (1, 2))
    assert shares == 2 * [8 / 17, 16 / 17, 1.0]
    for run, a, b, c in zip((run for run, _ in jobs), alone, one, two, strict=True):
        assert np.array_equal(b, c)
        np.testing.assert_allclose((b - a) / run.sigma, 0.0, atol=1e-6)
    assert not np.array_equal(alone[0], one[0])
    assert np.array_equal(alone[16], one[16])


def test_what_begins_late_goes_abreast_from_the_earliest_on(
    run: Run, truck: Packed, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And is kept by the instant at which all of its part left their driven trucks."""
    course = drive_course(truck, run.drive)
    late = [(replace(run, course=course, since_s=2.0 + 0.1 * k), truck.with_values({
        "unit.trailer.probe_fy_n": 3e3, "unit.trailer.probe_start_s": 2.0 + 0.1 * k,
        "unit.trailer.probe_end_s": 99.0})) for k in reversed(range(10))]
    whole = [(run, truck.with_values({MASS: truck[MASS] * (1.0 + 0.01 * k)})) for k in range(9)]
    jobs = [one for pair in zip(late, [*whole, whole[0]], strict=True) for one in pair]
    monkeypatch.setattr(simulations, "MANY_SIMULATIONS", 100)
    alone = simulate_bins(jobs, 2)
    monkeypatch.setattr(simulations, "MANY_SIMULATIONS", 8)
    seen = list[tuple[float, ...]]()

    def noted(part: Sequence[tuple[Run, Packed]]) -> list[NDArray[np.float64]]:
        seen.append(tuple(one.since_s for one, _ in part))
        return simulated_abreast(part)

    for a, b in zip(alone, simulate_bins(jobs, 1, abreast=noted), strict=True):
        np.testing.assert_allclose((b - a) / run.sigma, 0.0, atol=1e-6)
    assert seen == [(0.0,) * 8, (2.0,) * 8]  # two that are left of each kind go alone
    earlier, later = (simulation_key(replace(run, course=course, since_s=at), truck, abreast=True)
                      for at in (2.0, 2.1))
    assert earlier != later


def test_a_neighbor_changes_no_bit(jobs: list[tuple[Run, Packed]]) -> None:
    """So that an interrupted diagnosis, which lacks some of a part, gives the same answer."""
    eight, some = simulated_abreast(jobs[:8]), simulated_abreast(jobs[5:8])
    assert all(np.array_equal(a, b) for a, b in zip(eight[5:], some, strict=True))


def test_what_went_abreast_is_kept_apart(jobs: list[tuple[Run, Packed]], tmp_path: Path) -> None:
    case = {"recordings": "a"}
    first, second, memory = Kept(tmp_path / "kept"), Kept(tmp_path / "kept"), Memory()
    first.begin(case)
    before = first.simulated_abreast(jobs[2:5])
    first.close()
    second.begin(case)
    asked = list[int]()
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(simulations, "simulated_abreast",
                      lambda those: asked.append(len(those)) or simulated_abreast(those))
        after = second.simulated_abreast(jobs[:8])
        remembered = [memory.simulated_abreast(jobs[:n]) for n in (5, 8)]
    second.close()
    assert asked == [5, 5, 3]
    assert memory.hits == 5
    for found in (before[0], remembered[0][2], remembered[1][2]):
        assert np.array_equal(found, after[2])
    run, truck = jobs[2]
    assert np.array_equal(second.simulated(run, truck), run.simulated(truck))
