"""What a diagnosis assumes, read from ``config/diagnosis/*.yaml``."""

from __future__ import annotations

import fnmatch
import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field, fields
from pathlib import Path
from typing import Any

import yaml

from truck_blowout_sim.diagnosis.case.nuisance import Nuisance
from truck_blowout_sim.diagnosis.effects import LIBRARY
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.resources import config_file
from truck_blowout_sim.vehicle import Packed

_TOP_KEYS = {"nuisances", "brake_gain_sigma", "channels", "method"}
_KINDS = ("scale", "add")
_ONLY = ("", "blowout", "brakes")
_EVENT_FACTOR = 2.0  # more that an event must bring, because its instant was searched
_CHANNEL_KEYS = {"floor", "relative", "bias", "gain", "most", "source"}
_HARDER_KEYS = {"delta", "blown", "source"}
_NUISANCE_KEYS = {"kind", "sigma", "step", "sign", "targets", "opposite", "only", "source"}


@dataclass(frozen=True)
class ChannelRule:
    """How far good models of one truck differ in a channel, and how a normal instrument errs.

    ``most``: rms, in units of that difference, that runs with nothing missing leave at most.
    """

    floor: float
    relative: float
    bias: float = 0.0
    gain: float = 0.0
    most: float = math.inf


@dataclass(frozen=True)
class Settings:
    """Everything the method assumes.

    Attributes:
        nuisances: spec-sheet numbers with priors, made for one vehicle.
        channels: rules by a piece of the channel's name.
        trial_step_s: integration step of everything that is tried; coarsest_step_s: the same for
            a quick answer.
        bin_s, skip_s, correlation_s: averaging time, start left out, duration of a difference.
        accept_delta: fall of the sum of squares that a named effect must buy.
        form_share: 1 sigma of what another form of law does to an amount, as a share of it.
        flat_braked: how much wider models differ once a flat tire was braked.
        hard_from_mps2, hard_demand_s2pm: lateral acceleration from which on more evidence is asked,
            by what factor more with each 1 m/s2.
        calm_below_mps2, calm_share: on straighter courses less than ``unknown_delta`` is asked
            for, down to that share where nothing turns.
        null_median, null_tail: best evidence where nothing is missing, as a share of what is
            needed: half of such cases reach the one, and all of what is needed the share of the
            other.
        same_truck: share of what trucks differ by that is worth naming beside baseline runs.
        harder: by effect, for those that what is left between good models imitates;
            ``harder_blown``: the same where a tire is lost in training, if that differs.
        forms: by effect, instead of ``form_share``, where laws of its kind differ more.
        keep_within: share of the evidence within which explanations count as aliases.
        expected_level, unknown_level: sum of squares a row if nothing, if something is missing.
        unknown_delta: what a wrench that nothing named explains must buy to be a missing effect.
        lag_delta, posture_delta: what one wheel's lag, a body's stand must buy to be told.
        beat_turn, beat_tone: score from which on something beats once per wheel turn, or steadily.
        without: names of effects that are not considered; asked for, not read from the file.
    """

    nuisances: tuple[Nuisance, ...]
    channels: Mapping[str, ChannelRule]
    trial_step_s: float
    coarsest_step_s: float
    bin_s: float
    skip_s: float
    correlation_s: float
    accept_delta: float
    keep_within: float
    expected_level: float
    unknown_level: float
    unknown_delta: float
    lag_delta: float
    posture_delta: float
    beat_turn: float
    beat_tone: float
    form_share: float
    flat_braked: float
    hard_from_mps2: float
    hard_demand_s2pm: float
    calm_below_mps2: float
    calm_share: float
    same_truck: float
    null_median: float
    null_tail: float
    harder: Mapping[str, float] = field(default_factory=dict)
    harder_blown: Mapping[str, float] = field(default_factory=dict)
    forms: Mapping[str, float] = field(default_factory=dict)
    without: tuple[str, ...] = ()

    def form(self, effect: str) -> float:
        """1 sigma of what another form of law does to an amount, as a share of it."""
        return self.forms.get(effect, self.form_share)

    def needed(self, effect: str, event: bool = False, blown: bool = False) -> float:
        """Evidence that an effect of this name must have, more if its instant was searched.

        ``blown``: whether a tire is lost in the training runs.
        """
        usual = self.harder.get(effect, self.accept_delta)
        usual = self.harder_blown.get(effect, usual) if blown else usual
        return usual * (_EVENT_FACTOR if event else 1.0)

    def null_p_value(self, share: float) -> float:
        """Chance of this share of what is needed where nothing is missing.

        Even up to the share that half of such cases reach, exponential from there on.
        """
        beyond = (share - self.null_median) / (1.0 - self.null_median)
        if beyond <= 0.0:
            return 1.0 - 0.5 * max(share, 0.0) / self.null_median
        return max(0.5 * (self.null_tail / 0.5) ** beyond, 1e-12)

    def rule(self, channel: str) -> ChannelRule | None:
        """The rule of a channel, None for channels the diagnosis does not use."""
        for piece, rule in self.channels.items():
            matches = channel.endswith(piece) if piece.startswith("_") else piece in channel
            if matches:
                return rule
        return None


