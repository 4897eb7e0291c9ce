"""An interrupted diagnosis continues: same answer, nothing asked twice, nothing torn believed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import yaml

from truck_blowout_sim.diagnosis import QUICK, diagnose, keeping
from truck_blowout_sim.diagnosis.case.fingerprints import simulation_key
from truck_blowout_sim.diagnosis.case.resume import Kept
from truck_blowout_sim.diagnosis.case.runs import Run, prepare_run
from truck_blowout_sim.diagnosis.settings import Settings
from truck_blowout_sim.proof.memory import Memory
from truck_blowout_sim.recordings import Recording, write_recording
from truck_blowout_sim.resources import config_file
from truck_blowout_sim.vehicle import Packed

Drives = Callable[..., Recording]
CASE = {"recordings": "a", "vehicle": "b", "settings": "c"}
MASS = "unit.trailer.mass_kg"


@pytest.fixture(scope="module")
def run(drive_it: Drives, truck: Packed, few: Settings) -> Run:
    """A prepared run."""
    return prepare_run(drive_it(), "train", truck, few, step_s=0.0025)


class Asked:
    """Counts the simulations that really ran, instead of running them."""

    def __init__(self, monkeypatch: pytest.MonkeyPatch) -> None:
        self.count = 0
        monkeypatch.setattr(Run, "simulated", lambda run, truck: self._one(run, truck))

    def _one(self, run: Run, truck: Packed) -> np.ndarray:
        self.count += 1
        return np.full(run.measured.shape, truck[MASS] / 3.0)


def trucks(truck: Packed, n: int) -> list[Packed]:
    return [truck.with_values({MASS: 1e4 + k}) for k in range(n)]


def test_what_is_remembered_is_not_simulated_again_and_cannot_be_spoilt(
    run: Run, truck: Packed, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked, memory = Asked(monkeypatch), Memory(most=2)
    before = [memory.simulated(run, t) for t in trucks(truck, 3)]
    before[0][:] = np.nan  # whoever got it may do with it what he likes
    again = [memory.simulated(run, t) for t in trucks(truck, 3)]
    assert (asked.count, memory.hits) == (4, 2)  # the third was one too many
    np.testing.assert_array_equal(again[0], 1e4 / 3.0)
    np.testing.assert_array_equal(again[1], before[1])


def test_what_was_simulated_before_is_not_simulated_again(
    run: Run, truck: Packed, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked, said = Asked(monkeypatch), list[str]()
    first = Kept(tmp_path / "kept", said.append)
    first.begin(CASE)
    before = [first.simulated(run, t) for t in trucks(truck, 3)]
    first.close()
    second = Kept(tmp_path / "kept", said.append)
    second.begin(CASE)
    after = [second.simulated(run, t) for t in trucks(truck, 4)]
    assert asked.count == 4
    assert all(np.array_equal(a, b) for a, b in zip(before, after, strict=False))
    assert len(said) == 1
    assert "3 simulations" in said[0]
    second.close(forget=True)
    assert not (tmp_path / "kept").exists()


def interrupted(folder: Path, run: Run, those: Sequence[Packed]) -> None:
    with keeping(folder) as kept:
        kept.begin(CASE)
        for one in those:
            kept.simulated(run, one)
        raise KeyboardInterrupt


@pytest.mark.parametrize("damage", ["cut", "flip", "zeros"])
def test_a_torn_record_is_dropped_and_written_again(
    run: Run, truck: Packed, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, damage: str
) -> None:
    asked = Asked(monkeypatch)
    with pytest.raises(KeyboardInterrupt):
        interrupted(tmp_path / "kept", run, trucks(truck, 3))
    file = tmp_path / "kept" / "simulations"
    raw = bytearray(file.read_bytes())
    if damage == "cut":
        raw = raw[:-100]
    elif damage == "flip":
        raw[-100] ^= 1
    else:
        raw += bytes(5000)
    file.write_bytes(raw)
    for expected in (0 if damage == "zeros" else 1, 0):
        asked.count = 0
        kept = Kept(tmp_path / "kept")
        kept.begin(CASE)
        again = [kept.simulated(run, one) for one in trucks(truck, 3)]
        kept.close()
        assert asked.count == expected
        assert [a[0, 0] for a in again] == [(1e4 + k) / 3.0 for k in range(3)]


def test_another_case_starts_anew_and_says_what_changed(
    run: Run, truck: Packed, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked, said = Asked(monkeypatch), list[str]()
    for case in (CASE, CASE | {"vehicle": "other", "settings": "other"}):
        kept = Kept(tmp_path / "kept", said.append)
        kept.begin(case)
        kept.simulated(run, truck)
        kept.close()
    assert asked.count == 2
    assert said == [f"{tmp_path / 'kept'} was kept for other vehicle and settings: starting anew"]


def test_the_key_changes_with_everything_a_simulation_follows_from(
    run: Run, truck: Packed, drive_it: Drives, few: Settings
) -> None:
    drive = run.drive
    faster = replace(drive, initial=replace(drive.initial, speed_mps=21.0))
    others = [
        simulation_key(run, truck.with_values({MASS: 1e4})),
        simulation_key(replace(run, drive=faster), truck),
        simulation_key(replace(run, drive=replace(drive, step_s=0.001)), truck),
        simulation_key(replace(run, drive=replace(drive, inputs=drive.inputs + 1e-9)), truck),
        simulation_key(replace(run, drive=replace(drive, warm=np.zeros(3))), truck),
        simulation_key(replace(run, correction=run.correction + 1e-9), truck),
        simulation_key(replace(run, edges_s=run.edges_s[:-1]), truck),
    ]
    assert len({simulation_key(run, truck), *others}) == len(others) + 1
    again = prepare_run(drive_it(), "train", truck, few, step_s=0.0025)
    assert simulation_key(again, truck) == simulation_key(run, truck)


@pytest.fixture(scope="module")
def words(tmp_path_factory: pytest.TempPathFactory, drive_it: Drives, truck: Packed) -> list[str]:
    """Arguments of a small case on the command line, all but the output folder."""
    folder = tmp_path_factory.mktemp("interrupted")
    hub = "hub.trailer_2_left.brake_gain"
    write_recording(drive_it({hub: 0.3 * truck[hub]}, name="train"), folder / "train.csv")
    tree = yaml.safe_load(config_file("diagnosis", "default").read_text(encoding="utf-8"))
    tree["sheet"] = {n: tree["sheet"][n] for n in ("mass", "steering_zero", "brake_gain")}
    (folder / "few.yaml").write_text(yaml.safe_dump(tree), encoding="utf-8")
    return ["diagnose", str(folder / "train.csv"), "--settings", str(folder / "few.yaml"),
            "--quick"]


def start(words: list[str], out: Path) -> subprocess.Popen[str]:
    return subprocess.Popen([sys.executable, "-m", "truck_blowout_sim", *words, "-o", str(out)],
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


@pytest.fixture(scope="module")
def straight(words: list[str], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The answer of a run that nobody interrupts."""
    out = tmp_path_factory.mktemp("straight") / "out"
    process = start(words, out)
    _, error = process.communicate(timeout=240)
    assert process.returncode == 0, error
    return out


