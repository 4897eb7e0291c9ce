"""From a case's description to its recordings and its answer."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from proving_ground import forms
from proving_ground.calibrate import LOWEST, Calibrated, from_guess, search
from proving_ground.cases import CaseSpec, EffectSpec, FaultSpec
from proving_ground.channels import columns, ideal
from proving_ground.detect import INSTRUMENT_FLOORS, detectability
from proving_ground.effects import LISTED, Active
from proving_ground.effects.base import combine
from proving_ground.faults import FAULTS
from proving_ground.individual import draw
from proving_ground.instruments import Mounting, apply_fault, measure, without_gravity
from proving_ground.kept_back import KeptBack, sealed
from proving_ground.layout import FloatArray
from proving_ground.manoeuvres import make
from proving_ground.roughness import FEW, Roughness, roughen
from proving_ground.run import Rig, drive, replay
from proving_ground.seal import LIBRARY
from proving_ground.switches import NEVER_S
from proving_ground.task import Manoeuvre
from proving_ground.writer import HEADER, write_csv

Values = dict[str, FloatArray]
Run = Any                        # what a rig returns: the truck's `Truth` or the car's


def onset(manoeuvre: Manoeuvre, effect: EffectSpec, seed: int) -> float:
    """When an effect begins: the blowout, an instant in the run, or a place on the road (m)."""
    rng = np.random.default_rng([seed, 83])
    if not effect.kind.event:
        return min(manoeuvre.blowout_s, NEVER_S)
    start, span = 3.0, 3.0
    if manoeuvre.blowout_s < NEVER_S:
        start, span = manoeuvre.blowout_s + 0.6, 1.5
    if effect.name == "friction_change":
        start, span = 1.0, 0.8
    when = start + span * float(rng.random())
    if effect.name in ("friction_change", "road_grade", "road_bank"):
        return manoeuvre.speed_mps * (2.0 + when)
    return when


class CaseBuilder:
    """One case: its truck, its runs, its calibrated severities."""

    header: tuple[str, ...] = HEADER
    vehicle = ""                     # file of the model where it is not the shipped truck
    unsteady: tuple[str, ...] = ()   # channels that jitter by themselves

    def __init__(self, spec: CaseSpec) -> None:
        self.spec = spec
        self._make_rigs(spec)
        self.mounting = Mounting.draw(spec.seed, self._channels())
        self.runs = self._manoeuvres(spec)
        faulty = [channel for f in spec.faults for channel in FAULTS[f.name].make(
            1.0, f.place, f.sign).channels]
        self.rough = None if not spec.rough else Roughness.draw(
            spec.seed, all(channel in FEW for channel in faulty))
        self.kept = KeptBack() if spec.rough else KeptBack.of(spec.seed)
        self.level = any(fault.name == "lateral_accel_roll" for fault in spec.faults)

    def _make_rigs(self, spec: CaseSpec) -> None:
        """The truck, on its road and on an even one."""
        individual = draw(spec.seed) if spec.truth == "w1" else forms.draw(spec.seed)
        self.rig = Rig(individual)
        self._even = Rig(replace(individual, road_seed=0))

    def _channels(self) -> list[str]:
        return columns()

    def _manoeuvres(self, spec: CaseSpec) -> list[tuple[str, Manoeuvre, int]]:
        """Name, manoeuvre and seed of every run; which tire is blown is that of the effect."""
        side = ("steer_left", "steer_right")
        place = next((e.where.tire for e in spec.effects if e.where.tire in side), None)
        tires = (place or side[spec.seed % 2],)
        if any(e.name == "secondary_blowout" and e.where.tire == "steer_right"
               for e in spec.effects):
            tires = ("steer_left",)
        return [(name, make(kind, seed, tires), seed) for name, kind, seed in spec.runs()]

    def _drive(self, manoeuvre: Manoeuvre, actives: list[Active], seed: int,
               even: bool = False) -> Run:
        """A run with the closed-loop driver."""
        return drive(self._even if even else self.rig, manoeuvre, combine(actives), seed)

    def _replay(self, truth: Run, actives: list[Active], even: bool = True) -> Run:
        """The same commands with other effects at work, on an even road or the truck's own."""
        return replay(self._even if even else self.rig, truth, combine(actives))

    def _front_m(self, truth: Run) -> FloatArray:
        """Where the front axle is along the road."""
        return np.asarray(truth.samples[:, 0] + 2.42)

    def actives(self, severities: list[float], manoeuvre: Manoeuvre, seed: int) -> list[Active]:
        """What is at work in one run."""
        return [e.at(s, onset(manoeuvre, e, seed))
                for e, s in zip(self.spec.effects, severities, strict=True)]

    def clean(self, truth: Run) -> Values:
        """Ideal channels, with gravity taken out where this truck's instruments do so."""
        values = ideal(truth)
        return without_gravity(values) if self.level else values

    def _train(self) -> list[tuple[Manoeuvre, int, Run, Values]]:
        """The training runs of the case's own list with nothing missing, on an even road.

        Bumps met a little later would count as a difference that no one could use.
        """
        rows, own = [], {f"train_{k + 1}" for k in range(len(self.spec.train))}
        for name, manoeuvre, seed in self.runs:
            if name in own:
                truth = self._drive(manoeuvre, [], seed, even=True)
                rows.append((manoeuvre, seed, truth, self.clean(truth)))
        return rows

    def calibrate(self) -> tuple[list[Calibrated], list[Calibrated]]:
        """Severities of effects and faults for their wanted detectability, each on its own."""
        if not self.spec.effects and not self.spec.faults:
            return [], []
        train = self._train()

        def effect_power(effect: EffectSpec, severity: float) -> tuple[float, str]:
            pairs = []
            for manoeuvre, seed, truth, clean in train:
                active = effect.at(severity, onset(manoeuvre, effect, seed))
                other = self._replay(truth, [active])
                pairs.append((self.clean(other), clean))
            return detectability(pairs, (*self.spec.missing, *self.unsteady))

        def fault_power(fault: FaultSpec, severity: float) -> tuple[float, str]:
            made = FAULTS[fault.name].make(severity, fault.place, fault.sign)
            return detectability([(apply_fault(row[3], made), row[3]) for row in train],
                                 self.spec.missing, INSTRUMENT_FLOORS)

        found = [search(from_guess(e), partial(effect_power, e), e.kind.lowest)
                 for e in self.spec.effects]
        return found, [search(f, partial(fault_power, f), LOWEST) for f in self.spec.faults]

    def build(self, folder: Path) -> dict[str, Any]:
        """Write all recordings of the case into `folder` and return the answer."""
        found, faulty = self.calibrate()
        folder.mkdir(parents=True, exist_ok=True)
        library: dict[str, Any] = {"without": list(self.spec.without)} if self.spec.without else {}
        if self.vehicle:
            library["vehicle"] = self.vehicle
        if library:
            (folder / LIBRARY).write_text(json.dumps(library) + "\n", encoding="utf-8")
        onsets: list[dict[str, float]] = [{} for _ in found]
        strengths: list[dict[str, Any]] = [{} for _ in found]
        for name, manoeuvre, seed in self.runs:
            actives: list[Active] = []
            if not name.startswith("baseline"):
                actives = self.actives([c.severity for c in found], manoeuvre, seed)
            truth = self._drive(manoeuvre, actives, seed)
            values = self.clean(truth)
            if not name.startswith("baseline"):
                for spec, calibrated in zip(self.spec.faults, faulty, strict=True):
                    values = apply_fault(values, FAULTS[spec.name].make(
                        calibrated.severity, spec.place, spec.sign))
            for k, active in enumerate(actives):
                strengths[k] = asdict(active.strength)
                when = _onset_in(truth.time_s, self._front_m(truth), active)
                if when is not None:
                    onsets[k][name] = when
            self._write(folder / f"{name}.csv", f"{self.spec.id}/{name}", manoeuvre,
                        self._read(values, seed), seed)
        return self._answer(found, faulty, onsets, strengths)

    def _write(self, path: Path, name: str, manoeuvre: Manoeuvre, readings: Values,
               seed: int) -> None:
        """One recording, as its instruments and their logger left it."""
        time = None
        if self.rough is not None:
            time, readings = roughen(readings, self.rough, seed)
        write_csv(path, name, manoeuvre, readings, self.level, time, self.header,
                  stated=self.rough is None and not self.kept.instruments)

    def _read(self, values: Values, seed: int) -> Values:
        """Noisy readings without the missing channels, with gaps where the case has dropouts."""
        readings = self.kept.read(measure(values, self.mounting, seed), seed)
        if self.spec.missing:
            readings = {n: v for n, v in readings.items() if not n.startswith(self.spec.missing)}
        if self.spec.dropouts:
            rng = np.random.default_rng([seed, 89])
            unit = "tractor" if rng.random() < 0.5 else "trailer"
            start = int(rng.integers(100, max(101, len(next(iter(readings.values()))) - 150)))
            length = int(rng.integers(20, 80))
            for name in readings:
                if name.startswith(f"{unit}_") and name.endswith(("_x_m", "_y_m", "_mps")):
                    readings[name][start:start + length] = np.nan
        return readings

    def _world(self) -> dict[str, Any]:
        """What tells a case of a world from one of the tables."""
        if self.spec.truth == "w1" and not self.spec.rough and self.spec.id[:1] != "w":
            return {}
        rough = None if self.rough is None else asdict(self.rough)
        kept = KeptBack.of(self.spec.seed).as_dict() if sealed(self.spec.seed) else None
        return {"truth": self.spec.truth, "rough": rough, **({"kept_back": kept} if kept else {}),
                "laws": [effect.law for effect in self.spec.effects]}

    def _answer(self, found: list[Calibrated], faulty: list[Calibrated],
                onsets: list[dict[str, float]], strengths: list[dict[str, Any]]
                ) -> dict[str, Any]:
        effects: list[dict[str, Any]] = []
        for spec, c, when, strength in zip(self.spec.effects, found, onsets, strengths,
                                           strict=True):
            effects.append({
                "name": spec.name, "kind": _kind(spec.name, self.spec.without),
                "where": spec.where.as_dict(), "onset_s": when or None, "strength": strength,
                "sign": spec.sign, "wanted_sigma": spec.sigma, **asdict(c),
                **({} if spec.sigma_b is None else {"wanted_sigma_b": spec.sigma_b})})
        for fault, c in zip(self.spec.faults, faulty, strict=True):
            effects.append(_fault_answer(fault, c))
        verdicts = {"null": ["consistent", "miscalibrated"], "sensor": ["sensor_artefact"],
                    "unknown": ["unknown"]}
        return {"case": self.spec.id, "group": self.spec.group, "seed": self.spec.seed,
                "verdicts": verdicts.get(self.spec.group, ["missing_physics"]),
                "effects": effects, "runs": {name: m.kind for name, m, _ in self.runs},
                "blown": {name: list(m.blown) for name, m, _ in self.runs if m.blown},
                "missing_channels": list(self.spec.missing), "dropouts": self.spec.dropouts,
                **self._world()}


