"""Three sentences for somebody who reads no further: what is wrong, how sure, what got better.

Made from the answer alone, so that terminal, page and file say the same.

Validated with: test/report/test_summary.py.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from truck_blowout_sim.diagnosis.result.diagnosis import Diagnosis
from truck_blowout_sim.diagnosis.result.parts import Effect, Fit, Parameter

Label = Callable[[str], str]
# An error that changes by less than either is not worth a reader's time; judgement.
_NOISES, _SHARE = 0.5, 0.05  # of the channel's noise, of the error before
_MOST = 3
_COMMON = 0.1  # a chance that no one would act on
_REFUSED = {"holdout": "unseen runs are predicted worse with it",
            "bound": "its amount ran to the end of what was searched"}
_SHOWN = {"rad/s": (180.0 / math.pi, " deg/s"), "rad": (180.0 / math.pi, " deg"),
          "s": (1.0, " s"), "m": (1.0, " m"), "1": (1.0, "")}  # fmt: skip
_SHARES = ("scale_error", "roll_leak")
_ENDS = ("_mps2", "_mps", "_radps", "_rad", "_pa", "_m", "_m2", "_n", "_nm", "_s", "_prad2")


@dataclass(frozen=True)
class Summary:
    """The answer in three sentences."""

    wrong: str
    sure: str
    changed: str


def summarize(diagnosis: Diagnosis, label: Label | None = None) -> Summary:
    """The three sentences.

    Args:
        diagnosis: the answer.
        label: words for a channel; from its name by default.
    """
    named = label or plain
    return Summary(diagnosis.sentence, _sure(diagnosis), _changed(diagnosis, named))


def plain(name: str) -> str:
    """A channel's or a parameter's name in words, without its unit."""
    end = next((e for e in _ENDS if name.endswith(e)), "")
    return name.removesuffix(end).replace("_", " ")


def amount_text(name: str, parameter: Parameter) -> str:
    """A parameter with its 90 % interval, in units that a person reads."""
    factor, _ = _read_in(name, parameter.unit)
    low, high = (_number(factor * end) for end in parameter.ci90)
    text = size_text(name, parameter.value, parameter.unit)
    if not any(math.isfinite(end) for end in parameter.ci90):
        return f"{text} (no bounds)"
    if not math.isfinite(parameter.ci90[0]):
        return f"{text} (90 %: up to {high})"
    if not math.isfinite(parameter.ci90[1]):
        return f"{text} (90 %: from {low})"
    return f"{text} (90 %: {low} to {high})"


def size_text(name: str, value: float, unit: str) -> str:
    """A parameter's value in units that a person reads."""
    factor, words = _read_in(name, unit)
    return f"{_number(factor * value)}{words}"


def _read_in(name: str, unit: str) -> tuple[float, str]:
    """Factor and words of the unit in which a person reads a parameter."""
    return (100.0, " %") if name in _SHARES else _SHOWN.get(unit, (1.0, f" {unit}"))


def label_of(effect: Effect, effects: Sequence[Effect]) -> str:
    """Name and place; where several are alike in both, the instant or the instrument too."""
    same = [e for e in effects if e.name == effect.name]
    text = f"{effect.name} {effect.where}".strip()
    if len(same) > 1 and effect.instrument:
        return f"{text} ({effect.instrument})"
    if len(same) > 1 and effect.onset_s is not None:
        return f"{text} (from {effect.onset_s:.2f} s)"
    if len(same) > 1 and sum(str(e.where) == str(effect.where) for e in same) > 1:
        return f"{text} ({next(iter(effect.parameters), same.index(effect) + 1)})"
    return text


