"""Write the page: script, style and data in one file that needs no other.

Validated with: test/report/test_viewer.py.
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from pathlib import Path

from markupsafe import Markup

from truck_blowout_sim.report.page import render, write_text
from truck_blowout_sim.report.viewer.content import RunToShow, run_content

_HERE = Path(__file__).parent
_SCRIPTS = ("data.js", "solid.js", "tires.js", "truck.js", "world.js", "plots.js", "camera.js",
            "main.js")
_TOGETHER_M = 50.0  # runs that begin farther apart than this are brought to one start


def write_viewer(runs: Sequence[RunToShow], path: Path, title: str = "") -> Path:
    """Write the page of one or several runs.

    Args:
        runs: what is shown; the first one is drawn solid.
        path: the HTML file.
        title: of the page; the runs' names by default.

    Raises:
        StorageError: it cannot be written.
    """
    write_text(viewer_page(runs, title), path)
    return path


def viewer_page(runs: Sequence[RunToShow], title: str = "") -> str:
    """The page as text."""
    first = _start(runs[0])
    content = []
    for run in runs:
        moved, said = _beside(_start(run), first)
        content.append(run_content(run, first[:2], moved, said))
    scripts = "\n".join((_HERE / "assets" / name).read_text(encoding="utf-8") for name in _SCRIPTS)
    return render("viewer.html", {
        "title": title or " and ".join(run.recording.name for run in runs),
        "style": Markup((_HERE / "assets" / "viewer.css").read_text(encoding="utf-8")),
        "three": Markup((_HERE / "vendor" / "three.min.js").read_text(encoding="utf-8")),
        "scripts": Markup(scripts),
        "data": Markup(_json({"runs": content})),
    })  # fmt: skip


def _json(data: object) -> str:
    # "</script>" inside a name would end the element
    return json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")


def _start(run: RunToShow) -> tuple[float, float, float]:
    """Place and heading at the first instant."""
    track = next(iter(run.motion.units.values()))
    return float(track.x_m[0]), float(track.y_m[0]), float(track.yaw_rad[0])


def _beside(start: tuple[float, float, float], first: tuple[float, float, float]
            ) -> tuple[tuple[float, float, float], str]:
    """How a run is moved so that it can be seen beside the first one."""
    if math.dist(start[:2], first[:2]) <= _TOGETHER_M:
        return (0.0, 0.0, 0.0), ""
    moved = (first[0] - start[0], first[1] - start[1], first[2] - start[2])
    return moved, "its path is moved and turned so that it begins where the first run begins"
