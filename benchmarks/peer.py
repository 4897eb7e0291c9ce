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
import sys
import tempfile
from pathlib import Path
from time import thread_time

from benchmarks.core import STEP_S, VEHICLE
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.vehicle import load_vehicle

ROUNDS, PART_S = 40, 2.0
REQUIRED, SOUGHT = 0.65, 0.5
FLAGS = ("-std=c++17", "-O3", "-march=native", "-w")


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


def our_seconds(truck: Truck) -> float:
    """Processor time of one of our tire-steps."""
    steps, turn = round(PART_S / STEP_S), Inputs(1.0, 0.35)
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


def main(checkout: Path) -> None:
    """Step both in turns; print times and ratios, blown and sound."""
    for blown in ((), ("steer_left",), ("trailer_1_left_outer", "trailer_1_left_inner")):
        truck = Truck(load_vehicle(VEHICLE), initial=InitialState(speed_mps=13.9))
        truck.advance(Inputs(1.0, 0.35), 1000)
        for tire in blown:
            truck.blow(tire)
        with tempfile.TemporaryDirectory() as folder, subprocess.Popen(
                build(checkout, Path(folder)), stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                text=True) as peer:
            pairs = [(our_seconds(truck), peer_seconds(peer)) for _ in range(ROUNDS)]
            peer.stdin.close() if peer.stdin else None
        ours, theirs = (min(side) for side in zip(*pairs, strict=True))
        ratio = statistics.median(a / b for a, b in pairs)
        print(f"{', '.join(blown) or 'sound':<45} ours {1e9 * ours:6.1f} ns, peer "
              f"{1e9 * theirs:6.1f} ns a tire-step; ratio of the best {ours / theirs:.2f}, "
              f"median of {ROUNDS} pairs {ratio:.2f} (required {REQUIRED}, sought {SOUGHT})")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
