"""The steering ratio is not the sheet's, or bends with the angle."""

from __future__ import annotations

from truck_blowout_sim.diagnosis.effects.base import (
    Amount,
    Effect,
    added,
    scaled,
    steered_axle,
)

_SPLITS = "the path, or the yaw rate over speed, against the hand wheel below 5 m/s"

_HARDLY = 4.0  # the road wheels turn a fifth as far: what turns less is a broken linkage

EFFECT = Effect(
    name="steering_ratio",
    amount=Amount("ratio_factor", "1", step=0.05, low=-0.5, high=_HARDLY, material=0.06,
                  source="gear and arm lengths by catalogue: 3 % (1 sigma)",
                  report=lambda a: 1.0 + a, grid=(-0.15, 0.15, 1.0, 2.5)),
    places=steered_axle,
    values=lambda packed, place, a: scaled(packed, ("steering.ratio",), a),
    sentence="The hand wheel must turn {value} times as far as the sheet's ratio says for the same "
             "angle of the road wheels.",
    equation="delta = delta_hw / ({value} i)",
    splits=_SPLITS,
)

BENT = Effect(
    name="steering_ratio",
    amount=Amount("ratio_curve_prad2", "1/rad^2", step=0.3, low=-1.0, high=10.0, material=1.6,
                  source="pitman arm and drag link: 10 % at 20 deg of the road wheel (1 sigma)",
                  grid=(-0.5, 1.0, 4.0)),
    places=steered_axle,
    values=lambda packed, place, a: added(packed, "steering.ratio_curve_prad2", a),
    sentence="The steering ratio bends with the angle: the road wheels turn 1 + {value} delta^2 "
             "times as far as the sheet's ratio says (delta in rad).",
    equation="delta = u (1 + {value} u^2), u = delta_hw / i",
    splits=_SPLITS,
    variant=True,
)
