"""Judge one diagnosis against the sealed answer.

For a single cause the first effect counts: a right name in second place behind a wrong one is
wrong. With several causes each is looked for in all effects.

Validated with: test/proof/test_score.py.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from truck_blowout_sim.proof.cases import NOTHING_MISSING, Cause, Truth
from truck_blowout_sim.proof.comparable import ParameterScore, compare_parameter

ABRUPT = ("secondary_blowout", "payload_shift")
ERROR = "error"
# Map position and heading add up what speed and yaw rate are off by: seen there already.
_SUMS = ("_x_m", "_y_m", "_yaw_rad")


@dataclass(frozen=True)
class Fitted:
    """Mean over channels of the mean square residual on holdout, in instrument noise squared.

    Map position and heading are left out.
    """

    before: float
    after: float
    floor: float | None = None

    def removed(self, best: float) -> float | None:
        """(before - after) / (before - best); None where little could be removed."""
        if self.before <= 1.5 * best:
            return None
        return (self.before - self.after) / (self.before - best)


@dataclass(frozen=True)
class CauseScore:
    """How one cause was answered; None where the question does not arise."""

    name: str
    kind: str
    sigma: float | None
    raw: bool
    aliased: bool
    alias_size: int | None
    body: bool | None
    axle: bool | None
    onset_error_s: float | None
    onset_covered: bool | None
    parameter: ParameterScore | None


@dataclass(frozen=True)
class CaseScore:
    """How one case was answered."""

    case: str
    group: str
    verdict: str
    right: bool
    named: tuple[str, ...]
    aliases: tuple[tuple[str, ...], ...]
    kinds: tuple[str, ...]
    causes: tuple[CauseScore, ...]
    wheel_channels: bool
    p_value: float | None
    holdout: Fitted | None
    baselines: Mapping[str, float]
    cpu_s: float

    @property
    def detected(self) -> bool:
        """Whether anything is said to be wrong beyond calibration."""
        return self.verdict not in NOTHING_MISSING

    @property
    def solved(self) -> bool:
        """Right in verdict and, where something listed was concealed, in every name."""
        listed = self.group not in ("null", "unknown")
        return self.right and (not listed or all(c.aliased for c in self.causes))

    @property
    def sigma(self) -> float | None:
        """Visibility of the weakest cause."""
        known = [c.sigma for c in self.causes if c.sigma is not None]
        return min(known) if known else None

    @property
    def kind_right(self) -> bool | None:
        """Sensor against physics, where all causes are of one kind and something was named."""
        wanted = {cause.kind for cause in self.causes}
        if wanted not in ({"sensor"}, {"physics"}) or not self.named:
            return None
        return set(self.kinds) == wanted


def score_case(line: Mapping[str, Any], truth: Truth, floor: Mapping[str, float] | None = None
               ) -> CaseScore:
    """Judge one line of results; ``floor``: mean square left on nulls by channel, if known."""
    answer = line["answer"]
    effects, aliases = answer["effects"], answer["alias_sets"]
    # A hand-wheel offset is fitted as a number of the truck, yet it is an instrument's fault.
    kinds = ["sensor" if e["kind"] == "parameter" else e["kind"] for e in effects]
    alone = len(truth.causes) == 1
    causes = [score_cause(cause, effects[:1] if alone else effects,
                          aliases[:1] if alone else aliases) for cause in truth.causes]
    return CaseScore(
        case=line["case"], group=truth.group, verdict=answer["verdict"],
        right=answer["verdict"] in truth.verdicts, named=tuple(e["name"] for e in effects),
        aliases=tuple(map(tuple, aliases)), kinds=tuple(kinds), causes=tuple(causes),
        wheel_channels="hub_speed" not in truth.missing, p_value=answer["null_p_value"],
        holdout=fitted(answer["fit"]["holdout"], floor), baselines=line["baselines"] or {},
        cpu_s=float(line["cpu_s"]))


def no_answer(case: str, truth: Truth) -> CaseScore:
    """A case whose diagnosis ended in an error: nothing named, and not found free of faults."""
    return CaseScore(
        case=case, group=truth.group, verdict=ERROR, right=False, named=(), aliases=(), kinds=(),
        causes=tuple(score_cause(cause, (), ()) for cause in truth.causes),
        wheel_channels="hub_speed" not in truth.missing, p_value=None, holdout=None, baselines={},
        cpu_s=0.0)


def score_cause(cause: Cause, effects: Sequence[Mapping[str, Any]],
                aliases: Sequence[Sequence[str]]) -> CauseScore:
    """Look for a cause among effects and their alias sets."""
    exact = next((e for e in effects if e["name"] == cause.name), None)
    holding = next((k for k, names in enumerate(aliases) if cause.name in names), None)
    chosen = exact or (effects[holding] if holding is not None else None)
    place = exact["where"] if exact else {}
    return CauseScore(
        name=cause.name, kind=cause.kind, sigma=cause.sigma, raw=exact is not None,
        aliased=exact is not None or holding is not None,
        alias_size=len(aliases[holding]) if holding is not None else None,
        body=_same(cause.where["body"], place.get("body")),
        axle=_same_axle(cause.where["axle"], place.get("axle")),
        onset_error_s=_onset_error(cause, chosen), onset_covered=_onset_covered(cause, chosen),
        parameter=compare_parameter(cause, exact) if exact else None)


def _same(wanted: str | None, found: str | None) -> bool | None:
    return None if wanted is None or found is None else wanted == found


def _same_axle(wanted: str | None, found: str | None) -> bool | None:
    """A group (`drive`) and one of its axles (`drive_1`) agree; two axles of one group do not."""
    if wanted is None or found is None:
        return None
    return (wanted == found or wanted.startswith(f"{found}_") or found.startswith(f"{wanted}_"))


def _true_onset(cause: Cause) -> float | None:
    """The earliest one among the training runs."""
    return min((t for run, t in cause.onset_s.items() if run.startswith("train")), default=None)


def _onset_error(cause: Cause, effect: Mapping[str, Any] | None) -> float | None:
    """Distance of the stated onset from the true one."""
    true = _true_onset(cause)
    if effect is None or effect["onset_s"] is None or true is None:
        return None
    return abs(float(effect["onset_s"]) - true)


def _onset_covered(cause: Cause, effect: Mapping[str, Any] | None) -> bool | None:
    """Whether the stated 90 % interval of the onset holds the true one; None if it is open."""
    true, interval = _true_onset(cause), effect and effect.get("onset_ci90_s")
    if not interval or true is None or None in interval:
        return None
    return bool(interval[0] <= true <= interval[1])


def fitted(fit: Mapping[str, Mapping[str, float]], floor: Mapping[str, float] | None
           ) -> Fitted | None:
    """Mean squares of a fit over the channels that both have; None without holdout."""
    names = [n for n in fit["before"] if n in fit["after"] and not n.endswith(_SUMS)]
    if not names:
        return None
    left = [floor[n] for n in names if floor and n in floor]
    return Fitted(sum(fit["before"][n] ** 2 for n in names) / len(names),
                  sum(fit["after"][n] ** 2 for n in names) / len(names),
                  sum(left) / len(left) if len(left) == len(names) else None)
