"""One look for every figure: dark on light, readable in print and by color-blind eyes.

Colors are those of Okabe and Ito. Figures are made without pyplot, so that drawing has no global
state, and their files are the same bytes for the same content.

References: M. Okabe, K. Ito, "Color universal design", 2008.
Validated with: test/report/test_style.py.
"""

from __future__ import annotations

import base64
import io
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ParamSpec, TypeVar

from matplotlib import rcParams
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.colors import to_hex
from matplotlib.figure import Figure
from matplotlib.rcsetup import cycler
from matplotlib.style import context as style_context
from matplotlib.ticker import NullFormatter

Arguments = ParamSpec("Arguments")
Result = TypeVar("Result")

INK, SOFT, GRID, PAPER = "#1b1f24", "#5b6570", "#e3e7eb", "#ffffff"
BLUE, VERMILION, GREEN = "#0072b2", "#d55e00", "#009e73"
ORANGE, SKY, PURPLE, YELLOW = "#e69f00", "#56b4e9", "#cc79a7", "#f0e442"
CYCLE = (BLUE, VERMILION, GREEN, ORANGE, PURPLE, SKY)

# What a line stands for has the same color on every page.
MEASURED, MODEL, BEFORE, AFTER, EVENT = INK, VERMILION, VERMILION, BLUE, SOFT

WIDE = (8.4, 3.5)
_PNG_DPI = 150
# The names that are allowed differ between versions of the library, hence no narrower type.
_STYLE: Any = {
    "axes.axisbelow": True,
    "axes.edgecolor": SOFT,
    "axes.grid": True,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.8,
    "axes.prop_cycle": cycler(color=CYCLE),
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlelocation": "left",
    "axes.titlesize": 11,
    "axes.titleweight": "bold",
    "figure.facecolor": PAPER,
    "font.family": "DejaVu Sans",
    "font.size": 9.5,
    "grid.color": GRID,
    "grid.linewidth": 0.8,
    "legend.fontsize": 8.5,
    "legend.frameon": False,
    "lines.linewidth": 1.5,
    "path.simplify_threshold": 0.3,
    "savefig.facecolor": PAPER,
    "svg.fonttype": "path",
    "svg.hashsalt": "truck_blowout_sim",
    "text.color": INK,
    "xtick.color": SOFT,
    "xtick.labelcolor": INK,
    "ytick.color": SOFT,
    "ytick.labelcolor": INK,
}
# The name of a recording may hold a dollar; before version 3.6 there is no such key.
if "text.parse_math" in rcParams:
    _STYLE["text.parse_math"] = False
# What is not set here is the library's default, not what the user's own settings say.
_WHOLE_STYLE = ["default", _STYLE]


_UNDATED: dict[str, Any] = {
    "png": {"Software": None}, "svg": {"Date": None, "Creator": None},
    "pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}  # fmt: skip
# what stands in the dark style for each color of the light one
_DARK = {PAPER: "#14191f", INK: "#e6eaee", SOFT: "#9aa6b2", GRID: "#2c343c", BLUE: SKY,
         SKY: YELLOW}


@dataclass(frozen=True, eq=False)
class Picture:
    """A finished figure.

    Attributes:
        name: file name without ending.
        title: what it shows.
        caption: what a reader should see in it.
        figure: the drawing.
    """

    name: str
    title: str
    caption: str
    figure: Figure

    def png(self) -> bytes:
        """Bitmap for documents."""
        return self._saved("png")

    def saved(self, form: str, *, dark: bool = False) -> bytes:
        """The figure as ``png``, ``svg`` or ``pdf``; dark: light ink on dark paper."""
        if dark:
            _darken(self.figure)
        return self._saved(form)

    def svg_uri(self) -> str:
        """Vector drawing as the address of an image, for a page that needs no other file."""
        text = base64.b64encode(self._saved("svg")).decode("ascii")
        return f"data:image/svg+xml;base64,{text}"

    def _saved(self, form: str) -> bytes:
        buffer = io.BytesIO()
        # Without a date and the library's version the same figure gives the same file.
        metadata = _UNDATED[form]
        with style_context(_WHOLE_STYLE):
            self._lay_out()
            self.figure.savefig(buffer, format=form, dpi=_PNG_DPI, metadata=metadata,
                                facecolor=self.figure.get_facecolor())
        return buffer.getvalue()

    def _lay_out(self) -> None:
        """Find the layout once; left to the library, saving draws everything twice for it."""
        engine = self.figure.get_layout_engine()
        if engine is not None:
            engine.execute(self.figure)
            self.figure.set_layout_engine(None)


def styled(draw: Callable[Arguments, Result]) -> Callable[Arguments, Result]:
    """Let a function draw in this style, whatever the user's own settings are."""

    def drawn(*args: Arguments.args, **kwargs: Arguments.kwargs) -> Result:
        with style_context(_WHOLE_STYLE):
            return draw(*args, **kwargs)

    drawn.__doc__ = draw.__doc__
    drawn.__name__ = draw.__name__
    return drawn


def new_figure(size: tuple[float, float] = WIDE) -> Figure:
    """An empty figure, laid out by itself; inches."""
    return Figure(figsize=size, layout="constrained")


def new_axes(size: tuple[float, float] = WIDE, *, x: str = "time (s)", y: str = ""
             ) -> tuple[Figure, Axes]:  # fmt: skip
    """A figure with one pair of axes; labels with their units."""
    figure = new_figure(size)
    axes = figure.add_subplot()
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    return figure, axes


def in_legend(name: str) -> str:
    """A name that a user gave as a legend shows it: one that begins with ``_`` is left out."""
    return f" {name}" if name.startswith("_") else name


def plain_log_ticks(axis: Axis) -> None:
    """Write 0.1, 1 and 10 at a logarithmic axis; the library's powers are formulas."""
    axis.set_major_formatter(_plain_number)
    axis.set_minor_formatter(NullFormatter())


def _plain_number(value: float, _: object) -> str:
    return f"{value:g}"


def mark_events(axes: Axes, times_s: tuple[float, ...], words: str = "blowout",
                height: float = 0.0) -> None:
    """Thin upright lines with a word on their left, at a height as a share of the panel."""
    for time_s in times_s:
        axes.axvline(time_s, color=EVENT, linewidth=1.0, linestyle=(0, (4, 3)), zorder=1)
        axes.annotate(words, (time_s, height), xycoords=("data", "axes fraction"), xytext=(-3, 3),
                      textcoords="offset points", ha="right", va="bottom", color=EVENT,
                      fontsize=8)  # fmt: skip


def _darken(figure: Figure) -> None:
    """Exchange the colors of the light style in everything drawn."""
    for artist in figure.findobj():
        for kind in ("color", "facecolor", "edgecolor"):
            get, put = getattr(artist, f"get_{kind}", None), getattr(artist, f"set_{kind}", None)
            if get is None or put is None:
                continue
            try:
                now = to_hex(get())
            except (ValueError, TypeError):
                continue  # a collection of colors is left as it is
            if now in _DARK:
                put(_DARK[now])
    for axes in figure.axes:
        axes.tick_params(colors=_DARK[SOFT], labelcolor=_DARK[INK])
        axes.set_facecolor(_DARK[PAPER])
    figure.set_facecolor(_DARK[PAPER])
