"""One explanation: an effect at a place, how strong, and since when in each run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from truck_blowout_sim.diagnosis.effects import Effect
from truck_blowout_sim.diagnosis.effects.roles import role_of
from truck_blowout_sim.diagnosis.result.parts import Place
from truck_blowout_sim.vehicle import Packed, Vehicle


@dataclass(frozen=True)
class Hypothesis:
    """An effect at a place, with an amount and, if timed, an interval for each run.

    Attributes:
        times: (start, end) by run name; runs that are not listed do not have the event.
        shape: the effect's ``form_numbers``, in sigmas; empty: all 0.
    """

    effect: Effect
    place: Place
    amount: float = 0.0
    times: Mapping[str, tuple[float, float]] = field(default_factory=dict)
    shape: tuple[float, ...] = ()

    @property
    def key(self) -> tuple[str, str]:
        """Name and place, for comparing."""
        return self.effect.name, str(self.place)

    @property
    def form(self) -> tuple[str, str, str]:
        """Name, place and law: two laws of one effect share their key."""
        return (*self.key, self.effect.equation)

    def meaning(self, vehicle: Vehicle) -> str:
        """Calibration number that means the same as this hypothesis' amount; empty if none."""
        axle = self.place.axle or ""
        role = role_of(vehicle, axle) if axle in vehicle.spec.axles else ""
        return self.effect.absorbs.format(hub=self.place.hub, role=role)

    def apply(self, packed: Packed, run: str, amount: float | None = None) -> Packed:
        """The truck with this hypothesis in force during ``run``."""
        size = self.amount if amount is None else amount
        values = dict(self.effect.values(packed, self.place, size))
        if self.effect.timed:
            if run not in self.times:
                return packed
            values |= self.effect.timed(packed, self.place, *self.times[run])
            values |= self.at(size).law_numbers(packed) if size != 0.0 else {}
        return packed.unchecked(values)

    def law_numbers(self, packed: Packed) -> dict[str, float]:
        """Parameters that were fitted with the amount, from where the effect has them."""
        moved, values = {}, self.effect.values(packed, self.place, self.amount)
        for number, sigmas in zip(self.effect.form_numbers, self.shape, strict=False):
            key = number.key.format(unit=self.place.body)
            here = values[key] if key in values else packed[key]
            moved[key] = here + sigmas * number.sigma(packed, self.place)
        return moved

    @property
    def whole_shape(self) -> tuple[float, ...]:
        """All numbers of the law, in sigmas, those that were never fitted too."""
        return self.shape or (0.0,) * len(self.effect.form_numbers)

    @property
    def shape_cost(self) -> float:
        """What the prior of the law's numbers adds to the sum of squares."""
        return sum(sigmas * sigmas for sigmas in self.shape)

    def at(self, amount: float) -> Hypothesis:
        """The same with another amount."""
        return replace(self, amount=amount)
