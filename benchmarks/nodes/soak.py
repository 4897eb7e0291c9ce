"""`python -m benchmarks.nodes soak MINUTES FACTOR [read] [driven] [record]`: one node, a long time.

`read`: another process reads every topic. `driven`: `lane_keeper` drives, and at two thirds of the
time a steer tire bursts, so that the last third begins with a truck that brakes and stands.
`record`: a bag is written. Prints a row a minute to the standard error, and a table at the end.
"""

from __future__ import annotations

import contextlib
import statistics
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from benchmarks.nodes.harness import Measured, lane_keeper, listen, listener, simulator
from benchmarks.nodes.rows import row

_SETTLE_S = 30.0
_SAMPLE_EVERY_S = 10.0
_PERIOD_S = 0.01


def soak(minutes: float, factor: float, words: set[str]) -> None:
    """Run and print.

    Args:
        minutes: wall time, after half a minute of settling.
        factor: real-time factor wanted.
        words: `read`, `driven`, `record`.
    """
    span_s = 60.0 * minutes
    blow_at_s = (_SETTLE_S + span_s * 2.0 / 3.0) * factor
    with contextlib.ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory()))
        options = ["--initial-speed-mps", 20, "--real-time-factor", factor]
        options += ["--blow", f"steer_left@{blow_at_s:g}"] if "driven" in words else []
        options += ["--record-path", folder / "bag"] if "record" in words else []
        node = stack.enter_context(simulator(*options))
        if "driven" in words:
            stack.enter_context(lane_keeper())
        if "read" in words:
            stack.enter_context(listener())
        time.sleep(_SETTLE_S)
        begin_cpu_s = node.cpu_s()
        memory_mb, heard = _watch(node, span_s)
        share = (node.cpu_s() - begin_cpu_s) / span_s
    _print(minutes, factor, memory_mb, heard, share)


def _watch(node: Measured, span_s: float) -> tuple[list[float], dict[str, list[float]]]:
    samples = [node.memory_mb()]
    with ThreadPoolExecutor(1) as reader:
        heard = reader.submit(listen, span_s)
        while not heard.done():
            time.sleep(_SAMPLE_EVERY_S)
            samples.append(node.memory_mb())
            if len(samples) % 6 == 1:
                print(f"{len(samples) // 6} min: {samples[-1]:.1f} MB", file=sys.stderr, flush=True)
    return samples, heard.result()


def _print(
    minutes: float, factor: float, memory_mb: list[float], heard: dict[str, list[float]],
    share: float,
) -> None:  # fmt: skip
    quarter = len(memory_mb) // 4
    growth = statistics.mean(memory_mb[-quarter:]) - statistics.mean(
        memory_mb[-2 * quarter : -quarter]
    )
    gaps = [b - a for a, b in zip(heard["stamp_s"], heard["stamp_s"][1:], strict=False)]
    lost = sum(round(gap / _PERIOD_S) - 1 for gap in gaps if gap > 1.5 * _PERIOD_S)
    wanted = factor * (heard["arrival_s"][-1] - heard["arrival_s"][0]) / _PERIOD_S
    row("resident memory after 30 s", memory_mb[0], "MB", "")
    row(f"resident memory after {minutes:g} min at factor {factor:g}", memory_mb[-1], "MB", "")
    row("growth between the third and the last quarter", growth, "MB", "0")
    row("share of one core", 100 * share, "%", "")
    row("factor, mean", statistics.mean(heard["factor"]), "", f"{factor:g}")
    row("lateness p99 in the node, median of reports", statistics.median(heard["late_p99_ms"]),
        "ms", "2")  # fmt: skip
    row("lateness p99 in the node, worst report", max(heard["late_p99_ms"]), "ms", "")
    row("periods wanted", wanted, "", "")
    row("periods simulated", len(heard["stamp_s"]) + lost, "", "")
    row("messages of odometry that the listener missed", lost, "", "0")
    row("reports in which the state was not finite", sum(heard["not_finite"]), "", "0")
    row("speed at the end", heard["speed_mps"][-1], "m/s", "")
