"""One node, a long time: `benchmarks.nodes soak MINUTES FACTOR [read] [driven] [record] [-o PAGE]`.

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
from typing import Annotated

import typer

from benchmarks.nodes.harness import Measured, lane_keeper, listen, listener, simulator
from benchmarks.nodes.rows import Figures
from benchmarks.page import Page, Place
from truck_blowout_sim.errors import InputError

_SETTLE_S = 30.0
_SAMPLE_EVERY_S = 10.0
_PERIOD_S = 0.01
_WORDS = ("read", "driven", "record")


def soak(
    minutes: float, factor: float, words: Annotated[list[str] | None, typer.Argument()] = None,
    page: Page = None,
) -> None:  # fmt: skip
    """Run a node for MINUTES at FACTOR; words: read, driven, record."""
    place, words = Place(page, "soak"), words or []
    if not set(words) <= set(_WORDS):
        raise InputError(" ".join(words), file="WORDS", expected=f"some of {', '.join(_WORDS)}")
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
    table = _table(minutes, factor, memory_mb, heard, share)
    place.put(f"{minutes:g} minutes at factor {factor:g}: {', '.join(words) or 'alone'}.", table)


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


def _table(
    minutes: float, factor: float, memory_mb: list[float], heard: dict[str, list[float]],
    share: float,
) -> Figures:  # fmt: skip
    quarter = len(memory_mb) // 4
    growth = statistics.mean(memory_mb[-quarter:]) - statistics.mean(
        memory_mb[-2 * quarter : -quarter]
    )
    gaps = [b - a for a, b in zip(heard["stamp_s"], heard["stamp_s"][1:], strict=False)]
    lost = sum(round(gap / _PERIOD_S) - 1 for gap in gaps if gap > 1.5 * _PERIOD_S)
    wanted = factor * (heard["arrival_s"][-1] - heard["arrival_s"][0]) / _PERIOD_S
    late_ms = heard["late_p99_ms"]
    table = Figures()
    table.figure("resident memory after 30 s", memory_mb[0], "MB")
    table.figure("the same at the end", memory_mb[-1], "MB")
    table.figure("growth, third to last quarter", growth, "MB", "0")
    table.figure("processor", 100 * share, "% of a core", "40 %")
    table.figure("factor, mean", statistics.mean(heard["factor"]), "", f"{factor:g}")
    table.figure("lateness p99, median of reports", statistics.median(late_ms), "ms", "2 ms")
    table.figure("the same, worst", max(late_ms), "ms")
    table.figure("periods wanted", wanted)
    table.figure("periods simulated", len(heard["stamp_s"]) + lost)
    table.figure("odometry messages that the listener missed", lost, "", "0")
    table.figure("reports of a state not finite", sum(heard["not_finite"]), "", "0")
    table.figure("speed at the end", heard["speed_mps"][-1], "m/s")
    return table
