"""What a diagnosis assumes, read from ``config/diagnosis/*.yaml``."""

from __future__ import annotations

import math
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.diagnosis.effects.roles import ROLES, Part, parts_of
from truck_blowout_sim.diagnosis.nuisance import Nuisance
from truck_blowout_sim.diagnosis.settings_file import check_keys, number_at, settings_tree
from truck_blowout_sim.errors import InputError, nearest
from truck_blowout_sim.recordings import channels_for
from truck_blowout_sim.resources import config_file
from truck_blowout_sim.vehicle import Packed
from truck_blowout_sim.vehicle.packing import packed_spreads

_TOP_KEYS = {"sheet", "channels", "method"}
_MAY_BE_SAID = {"extends", "without", "forms"}
_KINDS = ("scale", "add")
STATED = "spread in the vehicle file"
_ONLY = ("", "blowout", "brakes")
_CHANNELS = tuple(channel.name for channel in channels_for())
# steps beyond 7.1 ms are not stable for a sound truck; shares end at the whole
_MOST = {"trial_step_s": 0.0071, "coarsest_step_s": 0.0071, "false_alarms": 0.5}
_MAY_BE_ZERO = ("skip_s",)
_CHANNEL_KEYS = {"floor", "relative", "bias", "gain", "source"}
_NUMBER_KEYS = {"for", "kind", "step", "sign", "times", "targets", "opposite", "only", "source",
                "spread_of"}


@dataclass(frozen=True)
class ChannelRule:
    """How far good models of one truck differ in a channel, and how a normal instrument errs."""

    floor: float
    relative: float
    bias: float = 0.0
    gain: float = 0.0


@dataclass(frozen=True)
class Settings:
    """Everything the method assumes.

    Attributes:
        nuisances: spec-sheet numbers with priors, made for one vehicle.
        channels: rules by a piece of the channel's name.
        trial_step_s: integration step of everything that is tried; coarsest_step_s: the same for
            a quick answer.
        episode_s: a part of a long run that differs from the model as a run of its own does.
        bin_s, skip_s, correlation_s: averaging time, start left out, duration of a difference.
        swing_s: time over which the size of a motion is taken.
        false_alarms: share of cases with nothing missing in which anything may be stated.
        form_share: 1 sigma of what another form of law does to an amount, as a share of it.
        forms: by effect, instead of ``form_share``, where laws of its kind differ more.
        without: names of effects that are not considered; asked for, not read from the file.
    """

    nuisances: tuple[Nuisance, ...]
    channels: Mapping[str, ChannelRule]
    trial_step_s: float
    coarsest_step_s: float
    bin_s: float
    skip_s: float
    episode_s: float
    correlation_s: float
    swing_s: float
    false_alarms: float
    form_share: float
    forms: Mapping[str, float] = field(default_factory=dict)
    without: tuple[str, ...] = ()

    @property
    def alarms_by_instrument(self) -> float:
        """False alarms that the check of the instruments may raise."""
        return 0.02 * self.false_alarms

    def alarms_by_name(self, baseline: bool) -> float:
        """False alarms that the search for names may raise: the others are for ``unknown``.

        Without ``baseline`` runs no test that ends there is made, and names have its share, too.
        """
        return (0.44 if baseline else 0.98) * self.false_alarms

    @property
    def alarms_by_rest(self) -> float:
        """Those that each test of what is left may raise: of all of it, and of one channel."""
        return 0.25 * self.false_alarms

    @property
    def alarms_by_sign(self) -> float:
        """Those that each of four signs may raise: a body's stand, and three kinds of beat."""
        return 0.01 * self.false_alarms

    @property
    def law_leaves(self) -> float:
        """Share of what an effect explains that an inexact form of its law may leave to others.

        Squares go with the square of how far two forms of one law differ (rms).
        """
        return max(self.form_share, *self.forms.values(), 0.0) ** 2

    def form(self, effect: str) -> float:
        """1 sigma of what another form of law does to an amount, as a share of it."""
        return self.forms.get(effect, self.form_share)

    def rule(self, channel: str) -> ChannelRule | None:
        """The rule of a channel, None for channels the diagnosis does not use."""
        for piece, rule in self.channels.items():
            if _covers(piece, channel):
                return rule
        return None


def _covers(piece: str, channel: str) -> bool:
    """Whether a key of ``channels`` stands for a channel: its end, or a piece of its name."""
    return channel.endswith(piece) if piece.startswith("_") else piece in channel


