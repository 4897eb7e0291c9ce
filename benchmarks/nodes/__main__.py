"""`python -m benchmarks.nodes pace|fast|both|soak MINUTES FACTOR … [-o PAGE]`: the node's figures.

`pace`: CPU share and jitter in real time; `fast`: factor achieved as fast as possible; both with
several readers, and while a bag is written. `soak`: many minutes, see `soak.py`. Each row states
the machine's load, which changes every figure.
"""

from __future__ import annotations

import contextlib
import statistics
import tempfile
import time
from itertools import pairwise
from pathlib import Path

import typer

from benchmarks.nodes.harness import listen, listener, simulator
from benchmarks.nodes.soak import soak
from benchmarks.page import Page, Place, Table, load, number, start

_SETTLE_S = 3.0
_WINDOW_S = 20.0
_FEW, _ALL = "odometry, diagnostics", "every topic"
# what is read, by which other process, whether a bag is written
_PACES = ((_FEW, "", False), (_ALL, "reliable", False), (f"{_FEW}; bag written", "", True))
_RACES = (*_PACES[:2], (f"{_ALL}, best effort", "best_effort", False), _PACES[2])
app = typer.Typer(no_args_is_help=True, add_completion=False, help=__doc__)


def percentile(values: list[float], part: float) -> float:
    """Value below which a part of the values lies."""
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, round(part * len(ordered)))]


def measured(factor: float, reader: str, recorded: bool) -> tuple[dict[str, list[float]], float]:
    """What a listener hears of a driving node, and the node's share of one core meanwhile."""
    with (
        tempfile.TemporaryDirectory() as folder,
        simulator("--initial-speed-mps", 20, "--real-time-factor", factor,
                  *(("--record-path", Path(folder) / "bag") if recorded else ())) as node,
        listener(reader) if reader else contextlib.nullcontext(),
    ):  # fmt: skip
        time.sleep(_SETTLE_S)
        before_s, begin_s = node.cpu_s(), time.monotonic()
        heard = listen(_WINDOW_S)
        return heard, (node.cpu_s() - before_s) / (time.monotonic() - begin_s)


@app.command()
def pace(page: Page = None) -> None:
    """Share of a core, lateness and jitter in real time."""
    place = Place(page, "pace")
    table = Table("read by other processes", "processor, % of a core", "lateness p99, ms",
                  "jitter at a reader p99, ms", "factor", "load average")
    for words, reader, recorded in _PACES:
        heard, share = measured(1.0, reader, recorded)
        gaps_ms = [1e3 * (b - a) for a, b in pairwise(heard["arrival_s"][100:])]
        jitter_ms = percentile([abs(gap - 10.0) for gap in gaps_ms], 0.99)
        late_ms, factor = statistics.median(heard["late_p99_ms"]), statistics.mean(heard["factor"])
        table.row(words, *map(number, (100.0 * share, late_ms, jitter_ms, factor)), f"{load():.1f}")
    table.row("sought", "40", "2", "2", "1", "")
    place.put(table)


@app.command()
def fast(page: Page = None) -> None:
    """Factor as fast as possible."""
    place = Place(page, "fast")
    table = Table("read by other processes", "factor", "simulated s a CPU second", "load average")
    for words, reader, recorded in _RACES:
        heard, share = measured(0.0, reader, recorded)
        factor = statistics.median(heard["factor"][1:])
        table.row(words, number(factor), number(factor / share), f"{load():.1f}")
    table.row("sought", "60", "60", "")
    place.put(table)


@app.command()
def both(page: Page = None) -> None:
    """First `pace`, then `fast`."""
    pace(page)
    fast(page)


app.command("soak")(soak)


if __name__ == "__main__":
    start(app)
