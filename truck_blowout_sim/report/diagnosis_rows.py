"""Rows of a diagnosis's tables as text."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence

from truck_blowout_sim.comparison.errors import shortened
from truck_blowout_sim.diagnosis.result import (
    AliasSet,
    Calibrated,
    Candidate,
    Effect,
    Interval,
    Location,
    Showing,
    amount_text,
    label_of,
    plain,
    size_text,
)
from truck_blowout_sim.diagnosis.result.evidence import FAR

Row = Mapping[str, object]
_ABSENT = "–"
_NOTABLE = 1.0  # prior sigmas: a number within it is where the sheet puts it
_MOST_CHANNELS = 5


def effect_row(effect: Effect, aliases: AliasSet, effects: Sequence[Effect]) -> Row:
    """An effect with its parameters, onset and look-alikes."""
    others = [
        f"{name} ({place})" if place else name
        for name, place in zip(aliases.names, aliases.places or [""] * len(aliases.names),
                               strict=True)
    ][1:]  # fmt: skip
    onset = effect.onset_s
    return {
        "title": label_of(effect, effects),
        "instrument": effect.instrument,
        "kind": effect.kind,
        "sentence": effect.sentence,
        "equation": effect.equation,
        "parameters": [(plain(name), amount_text(name, p))
                       for name, p in effect.parameters.items()],
        "onset": _onset(onset, effect.onset_ci90_s),
        "aliases": ", ".join(others),
        "splits": aliases.splits,
    }


def candidate_row(candidate: Candidate) -> Row:
    """A candidate with its evidence and what became of it."""
    outcome, style = ("not named", "muted")
    if candidate.accepted:
        outcome, style = ("named", "bad")
    elif candidate.aliased:
        outcome, style = ("fits as well", "")
    if candidate.reason:
        outcome += ":"
    p_value = candidate.p_value
    return {
        "name": candidate.name,
        "where": str(candidate.where) or _ABSENT,
        "gain": f"{candidate.delta_chi2:,.0f}",
        "p": "" if p_value is None else f"{p_value:.2g}",
        "amount": candidate.amount,
        "outcome": outcome,
        "style": style,
        "reason": candidate.reason,
    }


def showing_row(one: Showing) -> Row:
    """A cause with the smallest amounts that would have been named."""
    below, above = (_ABSENT if end is None else size_text(one.parameter, end, one.unit)
                    for end in (one.below, one.above))
    return {"name": one.name, "where": str(one.where) or _ABSENT, "number": plain(one.parameter),
            "below": below, "above": above}


def calibrated_row(number: Calibrated) -> Row:
    """A number of the spec sheet beside its estimate; relative ones in percent of the sheet."""
    factor, unit = (100.0, "%") if number.relative else (1.0, number.unit)
    return {
        "name": number.name,
        "prior": f"{shortened(factor * number.prior)} ± {shortened(factor * number.prior_sigma)}",
        "estimate": f"{_exact(factor * number.value)} ± {shortened(factor * number.sigma)}",
        "unit": unit,
        "far": abs(number.pull) > _NOTABLE,
        "pull": f"{number.pull:+.1f}",
        "style": "bad" if abs(number.pull) > FAR else "",
    }


def location_rows(location: Location, labels: Mapping[str, str]) -> list[tuple[str, str]]:
    """Where and when, line by line; only what is known."""
    rows = []
    if location.channels:
        worst = location.channels[:_MOST_CHANNELS]
        text = ", ".join(f"{labels.get(c.name, c.name)} ({c.sigma:.1f} σ)" for c in worst)
        rows.append(("Worst channels", text))
    if location.interval_s is not None:
        rows.append(("Interval", f"{interval_text(location.interval_s, _hundredths)} s"))
    if location.body:
        rows.append(("Body", location.body))
    if location.line_of_action_x_m is not None:
        bounds = interval_text(location.line_of_action_ci90_m, _placed)
        text = f"{_placed(location.line_of_action_x_m)} base_link; 90 % interval: {bounds} it"
        rows.append(("Line of action", text))
    if location.wrench is not None:
        wrench = location.wrench
        text = (
            f"{wrench.fx_n:+,.0f} N forward, {wrench.fy_n:+,.0f} N left, "
            f"{wrench.mz_nm:+,.0f} N m counter-clockwise (mean over the interval)"
        )
        rows.append(("Missing wrench", text))
    return rows


def interval_text(interval: Interval | None, form: Callable[[float], str]) -> str:
    """``0.31 to 0.39``; open bounds said in words."""
    if interval is None:
        return _ABSENT
    low, high = interval
    if not math.isfinite(low) and not math.isfinite(high):
        return "open on both sides"
    if not math.isfinite(low):
        return f"up to {form(high)}"
    if not math.isfinite(high):
        return f"from {form(low)}"
    return f"{form(low)} to {form(high)}"


def ranked(candidates: Sequence[Candidate]) -> list[Candidate]:
    """What was named first, then what fits as well, then the rest; each the strongest first."""
    return sorted(candidates, key=lambda c: (not c.accepted, not c.aliased, -c.delta_chi2))


def _onset(onset_s: float | None, interval: Interval | None) -> str:
    """Since when, with its interval if it has one."""
    if onset_s is None:
        return "always there"
    known = "" if interval is None else f" (90 %: {interval_text(interval, _hundredths)})"
    return f"{onset_s:.2f} s{known}"


def _hundredths(value: float) -> str:
    return f"{value:.2f}"


def _placed(x_m: float) -> str:
    return f"{abs(x_m):.2f} m {'ahead of' if x_m > 0 else 'behind'}"


def _exact(value: float) -> str:
    """Four significant digits."""
    text = f"{value:.4g}"
    return f"{value:.0f}" if "e+" in text else text
