"""Processes to measure, and a listener in a process of its own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import psutil

ENVIRONMENT = {
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    # two measurements at a time must not hear each other
    "ROS_DOMAIN_ID": os.environ.get("ROS_DOMAIN_ID") or str(os.getpid() % 90 + 10),
    "ROS_LOG_DIR": str(Path(tempfile.gettempdir()) / "truck_blowout_sim_benchmark_log"),
}


@dataclass
class Measured:
    """A node under measurement."""

    process: psutil.Process

    def memory_mb(self) -> float:
        """Resident memory."""
        return float(self.process.memory_info().rss) / 1e6

    def cpu_s(self) -> float:
        """Processor time used so far."""
        times = self.process.cpu_times()
        return float(times.user + times.system)


@contextmanager
def simulator(*words: object) -> Iterator[Measured]:
    """A simulator node, up and running."""
    command = [sys.executable, "-m", "truck_blowout_sim.nodes.simulator", *map(str, words)]
    with tempfile.TemporaryDirectory(prefix="truck_blowout_sim_") as folder:
        log = Path(folder) / "log"
        with log.open("w") as stream:
            process = subprocess.Popen(
                command, env={**os.environ, **ENVIRONMENT}, stdout=stream, stderr=subprocess.STDOUT
            )
        try:
            while "; ready" not in log.read_text():
                if process.poll() is not None:
                    raise RuntimeError(log.read_text())
                time.sleep(0.05)
            yield Measured(psutil.Process(process.pid))
        finally:
            process.terminate()
            process.wait(30)


@contextmanager
def lane_keeper() -> Iterator[None]:
    """The shipped controller, driving."""
    process = subprocess.Popen(
        [sys.executable, "-m", "truck_blowout_sim.nodes.lane_keeper"],
        env={**os.environ, **ENVIRONMENT}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        yield
    finally:
        process.terminate()
        process.wait(30)


@contextmanager
def listener(reliability: str = "reliable") -> Iterator[None]:
    """A process that subscribes to every output and throws it away."""
    process = subprocess.Popen(
        [sys.executable, "-m", "benchmarks.nodes.listen", reliability],
        env={**os.environ, **ENVIRONMENT}, stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert process.stdout is not None
    process.stdout.readline()
    try:
        yield
    finally:
        process.terminate()
        process.wait(30)


def listen(duration_s: float) -> dict[str, list[float]]:
    """Arrival times of odometry, and what the diagnostics say, from another process."""
    done = subprocess.run(
        [sys.executable, "-m", "benchmarks.nodes.listen", str(duration_s)],
        env={**os.environ, **ENVIRONMENT}, stdout=subprocess.PIPE, text=True, check=True,
    )  # fmt: skip
    return dict(json.loads(done.stdout.splitlines()[-1]))
