"""Draw docs/architecture.svg (and .png with --png): the rooms of the package as a house."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import NamedTuple

import matplotlib as mpl

mpl.use("Agg")
mpl.rcParams.update({"svg.hashsalt": "architecture", "font.family": "DejaVu Sans"})

import matplotlib.pyplot as plt  # noqa: E402 -- after the backend is chosen
from matplotlib.axes import Axes  # noqa: E402
from matplotlib.patches import FancyBboxPatch, Polygon  # noqa: E402

DOCS = Path(__file__).resolve().parents[1] / "docs"
INK = "#1f2d3a"


class Room(NamedTuple):
    """A box: lower left corner, size, and what is written in it."""

    x: float
    y: float
    width: float
    height: float
    name: str
    says: str
    color: str


DOOR, TELL, ASK, TIME, TRUCK, DATA = (
    "#f4d9a8", "#e3d6ee", "#f2c6c0", "#c9dff0", "#cfe6cf", "#d9ead3"
)  # fmt: skip

HOUSE = (
    Room(1.2, 10.75, 3.0, 1.1, "cli", "the terminal", DOOR),
    Room(4.4, 10.75, 2.5, 1.1, "nodes", "ROS 2", DOOR),
    Room(7.1, 10.75, 2.1, 1.1, "fmu", "FMI 3.0", DOOR),
    Room(1.2, 9.45, 8.0, 1.1, "proof", "tests the diagnosis on sealed cases", ASK),
    Room(1.2, 8.15, 8.0, 1.1, "report", "figures and pages of finished results", TELL),
    Room(1.2, 6.85, 8.0, 1.1, "diagnosis", "what the model lacks: locate, name, fit", ASK),
    Room(1.2, 5.55, 8.0, 1.1, "comparison", "model against recording: errors, ratings", TIME),
    Room(1.2, 4.25, 3.9, 1.1, "simulation", "a truck to step, scenarios, drivers", TIME),
    Room(5.3, 4.25, 3.9, 1.1, "motion", "pose of every part over time", TIME),
    Room(1.2, 2.95, 8.0, 1.1, "display", "frames, robot description, arrows of forces", TIME),
    Room(1.2, 1.65, 3.9, 1.1, "vehicle", "what a truck is: YAML with units", TRUCK),
    Room(1.2, 0.35, 3.9, 1.1, "physics", "what a truck does: one compiled step", TRUCK),
    Room(5.3, 0.35, 3.9, 2.4, "recordings", "what was measured:\nchannels, bags, CSV, .mat", DATA),
)
ANNEX = Room(
    10.6,
    0.35,
    3.3,
    2.4,
    "proving_ground",
    "an independent truck with\nconcealed effects",
    "#eeeeee",
)


def main() -> None:
    """Draw the picture into docs/."""
    figure = plt.figure(figsize=(11.5, 10.4))
    axes = figure.add_axes((0, 0, 1, 1))
    axes.set(xlim=(0, 14.3), ylim=(-1.55, 13.2))
    axes.axis("off")
    axes.add_patch(Polygon([(0.9, 12.0), (5.2, 13.05), (9.5, 12.0)], color="#8d6e5a"))
    for room in (*HOUSE, ANNEX):
        draw_room(axes, room)
    draw_rule(axes)
    draw_wall(axes)
    draw_run(axes)
    figure.savefig(DOCS / "architecture.svg", facecolor="white", metadata={"Date": None})
    if "--png" in sys.argv:
        figure.savefig(DOCS / "architecture.png", facecolor="white", dpi=80)


def draw_room(axes: Axes, room: Room) -> None:
    """Draw one box with its name in bold above what it is for."""
    style = "round,pad=0,rounding_size=0.08"
    corner = (room.x, room.y)
    box = FancyBboxPatch(
        corner, room.width, room.height, boxstyle=style, facecolor=room.color, edgecolor=INK
    )
    axes.add_patch(box)
    x, y = room.x + room.width / 2, room.y + room.height / 2
    axes.text(x, y + 0.22, room.name, ha="center", va="center", weight="bold", size=14, color=INK)
    axes.text(x, y - 0.12, room.says, ha="center", va="top", size=10, color=INK)


def draw_rule(axes: Axes) -> None:
    """Draw the arrow down the left side: the one rule of the house."""
    arrow(axes, (0.65, 11.8), (0.65, 0.35))
    axes.text(
        0.35, 6.0, "imports go down only", rotation=90, ha="center", va="center", size=11, color=INK
    )


def draw_wall(axes: Axes) -> None:
    """Draw what separates the independent truth from the model, and what crosses it."""
    axes.plot([9.9, 9.9], [0.1, 6.4], color="#b03a2e", linewidth=3, linestyle=(0, (4, 2)))
    axes.text(10.1, 6.1, "No import crosses this wall.", size=10, color="#b03a2e", va="center")
    axes.text(
        10.1, 5.1,
        "Only recordings cross it: the diagnosis\nfinds the concealed effect from\nthem alone.",
        size=10, color=INK, va="center",
    )  # fmt: skip
    arrow(axes, (10.6, 1.2), (9.25, 1.2))


def draw_run(axes: Axes) -> None:
    """Write the path of one run's data below the house."""
    stations = "YAML", "Vehicle", "parameters", "step × n", "Recording", "bag · comparison · page"
    axes.text(1.2, -0.35, "The data of one run:", size=10, color=INK, va="center")
    x = 1.2
    for station in stations:
        width = 0.5 + 0.125 * len(station)
        axes.text(
            x + width / 2, -1.0, station, ha="center", va="center", size=10.5, color=INK,
            bbox={"boxstyle": "round,pad=0.35", "facecolor": "#f7f7f7", "edgecolor": INK},
        )  # fmt: skip
        x += width + 0.45
        if station != stations[-1]:
            arrow(axes, (x - 0.42, -1.0), (x - 0.03, -1.0))


def arrow(axes: Axes, start: tuple[float, float], end: tuple[float, float]) -> None:
    """Draw an arrow."""
    style = {"arrowstyle": "-|>", "color": INK, "linewidth": 1.6}
    axes.annotate("", xy=end, xytext=start, arrowprops=style)


if __name__ == "__main__":
    main()