def _sure(diagnosis: Diagnosis) -> str:
    said = [_chance(diagnosis)]
    for effect, aliases in zip(diagnosis.effects, diagnosis.alias_sets, strict=True):
        what = label_of(effect, diagnosis.effects)
        if effect.parameters:
            name, first = next(iter(effect.parameters.items()))
            said.append(f"{what}: {plain(name)} {amount_text(name, first)}")
        others = [n for n in aliases.names[1:] if n != effect.name]
        if others:
            said.append(f"these recordings cannot tell {what} from {_listed(others, ' or ')}")
    text = "; ".join(one for one in said if one)
    return f"{text[:1].upper()}{text[1:]}." if text else "No evidence was computed."


def _chance(diagnosis: Diagnosis) -> str:
    findings = diagnosis.evidence.findings
    if diagnosis.verdict == "sensor_artefact" and findings:
        worst = max(finding.p_value for finding in findings)
        return f"sound instruments contradict each other as much in {_one_in(worst)} cases"
    p_value = diagnosis.null_p_value
    if p_value is None:
        return ""
    said = f"a vehicle with nothing missing gives as strong evidence in {_one_in(p_value)} cases"
    if p_value >= _COMMON:
        return f"{said}, so nothing can be claimed"
    return said + _refused(diagnosis)


def _refused(diagnosis: Diagnosis) -> str:
    """Where nothing is named: what stood out in training, and why it is not named."""
    refused = [c for c in diagnosis.evidence.candidates
               if c.rule in _REFUSED and c.p_value is not None and c.p_value < _COMMON]
    if diagnosis.effects or diagnosis.verdict == "unknown" or not refused:
        return ""
    first = min(refused, key=lambda c: c.p_value or 0.0)
    what = f"{first.name} {first.where}".strip()
    return f": {what} stands out in training, but {_REFUSED[first.rule]}, so it is not named"


def _one_in(p_value: float) -> str:
    """A probability as a person reads it."""
    if p_value >= _COMMON:
        return f"{p_value:.0%} of such"
    return "fewer than 1 of 10,000" if p_value < 1e-4 else f"1 of {1.0 / p_value:,.0f}"


def _changed(diagnosis: Diagnosis, label: Label) -> str:
    unseen = bool(diagnosis.holdout.before)
    fit = diagnosis.holdout if unseen else diagnosis.train
    if not fit.before:
        return "No prediction was made."
    where = ("On unseen runs" if unseen else
             "No unseen run was given (--holdout); on the fitted runs")  # fmt: skip
    better, worse = _moved(fit, better=True), _moved(fit, better=False)
    if not better and not worse:
        return (f"{where} no channel's error changed by more than both "
                f"{_NOISES:.0%} of its noise and {_SHARE:.0%} of itself.")
    return (f"{where} the error, in units of each channel's noise, fell for "
            f"{_spelled(better, fit, label)}; it rose for {_spelled(worse, fit, label)}.")


def _moved(fit: Fit, *, better: bool) -> list[str]:
    """Channels whose error fell (or rose) by more than both limits, the largest change first."""
    sign = 1.0 if better else -1.0
    change = {name: sign * (before - fit.after[name])
              for name, before in fit.before.items() if name in fit.after}  # fmt: skip
    notable = [name for name, size in change.items()
               if size > max(_NOISES, _SHARE * fit.before[name])]  # fmt: skip
    return sorted(notable, key=lambda name: -change[name])


def _spelled(names: Sequence[str], fit: Fit, label: Label) -> str:
    parts = [f"{label(name)} ({_number(fit.before[name])} to {_number(fit.after[name])})"
             for name in names[:_MOST]]  # fmt: skip
    more = len(names) - _MOST
    others = [f"{more} more channel{'s' if more > 1 else ''}"] if more > 0 else []
    return _listed([*parts, *others], " and ") or "no channel"


def _listed(words: Sequence[str], last: str) -> str:
    return last.join([", ".join(words[:-1]), words[-1]]) if len(words) > 1 else "".join(words)


def _number(value: float) -> str:
    text = f"{value:.3g}"
    return f"{value:,.0f}" if "e+" in text else text