def load_settings(packed: Packed, name: str = "default") -> Settings:
    """Read the settings and expand them for one vehicle.

    Raises:
        InputError: unknown or missing key, no number where one belongs, a number that a part of the
            vehicle lacks; says file and key.
    """
    path = config_file("diagnosis", name)
    tree = settings_tree(path)
    check_keys(path, "", tree, {*_TOP_KEYS, *_MAY_BE_SAID}, _TOP_KEYS)
    for part in ("sheet", "channels"):
        check_keys(path, part, tree[part])
    method_keys = {f.name for f in fields(Settings)} - {
        "nuisances", "channels", "forms", "without"}
    check_keys(path, "method", tree["method"], method_keys, method_keys)
    stated = packed_spreads(packed)
    nuisances = [number for key, entry in tree["sheet"].items()
                 for number in _numbers(path, key, entry, packed, stated)]
    method: dict[str, Any] = {key: number_at(path, f"method.{key}", entry, "value")
                              for key, entry in tree["method"].items()}
    _check_method(path, method)
    channels = {key: _rule(path, key, entry) for key, entry in tree["channels"].items()}
    check_keys(path, "forms", tree.get("forms", {}), {effect.name for effect in LIBRARY})
    forms = {key: number_at(path, f"forms.{key}", entry, "share")
             for key, entry in tree.get("forms", {}).items()}
    return Settings(tuple(nuisances), channels, forms=forms, **method)


def _numbers(path: Path, key: str, entry: Mapping[str, Any], packed: Packed,
             stated: Mapping[str, float]) -> list[Nuisance]:
    """One number for each part of the vehicle in one of its roles; ``stated``: spreads."""
    where = f"sheet.{key}"
    check_keys(path, where, entry, _NUMBER_KEYS, {"for", "kind", "step", "targets"})
    check_keys(path, f"{where}.for", entry["for"], set(ROLES))
    kind, only = entry["kind"], entry.get("only", "")
    if kind not in _KINDS or only not in _ONLY:
        wrong, known = (kind, _KINDS) if kind not in _KINDS else (only, _ONLY)
        raise InputError(f"{wrong!r}", file=path, where=where,
                         expected="one of " + ", ".join(k for k in known if k))
    sign = number_at(path, where, {"sign": 1.0, **entry}, "sign")
    times = packed[_known(path, where, packed, entry["times"])] if "times" in entry else 1.0
    step, found = number_at(path, where, entry, "step") * times, []
    for role in entry["for"]:
        sigma = number_at(path, f"{where}.for", entry["for"], role) * times
        for part in parts_of(packed.vehicle, role):
            targets = _targets(path, where, packed, part, entry["targets"], sign)
            targets += _targets(path, where, packed, part, entry.get("opposite", ()), -sign)
            # a share of nothing says nothing
            if kind == "add" or any(packed[name] for name, _ in targets):
                told = entry.get("spread_of", entry["targets"])
                own = _stated(packed, stated, kind, _targets(path, where, packed, part, told, 1.0))
                if own or sigma:
                    found.append(Nuisance(part.named(key), kind, own or sigma, step,
                                          tuple(targets), only,
                                          STATED if own else str(entry.get("source", ""))))
    return found


def _stated(packed: Packed, spreads: Mapping[str, float], kind: str,
            targets: Sequence[tuple[str, float]]) -> float:
    """1 sigma of a number that the vehicle file states a spread of; 0 where it states none.

    What is stated of an axle is a share of both its hubs: it says nothing about how these differ,
    nor of what moves both one way, as the middle of a track.
    """
    names = {name for name, _ in targets}
    told = [name for name in sorted(names & spreads.keys()) if not name.startswith("hub.")
            or (kind == "scale" and {name.replace("_left.", "_right."),
                                     name.replace("_right.", "_left.")} <= names)]
    sizes = [spreads[name] / (abs(packed[name]) or 1.0) if kind == "scale" else spreads[name]
             for name in told]
    return sum(sizes) / len(sizes) if sizes else 0.0


def _targets(path: Path, where: str, packed: Packed, part: Part, patterns: Collection[str],
             sign: float) -> list[tuple[str, float]]:
    """Packed names of a part that patterns stand for, each with its sign."""
    return [(_known(path, where, packed, name), sign)
            for pattern in patterns for name in part.expand(pattern)]


def _known(path: Path, where: str, packed: Packed, name: str) -> str:
    """A packed name that the vehicle has."""
    if name not in packed.index:
        raise InputError(f"this vehicle has no number {name}", file=path, where=where,
                         expected="a packed parameter, or a role whose parts all have it")
    return name


def _check_method(path: Path, method: Mapping[str, float]) -> None:
    """None of these numbers can be below zero, few can be zero, and some have an upper end."""
    for key, value in method.items():
        most = _MOST.get(key, math.inf)
        if not 0.0 <= value <= most or (value == 0.0 and key not in _MAY_BE_ZERO):
            ends = "" if math.isinf(most) else f" and at most {most:g}"
            raise InputError(f"value is {value:g}", file=path, where=f"method.{key}",
                             expected=f"a number above 0{ends}")


def _rule(path: Path, name: str, entry: Mapping[str, Any]) -> ChannelRule:
    where = f"channels.{name}"
    if not any(_covers(name, channel) for channel in _CHANNELS):
        ends = {re.sub(r"^(tractor|trailer)", "", channel) for channel in _CHANNELS}
        raise InputError("no channel of this name", file=path, where=where,
                         expected=nearest(name, [*_CHANNELS, *sorted(ends)], "the end of a name"))
    check_keys(path, where, entry, _CHANNEL_KEYS, {"floor", "relative"})
    return ChannelRule(**{k: number_at(path, where, entry, k) for k in entry if k != "source"})
