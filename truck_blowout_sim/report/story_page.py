"""One page for the whole way: record, model, mismatch, physics named, model amended, fit after.

Everything on it comes from finished results: a diagnosis and the comparisons with the given and
with the diagnosed vehicle.

Validated with: test/report/test_story_page.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from truck_blowout_sim.comparison import Comparison, verdict
from truck_blowout_sim.comparison.units import display_unit
from truck_blowout_sim.comparison.words import labels_for
from truck_blowout_sim.diagnosis.result import plain
from truck_blowout_sim.report.comparison_lines import draw_measured, event_times, marks_for
from truck_blowout_sim.report.page import render, write_text
from truck_blowout_sim.report.story_variants import Variant, variants_picture
from truck_blowout_sim.report.style import AFTER, BEFORE, Picture, mark_events, new_figure, styled

_SHOWN = (("tractor_yaw_rate_radps", "yaw rate of the tractor, left positive"),
          ("tractor_vx_mps", "speed"), ("tractor_across_m", "path, to the left"))
_INPUTS = (("steering_wheel_angle_rad", "hand wheel, left positive"),
           ("throttle", "throttle"), ("brake_pressure_trailer_pa", "trailer brake pressure"))
_VARIED = (("tractor_yaw_rate_radps", "yaw rate of the tractor, left positive"),
           ("steer_left_steer_rad", "left road wheel, left positive"))


@dataclass(frozen=True)
class Story:
    """What the page tells.

    Attributes:
        before: comparison with the given vehicle.
        after: comparison with the diagnosed vehicle.
        diagnosis: plain data of ``diagnosis.json``.
        links: further pages: words and address relative to the page.
        variants: the run with other models, and ``lesson``, what they teach; none: not told.
    """

    before: Comparison
    after: Comparison
    diagnosis: Mapping[str, Any]
    links: Sequence[tuple[str, str]] = ()
    variants: Sequence[Variant] = ()
    lesson: str = ""


def write_story(story: Story, path: Path) -> Path:
    """Write the page.

    Raises:
        StorageError: it cannot be written.
    """
    write_text(render("story.html", _content(story)), path)
    return path


def _content(story: Story) -> dict[str, object]:
    found = story.diagnosis
    location, fit = found["location"], found["fit"]["train"]
    said = found.get("summary") or {}
    effects = [{
        "name": effect["name"].replace("_", " "), "sentence": effect["sentence"],
        "equation": effect["equation"], "where": _place(effect["where"]),
        "parameters": [_parameter(name, value) for name, value in effect["parameters"].items()],
    } for effect in found["effects"]]  # fmt: skip
    labels = labels_for(story.before.vehicle)
    rows = [(labels.get(name, name), f"{before:.1f}", f"{fit['after'].get(name, float('nan')):.1f}")
            for name, before in fit["before"].items()]
    record = story.before.recording
    return {
        "record": record.name, "about": record.metadata.get("test", record.name),
        "origin": record.metadata.get("origin", "") if story.before.marks else "",
        "vehicle": story.before.vehicle.title, "result": verdict(story.before),
        "result_after": verdict(story.after),
        "verdict": found["verdict"].replace("_", " "), "effects": effects,
        "wrong": said.get("wrong", ""), "sure": said.get("sure", ""),
        "aliases": [" or ".join(n.replace("_", " ") for n in names)
                    for names in found["alias_sets"] if len(names) > 1],
        "location": _located(location, labels), "fit": rows,
        "next_test": found.get("next_test", ""),
        "added": _added(story), "links": list(story.links),
        "inputs": _inputs(story), "mismatch": _overlay(story, amended=False),
        "amended": _overlay(story, amended=True), "lesson": story.lesson,
        "variants": variants_picture(story.variants, _VARIED) if story.variants else None,
    }  # fmt: skip


def _place(where: Mapping[str, str | None]) -> str:
    words = [value for key in ("tire", "hub", "axle", "body") if (value := where.get(key))]
    return words[0].replace("_", " ") if words else "the truck"


def _parameter(name: str, value: Mapping[str, Any]) -> tuple[str, str, str]:
    low, high = (value["ci90"] or (None, None))
    interval = "" if low is None or high is None else f"{low:.3g} to {high:.3g}"
    return plain(name), f"{value['value']:.3g} {value['unit']}", interval


def _located(location: Mapping[str, Any], labels: Mapping[str, str]
             ) -> list[tuple[str, str]]:
    rows = []
    if location["channels"]:
        rows.append(("channels", ", ".join(
            f"{labels.get(c['name'], c['name'])} ({c['sigma']:.1f} σ)"
            for c in location["channels"])))
    if location["interval_s"]:
        rows.append(("from, to", "{:.2f} to {:.2f} s".format(*location["interval_s"])))
    if location["body"]:
        rows.append(("body", location["body"]))
    wrench = location["wrench"]
    if wrench and wrench["fx_n"] is not None:
        rows.append(("missing force", f"{wrench['fx_n']:.0f} N forward,"
                     f" {wrench['fy_n']:.0f} N to the left, {wrench['mz_nm']:.0f} N m in yaw"))
    return rows


def _added(story: Story) -> list[tuple[str, str]]:
    """Parameters of the diagnosed vehicle that the given one does not set."""
    given = story.before.vehicle.effects
    return [(name, f"{effect.value:.4g}") for name, effect in story.after.vehicle.effects.items()
            if name not in given or given[name].value != effect.value]


@styled
def _inputs(story: Story) -> Picture:
    comparison = story.before
    there = [(n, words) for n, words in _INPUTS if n in comparison.recording]
    figure = new_figure((8.4, 1.0 + 1.7 * len(there)))
    panels = figure.subplots(len(there), 1, sharex=True, squeeze=False)[:, 0]
    for axes, (name, words) in zip(panels, there, strict=True):
        series, unit = comparison.recording[name], display_unit(name)
        draw_measured(axes, series.time_s, series.value * unit.per_si, series.time_s,
                      comparison.marks.get(name))  # fmt: skip
        axes.set_title(words)
        axes.set_ylabel(unit.symbol)
        mark_events(axes, event_times(comparison), "")
    panels[-1].set_xlabel("time (s)")
    return Picture("inputs", "What the driver did", "The model is given the same inputs.", figure)


@styled
def _overlay(story: Story, *, amended: bool) -> Picture:
    """Record and model; with the amended model too, and the error of each below."""
    there = [(n, words) for n, words in _SHOWN if n in story.before.pairs]
    figure = new_figure((8.4, 0.6 + 3.2 * len(there)))
    panels = figure.subplots(2 * len(there), 1, sharex=True, height_ratios=(2, 1) * len(there))
    shown = [(story.before, "model as given", BEFORE)]
    if amended:
        shown.append((story.after, "model amended", AFTER))
    for k, (name, words) in enumerate(there):
        upper, lower, unit = panels[2 * k], panels[2 * k + 1], display_unit(name)
        pair = story.before.pairs[name]
        draw_measured(upper, pair.time_s, pair.measured * unit.per_si, pair.time_s,
                      marks_for(story.before, name))  # fmt: skip
        for comparison, label, color in shown:
            own = comparison.pairs[name]
            upper.plot(own.time_s, own.model * unit.per_si, color=color, label=label, zorder=3)
            error = (own.model - own.measured) * unit.per_si
            rms = float(np.sqrt(np.nanmean(error**2)))
            lower.plot(own.time_s, error, color=color, label=f"rms {rms:.2f} {unit.symbol}")
        upper.set_title(words)
        upper.set_ylabel(unit.symbol)
        lower.set_ylabel(f"error, {unit.symbol}")
        upper.legend(loc="best")
        lower.legend(loc="best", ncols=2)
        for axes in (upper, lower):
            mark_events(axes, event_times(story.before), "")
    panels[-1].set_xlabel("time (s)")
    title = "Before and after" if amended else "Record and model"
    return Picture("amended" if amended else "mismatch", title,
                   "Below each panel: model minus record.", figure)  # fmt: skip