def load_settings(packed: Packed, name: str = "default") -> Settings:
    """Read the settings and expand them for one vehicle.

    Raises:
        InputError: unknown or missing key, or no number where one belongs; says file and key.
    """
    path = config_file("diagnosis", name)
    try:
        tree = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise InputError(f"not YAML: {error}", file=path) from None
    _check(path, "", tree, {*_TOP_KEYS, "harder", "forms"}, _TOP_KEYS)
    for part in ("nuisances", "channels"):
        _check(path, part, tree[part], set(tree[part] or ()))
    method_keys = {f.name for f in fields(Settings)} - {
        "nuisances", "channels", "harder", "harder_blown", "forms", "without"}
    _check(path, "method", tree["method"], method_keys, method_keys)
    nuisances = [_nuisance(path, key, entry, packed) for key, entry in tree["nuisances"].items()]
    nuisances += _brake_gains(packed, _number(path, "brake_gain_sigma", tree["brake_gain_sigma"],
                                              "value"))
    method: dict[str, Any] = {key: _number(path, f"method.{key}", entry, "value")
                              for key, entry in tree["method"].items()}
    channels = {key: _rule(path, key, entry) for key, entry in tree["channels"].items()}
    for part in ("harder", "forms"):
        _check(path, part, tree.get(part, {}), {effect.name for effect in LIBRARY})
    harder, blown = _thresholds(path, tree.get("harder", {}))
    forms = {key: _number(path, f"forms.{key}", entry, "share")
             for key, entry in tree.get("forms", {}).items()}
    return Settings(tuple(n for n in nuisances if n.targets), channels, harder=harder,
                    harder_blown=blown, forms=forms, **method)


def _thresholds(path: Path, tree: Mapping[str, Any]
                ) -> tuple[Mapping[str, float], Mapping[str, float]]:
    """What effects must buy, usually and where a tire is lost."""
    for key, entry in tree.items():
        _check(path, f"harder.{key}", entry, _HARDER_KEYS, {"delta"})
    usual = {key: _number(path, f"harder.{key}", entry, "delta") for key, entry in tree.items()}
    blown = {key: _number(path, f"harder.{key}", entry, "blown")
             for key, entry in tree.items() if "blown" in entry}
    return usual, blown


def _nuisance(path: Path, name: str, entry: Mapping[str, Any], packed: Packed) -> Nuisance:
    """One nuisance with its wildcards expanded; without targets if the vehicle has none."""
    where = f"nuisances.{name}"
    _check(path, where, entry, _NUISANCE_KEYS, {"kind", "targets"})
    kind, only = entry["kind"], entry.get("only", "")
    if kind not in _KINDS or only not in _ONLY:
        wrong, known = (kind, _KINDS) if kind not in _KINDS else (only, _ONLY)
        raise InputError(f"{wrong!r}", file=path, where=where,
                         expected="one of " + ", ".join(k for k in known if k))
    sign = _number(path, where, {"sign": 1.0, **entry}, "sign")
    targets = [(n, sign) for pattern in entry["targets"] for n in _expand(packed, pattern)]
    opposite = entry.get("opposite", ())
    targets += [(n, -sign) for pattern in opposite for n in _expand(packed, pattern)]
    return Nuisance(name, kind, _number(path, where, entry, "sigma"),
                    _number(path, where, entry, "step"), tuple(targets), only)


def _brake_gains(packed: Packed, sigma: float) -> list[Nuisance]:
    """One nuisance for the brake of each hub."""
    return [Nuisance(f"brake_gain_{hub}", "scale", sigma, 0.05, ((f"hub.{hub}.brake_gain", 1.0),),
                     "brakes") for hub in packed.vehicle.hubs]


def _expand(packed: Packed, pattern: str) -> list[str]:
    """Packed names that match; none if the vehicle lacks them."""
    return [n for n in packed.index if fnmatch.fnmatchcase(n, pattern)]


def _rule(path: Path, name: str, entry: Mapping[str, Any]) -> ChannelRule:
    where = f"channels.{name}"
    _check(path, where, entry, _CHANNEL_KEYS, {"floor", "relative"})
    return ChannelRule(**{k: _number(path, where, entry, k) for k in entry if k != "source"})


def _number(path: Path, where: str, entry: Mapping[str, Any], key: str) -> float:
    """A finite number under ``key``."""
    _check(path, where, entry, set(entry) if isinstance(entry, Mapping) else set(), {key})
    value = entry[key]
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise InputError(f"{key} is {value!r}", file=path, where=where, expected="a number")
    return float(value)


def _check(path: Path, where: str, entry: object, known: set[str],
           needed: Collection[str] = ()) -> None:
    """A mapping with all needed keys and none but the known ones."""
    if not isinstance(entry, Mapping):
        raise InputError(f"{entry!r}", file=path, where=where, expected="keys with values")
    if unknown := set(entry) - known:
        raise InputError(f"unknown key {min(map(str, unknown))!r}", file=path, where=where,
                         expected="one of " + ", ".join(sorted(known)))
    if missing := set(needed) - set(entry):
        raise InputError(f"key {min(missing)!r} is missing", file=path, where=where,
                         expected="each of " + ", ".join(sorted(needed)))