def _kind(name: str, without: tuple[str, ...]) -> str:
    """What an effect is to a diagnosis that must do without some names."""
    if name not in LISTED:
        return "unlisted"
    return "taken_out" if name in without else "physics"


def _fault_answer(spec: FaultSpec, found: Calibrated) -> dict[str, Any]:
    kind = FAULTS[spec.name]
    fault = kind.make(found.severity, spec.place, spec.sign)
    body = fault.channels[0].split("_", 1)[0]
    body = body if body in ("tractor", "trailer") else "tractor"
    return {"name": spec.name, "kind": "sensor", "channels": list(fault.channels),
            "where": {"body": body, "axle": None, "hub": None, "tire": None}, "onset_s": None,
            "strength": asdict(kind.strength(fault)), "sign": spec.sign,
            "wanted_sigma": spec.sigma, **asdict(found)}


def _onset_in(time_s: FloatArray, front_m: FloatArray, active: Active) -> float | None:
    """When an effect began on the recording's clock, or None where it is always there."""
    if active.onset_x_m is not None:
        past = np.nonzero(front_m >= active.onset_x_m)[0]
        return float(time_s[past[0]]) if past.size else None
    if active.onset_s is None or active.onset_s > time_s[-1]:
        return None
    return float(active.onset_s)


def save_answer(path: Path, answer: dict[str, Any]) -> None:
    """Write an answer with sorted keys, so that equal answers have equal bytes."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(json.dumps(answer, indent=1, sort_keys=True) + "\n", encoding="utf-8")


def strong(spec: CaseSpec, severity: float) -> CaseSpec:
    """The same case with every effect and fault at one severity, not calibrated."""
    return replace(
        spec,
        effects=tuple(replace(e, sigma=None, severity=severity) for e in spec.effects),
        faults=tuple(replace(f, sigma=None, severity=severity) for f in spec.faults))
