"""The foreign model, compiled: its own functions and its own parameters, nothing rewritten."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Callable
from dataclasses import asdict
from functools import cache
from types import FunctionType, ModuleType
from typing import Any

import numba

NAMES = ("m", "m_s", "m_uf", "m_ur", "a", "b", "I_Phi_s", "I_y_s", "I_z", "I_xz_s", "K_sf", "K_sdf",
         "K_sr", "K_sdr", "T_f", "T_r", "K_ras", "K_tsf", "K_tsr", "K_rad", "K_zt", "h_cg", "h_raf",
         "h_rar", "h_s", "I_uf", "I_ur", "I_y_w", "K_lt", "R_w", "T_sb", "T_se", "D_f", "D_r",
         "E_f", "E_r")
LIMITS = ("min", "max", "v_min", "v_max")
ACCELERATION = ("a_max", "v_max", "v_min", "v_switch")


Numbers = Any      # parameters of the foreign model, as compiled code reads them
Compiled = Any     # a compiled function


@cache
def public_parameters() -> tuple[dict[str, float], dict[str, float]]:
    """Numbers of the car (BMW 320i, parameter set 2) and of its tires, as published."""
    from vehiclemodels.parameters_vehicle2 import parameters_vehicle2

    p = parameters_vehicle2()
    tire = {name: float(value) for name, value in asdict_of(p.tire).items()
            if name.startswith(("p_", "r_")) and value is not None}
    return {name: float(getattr(p, name)) for name in NAMES}, tire


def asdict_of(node: Numbers) -> dict[str, Any]:
    """A configuration node of that package as a mapping, whatever it is made of."""
    try:
        return dict(asdict(node))
    except TypeError:
        return dict(node.items())


# Classes are made once, so that all cars share what is compiled.
@cache
def _classes() -> tuple[Any, ...]:
    car, tire = public_parameters()
    make: Any = namedtuple           # the names are the package's, so no class can spell them
    tires, steering = make("Tire", list(tire)), make("SteeringLimits", LIMITS)
    longitudinal = make("Longitudinal", ACCELERATION)
    whole = make("Parameters", [*car, "tire", "steering", "longitudinal"])
    return tires, steering, longitudinal, whole


def parameters(car: dict[str, float], tire: dict[str, float]) -> Numbers:
    """Parameters as the compiled model reads them."""
    tires, steering, longitudinal, whole = _classes()
    # The gear's own limits: never at work here, the driver turns slower.
    return whole(**car, tire=tires(**tire), steering=steering(-1.066, 1.066, -3.0, 3.0),
                 longitudinal=longitudinal(11.5, 50.8, -13.9, 50.8))


def njit(function: Compiled) -> Compiled:
    """Compile one of our own functions that the foreign ones are mixed with."""
    return numba.njit(function)


def _compiled(function: Callable[..., Any], **names: Compiled) -> Compiled:
    """The function of the package with other functions in place of those that it calls."""
    inside = {**function.__globals__, **names}
    return numba.njit(FunctionType(function.__code__, inside, function.__name__))


@cache
def derivative() -> Compiled:
    """`vehicle_dynamics_mb` of the package, compiled: (state, (steering rate, acceleration), p)."""
    from vehiclemodels.utils import tire_model
    from vehiclemodels.utils.acceleration_constraints import acceleration_constraints
    from vehiclemodels.utils.steering_constraints import steering_constraints
    from vehiclemodels.utils.vehicle_dynamics_ks_cog import vehicle_dynamics_ks_cog
    from vehiclemodels.vehicle_dynamics_mb import vehicle_dynamics_mb

    limits = {"steering_constraints": _compiled(steering_constraints),
              "acceleration_constraints": _compiled(acceleration_constraints)}
    tires: Any = ModuleType("tires")
    sign = _compiled(tire_model.sign)
    for name in ("formula_longitudinal", "formula_lateral", "formula_longitudinal_comb",
                 "formula_lateral_comb"):
        setattr(tires, name, _compiled(getattr(tire_model, name), sign=sign))
    slow = _compiled(vehicle_dynamics_ks_cog, **limits)
    return _compiled(vehicle_dynamics_mb, vehicle_dynamics_ks_cog=slow, tireModel=tires, **limits)
