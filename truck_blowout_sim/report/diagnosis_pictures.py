"""All pictures of a diagnosis, in the order of its page."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.diagnosis.result import ChannelTimeMap, Diagnosis, Overlay
from truck_blowout_sim.report.diagnosis_fits import (
    candidates_picture,
    fit_picture,
    overlay_picture,
    pulls_picture,
)
from truck_blowout_sim.report.diagnosis_maps import beat_picture, force_picture, map_picture
from truck_blowout_sim.report.style import Picture, styled
from truck_blowout_sim.report.truck_drawing import draw_truck
from truck_blowout_sim.vehicle import Vehicle

_MOST_PANELS, _WORST_PANELS = 8, 4
_ORDER = {"train": 0, "holdout": 1, "baseline": 2}


@dataclass(frozen=True)
class DiagnosisPictures:
    """Pictures by part of the page; empty or ``None`` where there is nothing to draw."""

    worst: Picture | None
    truck: Picture | None
    maps: tuple[Picture, ...]
    forces: tuple[Picture, ...]
    beats: Picture | None
    candidates: Picture | None
    fit: Picture | None
    overlays: tuple[Picture, ...]
    pulls: Picture | None

    @property
    def everything(self) -> tuple[Picture, ...]:
        """All of them in order."""
        single = (self.worst, self.truck, self.beats, self.candidates, self.fit, self.pulls)
        parts = (*self.maps, *self.forces, *self.overlays, *(p for p in single if p is not None))
        return tuple(sorted(parts, key=lambda picture: picture.name))


@styled
def diagnosis_pictures(
    diagnosis: Diagnosis, vehicle: Vehicle, labels: Mapping[str, str], brief: bool = False
) -> DiagnosisPictures:
    """Draw everything there is evidence for.

    ``brief``: only what is printed, and of each role only the worst map.
    """
    evidence = diagnosis.evidence
    fits = {"train": diagnosis.train, "holdout": diagnosis.holdout}
    return DiagnosisPictures(
        worst=_worst(diagnosis, labels),
        truck=_truck(diagnosis, vehicle),
        maps=tuple(map_picture(m, labels, k)
                   for k, m in enumerate(_maps(evidence.maps, brief), 1)),
        forces=() if brief else tuple(
            force_picture(f, k) for k, f in enumerate(evidence.forces, 1)),
        beats=beat_picture(evidence.beats) if evidence.beats and not brief else None,
        candidates=(candidates_picture(evidence.candidates)
                    if evidence.candidates and not brief else None),
        fit=fit_picture(fits, labels) if any(f.before for f in fits.values()) else None,
        overlays=() if brief else _overlays(evidence.overlays, labels, evidence.blowouts),
        pulls=(pulls_picture(evidence.calibrated)
               if evidence.calibrated and not brief else None),
    )


def _worst(diagnosis: Diagnosis, labels: Mapping[str, str]) -> Picture | None:
    """The run that the given model misses most, in the channels that show the cause best.

    Those are what the sentence is about, and the channels whose error the diagnosis lowers most;
    without one, the worst.
    """
    about = diagnosis.evidence.about
    drawn = [o for o in diagnosis.evidence.overlays if o.role != "baseline" and o.noise]
    if not drawn:
        return None
    miss: dict[str, float] = {}
    for one in drawn:
        miss[one.recording] = miss.get(one.recording, 0.0) + _missed(one, one.before)
    run = max(miss, key=lambda name: miss[name])
    own = sorted((o for o in drawn if o.recording == run),
                 key=lambda o: (o.channel not in about, -_explained(o)))
    return overlay_picture(own[:_WORST_PANELS], labels, "worst", diagnosis.evidence.blowouts)


def _missed(overlay: Overlay, model: NDArray[np.float64]) -> float:
    """Mean square of what a model misses, in squares of the channel's noise."""
    left = (overlay.measured - model) / (overlay.noise or 1.0)
    return float(np.nanmean(left**2)) if np.isfinite(left).any() else 0.0


def _explained(overlay: Overlay) -> float:
    """How much of it the diagnosed model explains."""
    before = _missed(overlay, overlay.before)
    return before if overlay.after is None else before - _missed(overlay, overlay.after)


def _truck(diagnosis: Diagnosis, vehicle: Vehicle) -> Picture | None:
    if not diagnosis.effects and diagnosis.location.line_of_action_x_m is None:
        return None
    caption = (
        "From above, forward to the right. The missing lateral force acts along the line; "
        "which wheel it comes from, the line alone does not say."
        if diagnosis.location.line_of_action_x_m is not None
        else "From above, forward to the right."
    )
    figure = draw_truck(vehicle, diagnosis)
    return Picture("truck", "The vehicle", caption, figure)


def _maps(maps: tuple[ChannelTimeMap, ...], briefly: bool) -> tuple[ChannelTimeMap, ...]:
    """All of them, or of each role the one with the largest mismatch, in their order."""
    if not briefly:
        return maps
    worst: dict[str, ChannelTimeMap] = {}
    for one in sorted(maps, key=lambda m: -float(np.nansum(m.before**2))):
        worst.setdefault(one.role, one)
    return tuple(m for m in maps if worst[m.role] is m)


def _overlays(overlays: tuple[Overlay, ...], labels: Mapping[str, str],
              blowouts: Sequence[tuple[str, float, str]]) -> tuple[Picture, ...]:
    """One picture a recording and up to eight channels, training runs first."""

    def key(overlay: Overlay) -> tuple[int, str]:
        return _ORDER[overlay.role], overlay.recording

    pictures: list[Picture] = []
    for (_, _), group in groupby(sorted(overlays, key=key), key=key):
        members = list(group)
        for first in range(0, len(members), _MOST_PANELS):
            name = f"overlay_{len(pictures) + 1}"
            pictures.append(overlay_picture(members[first : first + _MOST_PANELS], labels, name,
                                            blowouts))
    return tuple(pictures)
