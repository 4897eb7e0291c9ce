"""`python -m benchmarks.nodes [pace|fast|record|soak MINUTES FACTOR …]`: the node's figures.

`pace`: CPU share and jitter in real time, with a reader of odometry and diagnostics, and of every
topic. `fast`: factor achieved as fast as possible. `record`: the same two while a bag is written.
`soak`: many minutes, see `soak.py`. Prints a table; the machine's load is printed with it, because
a busy machine changes every figure.
"""

from __future__ import annotations

import contextlib
import statistics
import sys
import tempfile
import time
from itertools import pairwise
from pathlib import Path

from benchmarks.nodes.harness import listen, listener, simulator
from benchmarks.nodes.rows import HEAD, row
from benchmarks.nodes.soak import soak

_SETTLE_S = 3.0
_WINDOW_S = 20.0
_ALONE = "odometry and diagnostics read"


def percentile(values: list[float], part: float) -> float:
    """Value below which a part of the values lies."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, round(part * len(ordered)))]


def measured(words: tuple[object, ...], reader: str) -> tuple[dict[str, list[float]], float]:
    """What a listener hears of a driving node, and the node's share of one core meanwhile."""
    with (
        simulator("--initial-speed-mps", 20, *words) as node,
        listener(reader) if reader else contextlib.nullcontext(),
    ):
        time.sleep(_SETTLE_S)
        before_s, begin_s = node.cpu_s(), time.monotonic()
        heard = listen(_WINDOW_S)
        return heard, (node.cpu_s() - before_s) / (time.monotonic() - begin_s)


def pace(label: str, *words: object, reader: str = "") -> None:
    heard, share = measured(words, reader)
    gaps_ms = [1e3 * (b - a) for a, b in pairwise(heard["arrival_s"][100:])]
    jitter_ms = [abs(gap - 10.0) for gap in gaps_ms]
    row(f"CPU, real time, {label}", 100 * share, "% of a core", "40")
    row(f"lateness p99 in the node, {label}", statistics.median(heard["late_p99_ms"]), "ms", "2")
    row(f"jitter p99 at a reader, {label}", percentile(jitter_ms, 0.99), "ms", "2")
    row(f"factor, real time, {label}", statistics.mean(heard["factor"]), "", "1")


def fast(label: str, *words: object, reader: str = "") -> None:
    heard, share = measured(("--real-time-factor", 0, *words), reader)
    factor = statistics.median(heard["factor"][1:])
    row(f"factor, as fast as possible, {label}", factor, "", "60")
    row(f"simulated seconds a CPU second, {label}", factor / share, "", "60")


def main(words: list[str]) -> None:
    what = words[0] if words else "all"
    print(HEAD, flush=True)
    if what == "soak":
        soak(float(words[1]), float(words[2]), set(words[3:]))
        return
    if what in ("pace", "all"):
        pace(_ALONE)
        pace("every topic read", reader="reliable")
    if what in ("fast", "all"):
        fast(_ALONE)
        fast("every topic read", reader="reliable")
        fast("every topic read with best effort", reader="best_effort")
    if what in ("record", "all"):
        with tempfile.TemporaryDirectory() as folder:
            pace("recording", "--record-path", Path(folder) / "pace")
            fast("recording", "--record-path", Path(folder) / "fast")


if __name__ == "__main__":
    main(sys.argv[1:])
