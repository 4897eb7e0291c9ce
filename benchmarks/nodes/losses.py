"""`python -m benchmarks.nodes.losses [KILLS] [-o PAGE]`: a bag after kills and a full disk.

The disk is a file system in memory of 4 MB, which needs the right to mount; without it, that part
is left out.
"""

from __future__ import annotations

import os
import random
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated

import rclpy
import typer
from diagnostic_msgs.msg import DiagnosticArray
from rclpy.node import Node
from rosgraph_msgs.msg import Clock

from benchmarks.nodes.harness import ENVIRONMENT, Measured, simulator
from benchmarks.nodes.rows import Figures
from benchmarks.page import Page, Place, start_function
from truck_blowout_sim import read_recording
from truck_blowout_sim.nodes.runtime import new_executor
from truck_blowout_sim.recordings.recover import recover

_KILLS = 10
_SHORTEST_S, _LONGEST_S = 3.0, 6.0
_DISK_MB = 4


class Listener:
    """Hears the simulated time, and what the recorder says of itself."""

    def __init__(self) -> None:
        node = Node("benchmark_clock")
        self._executor = new_executor()
        self._executor.add_node(node)
        self.now_s, self.recorder, self.factor = 0.0, "", 0.0
        node.create_subscription(Clock, "/clock", self._tick, 10)
        node.create_subscription(DiagnosticArray, "/diagnostics", self._diagnose, 10)

    def spin(self, duration_s: float) -> None:
        """Hear for a while."""
        end_s = time.monotonic() + duration_s
        while (left_s := end_s - time.monotonic()) > 0:
            self._executor.spin_once(timeout_sec=left_s)

    def _tick(self, message: Clock) -> None:
        self.now_s = message.clock.sec + 1e-9 * message.clock.nanosec

    def _diagnose(self, message: DiagnosticArray) -> None:
        for status in message.status:
            if status.name.endswith("recorder"):
                self.recorder = status.message
            elif status.name.endswith("pace"):
                values = {pair.key: pair.value for pair in status.values}
                self.factor = float(values["real_time_factor"])


def kills(table: Figures, listener: Listener, count: int) -> None:
    """Kill a recording node at random instants; what is read back against what was heard."""
    lost_s, recovered = [], 0
    for number in range(count):
        with tempfile.TemporaryDirectory() as folder:
            bag = Path(folder) / "bag"
            with simulator("--initial-speed-mps", 20, "--record-path", bag) as node:
                listener.spin(random.Random(number).uniform(_SHORTEST_S, _LONGEST_S))
                node.process.kill()
                listener.spin(0.1)
            lost_s.append(listener.now_s - read_recording(bag).end_s)
            recover(bag)
            recovered += read_recording(bag).end_s > listener.now_s - 1.0
    median_s = statistics.median(lost_s)
    table.figure(f"`kill -9`, {count} times: lost of the bag, median", median_s, "s", "0.5 s")
    table.figure("the same, worst", max(lost_s), "s", "1 s")
    table.figure("whole again after `truck-blowout recover`", recovered, f"of {count}", str(count))


def full_disk(table: Figures, listener: Listener) -> None:
    """Let the disk fill while the node records; the simulation goes on."""
    with _small_disk() as folder:
        if folder is None:
            return
        bag = folder / "bag"
        with simulator("--initial-speed-mps", 20, "--record-path", bag) as node:
            begin_s = time.monotonic()
            while "cannot write" not in listener.recorder:
                listener.spin(0.2)
            filled_s, at_s = time.monotonic() - begin_s, listener.now_s
            listener.spin(3.0)
            after_s, factor = listener.now_s, listener.factor
            status = _end(node)
        read = read_recording(bag)
        table.figure(f"a disk of {_DISK_MB} MB: full after", filled_s, "s")
        table.figure("simulated in the next 3 s", after_s - at_s, "s", "3 s")
        table.figure("factor afterwards", factor, "", "1")
        table.figure("exit status of the node", status, "", "0")
        table.figure("length of the bag that is left", read.end_s - read.start_s, "s")


def _end(node: Measured) -> int:
    """Exit status of a node that is asked to end."""
    node.process.terminate()
    return node.process.wait(30) or 0


@contextmanager
def _small_disk() -> Iterator[Path | None]:
    with tempfile.TemporaryDirectory() as folder:
        options = ["mount", "-t", "tmpfs", "-o", f"size={_DISK_MB}m", "tmpfs", folder]
        mounted = subprocess.run(options, capture_output=True, check=False).returncode == 0
        if not mounted:
            print("no right to mount: the full disk is left out", file=sys.stderr)
        try:
            yield Path(folder) if mounted else None
        finally:
            if mounted:
                subprocess.run(["umount", folder], check=False)


def main(count: Annotated[int, typer.Argument(metavar="KILLS")] = _KILLS,
         page: Page = None) -> None:
    """Kill a recording node, and let a disk fill."""
    place, table = Place(page, "losses"), Figures()
    os.environ.update(ENVIRONMENT)
    rclpy.init()
    hearing = Listener()
    kills(table, hearing, count)
    full_disk(table, hearing)
    rclpy.shutdown()
    place.put(table)


if __name__ == "__main__":
    start_function(main)
