"""One car of its kind: the published numbers with a few per cent of personal deviation."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from proving_ground.car.foreign import Numbers, parameters, public_parameters
from proving_ground.layout import FloatArray

RATIO, DRAG_AREA_M2, POWER_W = 16.0, 0.65, 110.0e3
# What a sheet gets wrong by 10 per cent up to this: masses less, as they can be weighed.
WRONG = {"I_z": 0.25, "I_Phi_s": 0.3, "I_y_s": 0.3, "K_sf": 0.2, "K_sr": 0.2, "K_sdf": 0.3,
         "K_sdr": 0.3, "K_tsf": 0.3, "K_tsr": 0.3, "K_ras": 0.3, "p_ky1": 0.2, "p_kx1": 0.3,
         "drag": 0.3, "h_s": 0.12}


@dataclass(frozen=True)
class CarIndividual:
    """A car with its own deviations; `car` and `tire` are numbers of the foreign model."""

    car: dict[str, float]
    tire: dict[str, float]
    brake: FloatArray = field(default_factory=lambda: np.ones(4))
    zero_rad: float = 0.0
    drag_area_m2: float = DRAG_AREA_M2
    bumps_seed: int = 0

    def parameters(self, **tire: float) -> Numbers:
        """As the compiled model reads them; `tire`: factors on numbers of the tire."""
        changed = {name: value * tire.get(name, 1.0) for name, value in self.tire.items()}
        return parameters(self.car, changed)


def nominal() -> CarIndividual:
    """The published car."""
    car, tire = public_parameters()
    return CarIndividual(dict(car), dict(tire))


def draw(seed: int) -> CarIndividual:
    """A car within tolerances, every second one with up to three numbers of its sheet wrong."""
    rng = np.random.default_rng([seed, 113])
    base = nominal()
    car, tire = base.car, base.tire
    scale = 1.0 + float(rng.uniform(-0.02, 0.02))
    for name in ("m", "m_s", "m_uf", "m_ur"):
        car[name] *= scale
    shift = float(rng.uniform(-0.03, 0.03))
    car["a"], car["b"] = car["a"] + shift, car["b"] - shift
    for name in ("I_Phi_s", "I_y_s", "I_z", "K_sf", "K_sr", "K_sdf", "K_sdr", "K_tsf", "K_tsr",
                 "K_ras", "K_rad"):
        car[name] *= 1.0 + float(rng.uniform(-0.04, 0.04))
    for name in ("p_ky1", "p_kx1", "p_dy1", "p_dx1"):
        tire[name] *= 1.0 + float(rng.uniform(-0.04, 0.04))
    drag = DRAG_AREA_M2 * float(rng.uniform(0.95, 1.05))
    if rng.random() < 0.5:
        for name in rng.choice(sorted(WRONG), int(rng.integers(1, 4)), replace=False):
            error = float(rng.choice([-1.0, 1.0]) * rng.uniform(0.1, WRONG[str(name)]))
            if name == "drag":
                drag *= 1.0 + error
            else:
                (tire if str(name) in tire else car)[str(name)] *= 1.0 + error
    return CarIndividual(car, tire, 1.0 + rng.uniform(-0.04, 0.04, 4),
                         float(np.radians(rng.uniform(-0.05, 0.05))), drag, seed)
