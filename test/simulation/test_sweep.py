"""`sweep`: one table and one page, resumable, here and on a cluster; what explains what."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from truck_blowout_sim.cli.main import main
from truck_blowout_sim.cli.sweep import _command
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.simulation import open_batch
from truck_blowout_sim.simulation.studies import sweep as sweeping
from truck_blowout_sim.simulation.studies.influence import groups, share_explained
from truck_blowout_sim.simulation.studies.sweep import Plan, run_sweep

EDITS = {"mine.yaml": "start: {speed_mph: 47}\n", "tire.yaml": "rolling_0: 0.005\n",
         "truck.yaml": "road: crowned\n", "other.yaml": "road: uphill_3_percent\n"}
VARY = ("blowouts.failure.tires=steer_left,drive_1_left", "reaction.time_s=0.5,1.5")


@pytest.fixture(scope="module")
def scenario(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("sweep") / "mine.yaml"
    path.write_text("extends: blowout_in_lane\nend_s: 4\n", encoding="utf-8")
    return str(path)


@pytest.fixture
def plan(scenario: str) -> Plan:
    return Plan(scenario, "international_9400i_trailmobile", VARY, rate_hz=50.0)


def test_a_table_a_page_and_one_object_of_json(
    scenario: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    words = ["sweep", scenario, "--vary", VARY[0], "--vary", "start.speed_mph=40,60,-1",
             "-o", str(tmp_path / "out"), "--rate-hz", "50", "--channels", "tractor_y_m"]
    assert main([*words, "--json"]) == 0
    result = json.loads(capsys.readouterr().out)
    assert result["by_status"] == {"ok": 4, "failed": 2}
    assert "-1.0 is out of bounds" in result["reasons"][0]["reason"]
    batch = open_batch(result["table"])
    assert batch.column("run") == list(range(6))
    assert batch.series("tractor_y_m").shape == (6, 201)
    page = Path(result["page"]).read_text(encoding="utf-8")
    assert "out of bounds" in page
    assert "http" not in page.replace("http://www.w3.org", "")
    assert main(words) == 2
    assert "exists already; expected a new name, or --force" in capsys.readouterr().err


@pytest.mark.parametrize("form", [(), ("--json",)])
def test_a_sweep_of_which_every_run_failed_says_so_on_stderr(
    scenario: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], form: tuple[str, ...]
) -> None:
    words = ["sweep", scenario, "--vary", "start.speed_mph=-1,-2", "-o", str(tmp_path / "out")]
    assert main([*words, *form]) == 2
    last = capsys.readouterr().err.splitlines()[-1]
    assert last.startswith("truck-blowout: all 2 runs failed: --vary start.speed_mph: -1.0 is out")
    assert last.endswith("; 1 for other reasons")


@pytest.mark.parametrize("force", [False, True])
def test_an_interrupted_sweep_goes_on_and_gives_the_same_table(
    plan: Plan, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, force: bool
) -> None:
    monkeypatch.setattr(sweeping, "_PART_RUNS", 2)

    def stop(done: int, total: int) -> None:
        if done == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_sweep(plan, tmp_path / "a", workers=1, progress=stop, force=force)
    assert [p.name for p in (tmp_path / "a/parts").iterdir()] == ["000000.parquet"]
    told: list[int] = []
    resumed = run_sweep(plan, tmp_path / "a", force=force,
                        progress=lambda done, total: told.append(done))
    assert told == [2, 3, 4]
    whole = run_sweep(plan, tmp_path / "b")
    assert resumed.table.equals(whole.table)
    assert sorted(p.name for p in (tmp_path / "a").iterdir()) == ["runs.parquet", "sweep.json"]


def test_another_sweep_in_the_folder_is_refused(plan: Plan, tmp_path: Path) -> None:
    from dataclasses import replace

    run_sweep(plan, tmp_path / "a")
    other = replace(plan, vary=("reaction.time_s=1,2",))
    with pytest.raises(InputError, match="holds another sweep, of which vary differ"):
        run_sweep(other, tmp_path / "a")
    assert len(run_sweep(other, tmp_path / "a", force=True)) == 2


@pytest.mark.parametrize("edited", ["mine.yaml", "truck.yaml", "tire.yaml", "other.yaml"])
def test_an_interrupted_sweep_of_edited_files_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, edited: str
) -> None:
    """A file, one that it names, and one that only a varied word names."""
    texts = {"mine.yaml": "extends: blowout_in_lane\nend_s: 3\n",
             "tire.yaml": "extends: steer_275_80r22_5\n",
             "truck.yaml": "extends: international_9400i_trailmobile\n"
                           "tires: {steer: tire.yaml}\n",
             "other.yaml": "extends: truck.yaml\n"}
    for name, text in texts.items():
        (tmp_path / name).write_text(text, encoding="utf-8")
    plan = Plan(str(tmp_path / "mine.yaml"), str(tmp_path / "truck.yaml"),
                (f"vehicle={tmp_path / 'truck.yaml'},{tmp_path / 'other.yaml'}",), rate_hz=50.0)
    monkeypatch.setattr(sweeping, "_here", lambda *_: iter(()))
    monkeypatch.setattr(sweeping, "_finish", lambda *_: None)
    monkeypatch.setattr(sweeping, "open_batch", lambda _: None)
    run_sweep(plan, tmp_path / "out")
    run_sweep(plan, tmp_path / "out")
    with (tmp_path / edited).open("a", encoding="utf-8") as file:
        file.write(EDITS[edited])
    with pytest.raises(InputError, match="holds another sweep, of which files differ"):
        run_sweep(plan, tmp_path / "out")
    run_sweep(plan, tmp_path / "out", force=True)


@pytest.fixture(scope="module")
def cluster(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """Address of a Dask scheduler with two worker processes on this machine."""
    pytest.importorskip("distributed")
    folder = tmp_path_factory.mktemp("cluster")
    program = (
        "from distributed import LocalCluster\n"
        "if __name__ == '__main__':\n"
        "    cluster = LocalCluster(n_workers=2, threads_per_worker=1, processes=True,\n"
        "                           dashboard_address=None, host='127.0.0.1')\n"
        "    print(cluster.scheduler_address, flush=True)\n"
        "    input()\n"
    )
    (folder / "cluster.py").write_text(program)
    process = subprocess.Popen([sys.executable, str(folder / "cluster.py")], text=True,
                               stdin=subprocess.PIPE, stdout=subprocess.PIPE, cwd=folder,
                               stderr=subprocess.DEVNULL)
    assert process.stdout is not None
    yield process.stdout.readline().strip()
    process.communicate("\n", timeout=20)


def test_a_cluster_of_two_processes_gives_the_same_table(
    cluster: str, plan: Plan, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sweeping, "_PART_RUNS", 2)
    there = run_sweep(plan, tmp_path / "there", scheduler=cluster)
    here = run_sweep(plan, tmp_path / "here")
    assert there.table.equals(here.table)


def test_no_scheduler_is_one_line(plan: Plan, tmp_path: Path,
                                  monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("distributed")
    monkeypatch.setattr(sweeping, "_CONNECT_S", 0.3)
    with pytest.raises(InputError, match="no scheduler answers"):
        run_sweep(plan, tmp_path / "a", scheduler="tcp://127.0.0.1:9")


def test_the_share_a_key_explains() -> None:
    rng = np.random.default_rng(1)
    words, numbers = np.arange(600) % 3, rng.uniform(size=600)
    outcome = 2.0 * words + rng.normal(scale=0.1, size=600)
    labels, at = groups([f"tire_{w}" for w in words])
    assert labels == ["tire_0", "tire_1", "tire_2"]
    assert share_explained(at, outcome) > 0.98
    assert groups(["0.5x", "2x", "0.5x"])[0] == ["0.5x", "2x"]
    assert len(groups([f"{x}x" for x in numbers])[0]) == 8
    bins, in_bins = groups(numbers.tolist())
    assert len(bins) == 8
    assert share_explained(in_bins, outcome) < 0.05
    assert share_explained(in_bins, numbers) > 0.95
    assert share_explained(at, np.full(600, 1.0)) == 0.0


def test_the_command_on_the_page_repeats_the_whole_plan(plan: Plan) -> None:
    from dataclasses import replace

    assert "--rate-hz 50.0 -o DIR" in _command(plan)
    assert "--step-s" not in _command(plan)
    whole = replace(plan, channels=("tractor_y_m", "tractor_x_m"), step_s=0.002, insist=True)
    assert _command(whole).endswith(
        "--channels tractor_y_m tractor_x_m --step-s 0.002 --rate-hz 50.0 --yes -o DIR")
