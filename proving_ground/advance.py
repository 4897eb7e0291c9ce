"""The compiled loop: our forces between MuJoCo's two half steps."""

from __future__ import annotations

import ctypes
from collections.abc import Callable
from functools import cache
from pathlib import Path

import mujoco
import numpy as np

from proving_ground.chassis import air, coupling, driveline, springs, steering
from proving_ground.circuits import brakes, chambers, gas, remember_commands
from proving_ground.compiled import compiled_here, compiled_whole
from proving_ground.contact import AMBIENT_PA, all_tires
from proving_ground.disturbances import gust, payload, slope, slope_share, unlisted
from proving_ground.layout import Commands, FloatArray, State, Truck, Views
from proving_ground.sheet import GRAVITY_MPS2
from proving_ground.switches import Switches

SENSOR_COUNT = 32
SAMPLE_COUNT = SENSOR_COUNT + 10 + 18 + 10 + 2 + 18 + 3


@compiled_whole
def apply_forces(v: Views, truck: Truck, state: State, sw: Switches, commands: Commands,
                 dt: float) -> None:
    """Fill MuJoCo's applied forces for the present instant and advance our own states."""
    for i in range(v.xfrc.shape[0]):
        for j in range(6):
            v.xfrc[i, j] = 0.0
    for i in range(v.qfrc.size):
        v.qfrc[i] = 0.0
    body = truck.units[0]
    speed = v.qvel[0] * v.xmat[body, 0] + v.qvel[1] * v.xmat[body, 3]
    slope(v, sw, GRAVITY_MPS2, v.qpos[0])
    remember_commands(state, commands)
    chambers(truck, state, sw, dt)
    gas(truck, state, sw, dt)
    all_tires(v, truck, state, sw, dt)
    springs(v, truck, state, sw)
    steering(v, truck, state, sw, commands, dt)
    coupling(v, truck, state, sw)
    brakes(v, truck, state, sw, dt)
    driveline(v, truck, state, sw, commands, speed, dt)
    air(v, truck, sw, speed)
    gust(v, truck, state, sw, speed)
    payload(v, truck, state, sw)
    unlisted(v, truck, state, sw, speed, dt)


@compiled_whole
def take_sample(v: Views, truck: Truck, state: State, sw: Switches, out: FloatArray) -> None:
    """Everything an instrument might see, at the present instant."""
    n = SENSOR_COUNT
    for i in range(n):
        out[i] = v.sensors[i]
    for hub in range(10):
        out[n + hub] = v.qvel[truck.wheel_dof[hub]]
        out[n + 28 + hub] = state.chamber[hub]
    for tire in range(18):
        out[n + 10 + tire] = state.pressure[tire] - AMBIENT_PA
        out[n + 40 + tire] = state.tire_fz[tire]
    ease = slope_share(v.qpos[0], sw)
    out[n + 38] = sw.grade * ease
    out[n + 39] = sw.bank * ease
    out[n + 58] = v.qpos[truck.kingpin_qpos[0]]
    out[n + 59] = v.qpos[truck.kingpin_qpos[1]]
    out[n + 60] = v.qpos[truck.hitch_qpos]


@cache
def _entry_points() -> tuple[Callable[..., None], Callable[..., None]]:
    """MuJoCo's two half steps as C functions that compiled code can call."""
    folder = Path(mujoco.__file__).parent
    library = ctypes.CDLL(str(next(folder.glob("libmujoco*"))))
    functions = []
    for name in ("mj_step1", "mj_step2"):
        function = getattr(library, name)
        function.argtypes = (ctypes.c_void_p, ctypes.c_void_p)
        function.restype = None
        functions.append(function)
    return functions[0], functions[1]


@cache
def compiled_loop() -> Callable[..., None]:
    """The loop over steps; compiled once a process because it holds library addresses."""
    first_half, second_half = _entry_points()

    @compiled_here
    def loop(model: int, data: int, v: Views, truck: Truck, state: State, sw: Switches,
             commands: Commands, steps: int, dt: float, out: FloatArray) -> None:
        for k in range(steps):
            first_half(model, data)
            apply_forces(v, truck, state, sw, commands, dt)
            second_half(model, data)
            if k == 0:
                take_sample(v, truck, state, sw, out)
            state.time[0] += dt

    return loop


def empty_sample() -> FloatArray:
    """Room for one sample."""
    return np.zeros(SAMPLE_COUNT)
