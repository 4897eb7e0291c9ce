"""A number of the spec sheet that is not known exactly, and what moving it does to a truck."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from truck_blowout_sim.vehicle import Packed

# by the end of a packed name
_UNITS = {"_rad": "rad", "_m": "m", "_n": "N", "_pa": "Pa", "_kg": "kg", "_s": "s",
          "_prad2": "1/rad^2"}
_PLACE = "world."  # packed names begin so
_LEAST_SCALE = 0.1  # a number of the sheet never shrinks below this share


def unit_of(name: str) -> str:
    """SI unit of a packed parameter by its name; empty: it is a pure number."""
    return next((unit for end, unit in _UNITS.items() if name.endswith(end)), "")


@dataclass(frozen=True)
class Nuisance:
    """A number of the spec sheet that strays from truck to truck.

    Attributes:
        name: of the number; ``scale`` or ``add`` says how the amount enters.
        sigma: 1 sigma of the amount; ``step`` its finite difference.
        targets: packed names with the factor (+1 or -1) of the amount.
        only: kind of run that shows it, or empty.
        source: who says what sigma is.
    """

    name: str
    kind: str
    sigma: float
    step: float
    targets: tuple[tuple[str, float], ...]
    only: str = ""
    source: str = ""

    @property
    def unit(self) -> str:
        """SI unit of the amount; ``1`` of a share, and of a pure number."""
        if self.kind == "scale":
            return "1"
        return unit_of(self.targets[0][0]) or "1"

    @property
    def of_the_place(self) -> bool:
        """Whether it belongs to the road of a test and not to the vehicle."""
        return all(name.startswith(_PLACE) for name, _ in self.targets)

    def between(self, here: float, there: float) -> float:
        """Amount that takes a truck from one number of prior sigmas to another."""
        if self.kind == "scale":
            return (1.0 + there * self.sigma) / self._scale(here) - 1.0
        return (there - here) * self.sigma

    def moved(self, here: float) -> float:
        """Amount by which ``step`` moves a truck that is at a number of prior sigmas."""
        return self.step * (self._scale(here) if self.kind == "scale" else 1.0)

    def _scale(self, here: float) -> float:
        return max(1.0 + here * self.sigma, _LEAST_SCALE)

    def values(self, packed: Packed, amount: float) -> Mapping[str, float]:
        """Packed parameters at an amount, starting from ``packed``, none beyond its bounds."""
        if self.kind == "scale":
            scale = {n: max(1.0 + sign * amount, _LEAST_SCALE) for n, sign in self.targets}
            return packed.within({n: packed[n] * by for n, by in scale.items()})
        return packed.within({n: packed[n] + sign * amount for n, sign in self.targets})