def interrupted_by(name: str, words: list[str], out: Path, least_bytes: int) -> list[str]:
    """What a diagnosis says on stderr that a signal ends once so much of it is kept."""
    kept = out / ".resume" / "simulations"
    process = start(words, out)
    deadline = time.monotonic() + 240.0
    while not (kept.is_file() and kept.stat().st_size > least_bytes):
        assert process.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.01)
    process.send_signal(getattr(signal, name))
    _, error = process.communicate(timeout=120)
    assert process.returncode == (-signal.SIGKILL if name == "SIGKILL" else 130)
    return [text for text in error.splitlines() if text.strip()]


def test_a_diagnosis_killed_in_every_way_continues_to_the_same_answer(
    words: list[str], straight: Path, tmp_path: Path
) -> None:
    """Ended three times in a row, each time later: of about 2.8 MB in all."""
    out = tmp_path / "out"
    goes_on, ended = "continuing an interrupted diagnosis", "the same command continues from here"
    line, = interrupted_by("SIGINT", words, out, 300_000)
    assert line.endswith(f"interrupted; {ended}")
    first, line = interrupted_by("SIGTERM", words, out, 1_000_000)
    assert first.startswith(goes_on)
    assert line.endswith(f"interrupted; {ended}")
    line, = interrupted_by("SIGKILL", words, out, 1_700_000)
    assert line.startswith(goes_on)
    again = start(words, out)
    _, error = again.communicate(timeout=240)
    assert again.returncode == 0
    line, = [text for text in error.splitlines() if text.strip()]
    assert line.startswith(goes_on)
    assert not (out / ".resume").exists()
    for file in ("diagnosis.json", "vehicle.yaml"):
        assert (out / file).read_bytes() == (straight / file).read_bytes()


def test_a_diagnosis_without_a_folder_keeps_nothing(
    words: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, drive_it: Drives
) -> None:
    monkeypatch.chdir(tmp_path)
    diagnose([drive_it()], settings=words[3], effort=QUICK)
    assert os.listdir(tmp_path) == []
