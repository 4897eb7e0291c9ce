"""The parts of a diagnosis: effects, their places and parameters, location, fit.

Times are on the recording's own clock, positions in the named body's ``base_link`` frame (x
forward, y left), angles in radians; intervals are central 90 % ones. A bound that the data leave
open is ``inf`` or ``-inf`` here and ``null`` in JSON.

Validated with: test/report/test_result_json.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, get_args

Interval = tuple[float, float]
Verdict = Literal["consistent", "miscalibrated", "sensor_artefact", "missing_physics", "unknown"]
Kind = Literal["physics", "sensor", "parameter"]
VERDICTS: tuple[str, ...] = get_args(Verdict)
KINDS: tuple[str, ...] = get_args(Kind)


@dataclass(frozen=True)
class Place:
    """Where something acts; ``None`` where it does not apply."""

    body: str | None = None
    axle: str | None = None
    hub: str | None = None
    tire: str | None = None

    def __str__(self) -> str:
        return self.tire or self.hub or self.axle or self.body or ""


@dataclass(frozen=True)
class Parameter:
    """A number with its 90 % interval.

    Attributes:
        value: estimate, in ``unit``.
        unit: SI unit, ``1`` for a pure number.
        ci90: lower and upper bound.
    """

    value: float
    unit: str
    ci90: Interval


@dataclass(frozen=True)
class Effect:
    """One cause that the evidence names.

    Attributes:
        name: canonical name of the effect.
        kind: of what it is.
        where: place it acts at.
        parameters: by name.
        equation: its law, as a person writes it.
        sentence: for a person.
        onset_s: since when; ``None``: always there.
        onset_ci90_s: interval of the onset.
        instrument: which one, in words, of a sensor's fault; ``channels``: those it spoils.
    """

    name: str
    kind: Kind
    where: Place
    parameters: Mapping[str, Parameter]
    equation: str
    sentence: str
    onset_s: float | None = None
    onset_ci90_s: Interval | None = None
    instrument: str = ""
    channels: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise ValueError(f"kind {self.kind!r} is none of {', '.join(KINDS)}")


@dataclass(frozen=True)
class ChannelSigma:
    """Mismatch of a channel: rms of the residual over the channel's noise."""

    name: str
    sigma: float


@dataclass(frozen=True)
class Wrench:
    """Force and yaw moment missing on a body, about its ``base_link``, body axes."""

    fx_n: float
    fy_n: float
    mz_nm: float


@dataclass(frozen=True)
class Location:
    """Where, when and in which channels model and truck differ.

    Attributes:
        channels: worst first.
        interval_s: from, to.
        body: the unit the missing wrench acts on.
        line_of_action_x_m: where its lateral force acts, forward of the body's ``base_link``.
        line_of_action_ci90_m: interval of the same.
        wrench: mean over the interval.
    """

    channels: tuple[ChannelSigma, ...] = ()
    interval_s: Interval | None = None
    body: str | None = None
    line_of_action_x_m: float | None = None
    line_of_action_ci90_m: Interval | None = None
    wrench: Wrench | None = None


@dataclass(frozen=True)
class Fit:
    """Rms residual in units of noise by channel, of the model as given and as diagnosed."""

    before: Mapping[str, float] = field(default_factory=dict)
    after: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class AliasSet:
    """What these recordings cannot tell apart, best first.

    Attributes:
        names: canonical names; the effect's own comes first.
        places: place of each in words, as far as it differs; empty or as long as ``names``.
        splits: channel or run that would tell them apart.
    """

    names: tuple[str, ...]
    places: tuple[str, ...] = ()
    splits: str = ""
