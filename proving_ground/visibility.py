"""sigma_b of every effect of a generated set of a world, into `sigma_b.json` beside the cases.

With it, how far each is from what fault-free vehicles differ by in the same number (`spreads.py`).
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from proving_ground.cases import CaseSpec, EffectSpec
from proving_ground.ensemble import HIGHEST_HZ, RATE_HZ, Course, Nulls
from proving_ground.layout import FloatArray
from proving_ground.reading_noise import Instruments
from proving_ground.representative import representative
from proving_ground.sigma_b import Detector, Stack
from proving_ground.spreads import individual
from proving_ground.worlds import FIRST_SEED, world_cases

RESULT = "sigma_b.json"
MOST = 1e9  # of what no sound vehicle has


def measure(out: Path, nulls: Path, trucks: int) -> Iterator[tuple[str, list[float]]]:
    """Measure what is not measured yet; yields case and sigma_b of each effect, keeps them all.

    Raises:
        ValueError: a case is of no world.
    """
    done = count_spreads(out)
    worlds: dict[str, Nulls] = {}
    for answer in sorted((out / "answers").glob("*.json")):
        told = json.loads(answer.read_text(encoding="utf-8"))
        spec = spec_of(answer.stem)
        if not spec.effects or "sigma_b" in done[answer.stem]:
            continue
        world = worlds.setdefault(world_of(spec), Nulls(world_of(spec), nulls, trucks))
        found = visibility(spec, [e["severity"] for e in told["effects"][:len(spec.effects)]],
                           world)
        done[answer.stem] |= {"sigma_b": found, "trucks": trucks}
        write_result(out, done)
        yield answer.stem, found


def count_spreads(out: Path) -> dict[str, Any]:
    """Each effect's strength in spreads of fault-free vehicles, beside the sigma_b known already.

    Raises:
        ValueError: a case is of no world.
    """
    path = out / RESULT
    done: dict[str, Any] = json.loads(path.read_text()) if path.is_file() else {}
    for answer in sorted((out / "answers").glob("*.json")):
        told, spec = json.loads(answer.read_text(encoding="utf-8")), spec_of(answer.stem)
        if spec.effects:
            counts = [individual(effect["strength"], spec.truth == "w3")
                      for effect in told["effects"][:len(spec.effects)]]
            done[answer.stem] = {**done.get(answer.stem, {}), "individual": [
                float(f"{min(count, MOST):.3g}") for count in counts]}
    write_result(out, done)
    return done


def write_result(out: Path, done: dict[str, Any]) -> None:
    """Keep what is known of every case."""
    (out / RESULT).write_text(json.dumps(done, indent=1) + "\n", encoding="utf-8")


def spec_of(name: str) -> CaseSpec:
    """The case of a world by its name.

    Raises:
        ValueError: the name is not that of a case of a world.
    """
    world, _, seed = name.partition("-")
    if world not in FIRST_SEED or not seed.isdigit():
        raise ValueError(f"case {name!r} is of no world")
    return world_cases(world, int(seed) - FIRST_SEED[world], 1)[0]


def world_of(spec: CaseSpec) -> str:
    """Whose fault-free vehicles a case is compared with.

    A detector does not know the form of W1's truth: for it, too, forms are drawn.
    """
    return "w3" if spec.truth == "w3" else "w2"


def visibility(spec: CaseSpec, severities: list[float], nulls: Nulls) -> list[float]:
    """sigma_b of each effect of a case."""
    seen = Seen(spec, nulls)
    return [float(f"{seen.sigma_b(effect, severity):.3g}")
            for effect, severity in zip(spec.effects, severities, strict=True)]


class Seen:
    """What a detector of a case's world sees of its effects, at any severity."""

    def __init__(self, spec: CaseSpec, nulls: Nulls) -> None:
        instruments = Instruments.of(spec)
        rows, roads, noise, shapes = [], [], [], []
        self._parts: list[tuple[list[int], Course | None, int]] = []
        for role, kinds in (("baseline", spec.baseline), ("train", spec.train)):
            for name in kinds:
                kind = representative(name, spec.truth == "w3")
                channels, values = nulls.spread(kind)
                use = [k for k, channel in enumerate(channels)
                       if not channel.startswith(spec.missing or ("-",))
                       and instruments.keeps(channel)]
                kept = values[:, use, :]
                count = kept.shape[2]
                duration_s = count / (2.0 * HIGHEST_HZ)
                level = np.abs(kept[:, :, 0]).mean(axis=0) / np.sqrt(duration_s * RATE_HZ)
                rows.append(kept.reshape(len(kept), -1))
                own = nulls.spread(kind, even=False)[1][:, use, :] - kept
                roads.append(own.reshape(len(kept), -1))
                noise.append(np.concatenate([
                    instruments.variance(channels[k], float(level[i]), count, duration_s)
                    for i, k in enumerate(use)]))
                shapes.append((len(use), count))
                course = nulls.course(spec, kind) if role == "train" else None
                self._parts.append((use, course, kept[0].size))
        even, shaken = (np.concatenate(one, axis=1).astype(float) for one in (rows, roads))
        self.detector = Detector(Stack(even, shaken, np.concatenate(noise), tuple(shapes)))

    def sigma_b(self, effect: EffectSpec, severity: float) -> float:
        """How visible one effect is."""
        return self.detector.separation(self.signature(effect, severity))

    def signature(self, effect: EffectSpec, severity: float) -> FloatArray:
        """What one effect changes in all runs, one behind the other."""
        return np.concatenate([
            np.zeros(size) if course is None else course.signature(effect, severity)[use].ravel()
            for use, course, size in self._parts])
