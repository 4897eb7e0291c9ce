"""Our tire-step beside that of the fastest published peer, both in the same minute.

The peer is the 24-degree-of-freedom model of uwsbel/low-fidelity-dynamic-models (C++, four TMeasy
tires, half-implicit steps). Clone it anywhere; this builds it in a temporary folder with
``g++ -O3 -march=native`` and lets both models step in turns. Nothing of it enters this repository.

    git clone https://github.com/uwsbel/low-fidelity-dynamic-models
    python -m benchmarks.peer low-fidelity-dynamic-models
"""

from __future__ import annotations

import statistics
import subprocess
import tempfile
from pathlib import Path
from time import thread_time

from benchmarks.core import PAIR, STEP_S, VEHICLE, turning
from benchmarks.page import Page, Place, Table, start_function
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.simulation import Inputs, Truck

ROUNDS, PART_S = 40, 2.0
SOUGHT = "0.65, better 0.5"
FLAGS = ("-std=c++17", "-O3", "-march=native", "-w")
ROWS: tuple[tuple[str, tuple[str, ...]], ...] = (
    ("tires intact", ()), ("steer tire blown", ("steer_left",)),
    ("both duals of a trailer hub blown", PAIR))  # fmt: skip


def build(checkout: Path, folder: Path) -> list[str]:
    """Compile the peer with our loop around it; the command that runs it."""
    models = checkout / "wheeled_vehicle_models"
    program = folder / "peer_24dof"
    sources = [Path(__file__).with_name("peer_24dof.cpp"), models / "24dof/dof24.cpp",
               models / "24dof/dof24_halfImplicit.cpp", models / "utils/utils.cpp"]
    places = [f"-I{models / place}" for place in ("24dof", "utils", "third_party")]
    subprocess.run(["g++", *FLAGS, *places, *map(str, sources), "-o", str(program)], check=True)
    car = models / "24dof/data/json/HMMWV"
    parts = (str(car / f"{name}.json") for name in ("vehicle", "tmeasy", "suspension"))
    return [str(program), *parts, str(models / "24dof/data/input/acc10.txt")]


def commit(checkout: Path) -> str:
    """Which state of the peer it is, and of which day."""
    done = subprocess.run(["git", "-C", str(checkout), "log", "-1", "--format=%h of %cs"],
                          check=False, capture_output=True, text=True)
    if done.returncode or not (checkout / "wheeled_vehicle_models").is_dir():
        raise InputError("no checkout of low-fidelity-dynamic-models", file=checkout)
    return done.stdout.strip()


def our_seconds(truck: Truck, turn: Inputs) -> float:
    """Processor time of one of our tire-steps."""
    steps = round(PART_S / STEP_S)
    start = thread_time()
    truck.advance(turn, steps)
    return (thread_time() - start) / steps / len(truck.vehicle.tires)


def peer_seconds(peer: subprocess.Popen[str]) -> float:
    """Processor time of one of its tire-steps."""
    assert peer.stdin is not None
    assert peer.stdout is not None
    peer.stdin.write(f"{4.5 * PART_S}\n")  # as many tire-steps
    peer.stdin.flush()
    seconds, steps = peer.stdout.readline().split()
    return float(seconds) / int(steps) / 4.0


def in_turns(command: list[str], blown: tuple[str, ...]) -> list[tuple[float, float]]:
    """Pairs of our processor time and the peer's, a tire-step."""
    truck, turn = turning(VEHICLE, blown)
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                          text=True) as peer:
        pairs = [(our_seconds(truck, turn), peer_seconds(peer)) for _ in range(ROUNDS)]
        peer.communicate()  # ends at the end of its input
    return pairs


def main(checkout: Path, page: Page = None) -> None:
    """Step both in turns, blown and sound."""
    place, which = Place(page, "peer"), commit(checkout)
    table = Table("", "ours, a tire-step", "peer", "ratio", f"median of {ROUNDS} pairs")
    with tempfile.TemporaryDirectory() as folder:
        command = build(checkout.resolve(), Path(folder))
        for what, blown in ROWS:
            pairs = in_turns(command, blown)
            ours, theirs = (min(side) for side in zip(*pairs, strict=True))
            table.row(what, f"{1e9 * ours:.1f} ns", f"{1e9 * theirs:.1f} ns",
                      f"{ours / theirs:.2f}", f"{statistics.median(a / b for a, b in pairs):.2f}")
    table.row("sought", "", "", SOUGHT, "")
    place.put(f"Peer: commit {which}, `g++ {' '.join(FLAGS)}`.", table)


if __name__ == "__main__":
    start_function(main)
