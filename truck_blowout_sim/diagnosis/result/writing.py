"""The form of ``diagnosis.json``; its keys are a promise to users.

    {"verdict", "effects": [{"name", "kind", "where", "onset_s", "onset_ci90_s", "parameters",
    "equation", "sentence"}], "alias_sets", "location": {"channels", "interval_s", "body",
    "line_of_action_x_m", "line_of_action_ci90_m", "wrench"}, "fit", "null_p_value", "next_test",
    "summary": {"wrong", "sure", "changed"}, "pulled": [{"name", "value", "unit", "ci90",
    "prior_sigmas"}], "would_show": [{"name", "where", "parameter", "unit", "below", "above"}]}; an
    effect of an instrument has "instrument" and "channels" beside these.

Null stands where something does not apply, was not asked, or is left open by the data.

Validated with: test/report/test_result_json.py.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict
from typing import TYPE_CHECKING

from truck_blowout_sim.comparison.plain_json import finite_or_none
from truck_blowout_sim.diagnosis.algebra.quantiles import NINETY
from truck_blowout_sim.diagnosis.result.evidence import FAR, Calibrated
from truck_blowout_sim.diagnosis.result.parts import Effect, Fit, Interval, Location, Parameter

if TYPE_CHECKING:
    from truck_blowout_sim.diagnosis.result import Diagnosis

Object = dict[str, object]


def encode_diagnosis(diagnosis: Diagnosis) -> Object:
    """The public answer as plain objects in the order of the file."""
    from truck_blowout_sim.diagnosis.result.summary import summarize

    return {
        "verdict": diagnosis.verdict,
        "effects": [_effect(effect) for effect in diagnosis.effects],
        "alias_sets": [list(aliases.names) for aliases in diagnosis.alias_sets],
        "location": _location(diagnosis.location),
        "fit": {"train": _fit(diagnosis.train), "holdout": _fit(diagnosis.holdout)},
        "null_p_value": diagnosis.null_p_value,
        "next_test": diagnosis.next_test,
        "summary": asdict(summarize(diagnosis)),
        "pulled": [_number(n) for n in diagnosis.evidence.calibrated if abs(n.pull) > FAR],
        "would_show": [asdict(one) for one in diagnosis.evidence.would_show],
    }


def _number(number: Calibrated) -> Object:
    """A number of the sheet that the recordings pull far from it."""
    half = NINETY * number.sigma
    return {"name": number.name, "value": number.value, "unit": number.unit,
            "ci90": [number.value - half, number.value + half], "prior_sigmas": number.pull}


def _effect(effect: Effect) -> Object:
    where = effect.where
    return {
        "name": effect.name,
        "kind": effect.kind,
        "where": {"body": where.body, "axle": where.axle, "hub": where.hub, "tire": where.tire},
        "onset_s": effect.onset_s,
        "onset_ci90_s": _interval(effect.onset_ci90_s),
        "parameters": {name: _parameter(p) for name, p in effect.parameters.items()},
        "equation": effect.equation,
        "sentence": effect.sentence,
        **({"instrument": effect.instrument, "channels": list(effect.channels)}
           if effect.kind == "sensor" else {}),
    }


def _parameter(parameter: Parameter) -> Object:
    return {
        "value": parameter.value,
        "unit": parameter.unit,
        "ci90": _interval(parameter.ci90),
    }


def _location(location: Location) -> Object:
    wrench = location.wrench
    return {
        "channels": [{"name": c.name, "sigma": c.sigma} for c in location.channels],
        "interval_s": _interval(location.interval_s),
        "body": location.body,
        "line_of_action_x_m": location.line_of_action_x_m,
        "line_of_action_ci90_m": _interval(location.line_of_action_ci90_m),
        "wrench": {
            "fx_n": wrench.fx_n if wrench else None,
            "fy_n": wrench.fy_n if wrench else None,
            "mz_nm": wrench.mz_nm if wrench else None,
        },
    }


def _fit(fit: Fit) -> Object:
    return {"before": _sorted(fit.before), "after": _sorted(fit.after)}


def _sorted(rms_sigma: Mapping[str, float]) -> Object:
    return {name: rms_sigma[name] for name in sorted(rms_sigma)}


def _interval(interval: Interval | None) -> list[float | None] | None:
    return None if interval is None else [finite_or_none(bound) for bound in interval]
