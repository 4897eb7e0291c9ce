"""Air: brake chambers behind their control pressure, and gas leaving a tire through a hole."""

from __future__ import annotations

import math

from proving_ground.compiled import compiled
from proving_ground.contact import AMBIENT_PA
from proving_ground.layout import DELAY_STEPS, Commands, State, Truck, Views
from proving_ground.sheet import PSI_PA
from proving_ground.switches import Switches

GAS_SPEED_MPS = 293.5        # sqrt(R T) of air at 300 K
TIRE_VOLUME_M3 = 0.106


@compiled
def remember_commands(state: State, commands: Commands) -> None:
    """Write the control pressures into the delay line."""
    at = (state.ring_at[0] + 1) % DELAY_STEPS
    state.ring_at[0] = at
    state.ring[0, at] = commands.steer_pa
    state.ring[1, at] = commands.drive_pa
    state.ring[2, at] = commands.trailer_pa


@compiled
def chambers(truck: Truck, state: State, sw: Switches, dt: float) -> None:
    """Chamber pressures: delay, first-order lag; a slow group has a second-order line before."""
    for hub in range(10):
        group = min((hub // 2 + 1) // 2, 2)
        back = min(DELAY_STEPS - 1, int((truck.brake_delay_s + sw.slow_delay[group]) / dt + 0.5))
        control = state.ring[group, (state.ring_at[0] - back) % DELAY_STEPS]
        natural = sw.slow_group[group]
        if natural > 0.0:
            pull = natural * (natural * (control - state.line[hub]) - 1.8 * state.line_rate[hub])
            state.line_rate[hub] += dt * pull
            state.line[hub] += dt * state.line_rate[hub]
            control = state.line[hub]
        state.chamber[hub] += dt * (control - state.chamber[hub]) / truck.brake_lag_s


@compiled
def brakes(v: Views, truck: Truck, state: State, sw: Switches, dt: float) -> None:
    """Brake torque on each wheel and the heat that it leaves."""
    for hub in range(10):
        group = min((hub // 2 + 1) // 2, 2)
        spin = v.qvel[truck.wheel_dof[hub]]
        psi = (state.chamber[hub] - truck.push_out_pa - sw.brake_hold[hub]) / PSI_PA
        torque = 0.0
        if psi > 0.0:
            torque = psi * (truck.laws.brake_linear - truck.laws.brake_drop * psi)
            torque = torque * truck.brake[hub] * sw.brake_gain[hub]
            torque *= 1.0 - sw.fade[group] * (1.0 - math.exp(-state.heat[hub] / sw.fade_k))
            v.qfrc[truck.wheel_dof[hub]] -= torque * math.tanh(spin / 0.5)
        state.heat[hub] += dt * (torque * abs(spin) / 16.0e3 - state.heat[hub] / 60.0)


@compiled
def gas(truck: Truck, state: State, sw: Switches, dt: float) -> None:
    """Polytropic outflow through each hole, choked above twice the ambient pressure."""
    now = state.time[0]
    if sw.second_tire >= 0 and now >= sw.second_time_s and state.hole[sw.second_tire] == 0.0:
        state.hole[sw.second_tire] = sw.second_hole_m2
        state.blown_at[sw.second_tire] = now
    for tire in range(18):
        area = state.hole[tire]
        if area <= 0.0:
            continue
        if tire != sw.second_tire:
            area *= sw.hole_scale
            growth_s = sw.hole_growth_s + truck.laws.hole_growth_s
            if growth_s > 0.0:
                area *= 0.3 + 0.7 * min(1.0, (now - state.blown_at[tire]) / growth_s)
        ratio = AMBIENT_PA / state.pressure[tire]
        if ratio >= 0.999:
            state.pressure[tire] = AMBIENT_PA
            continue
        flow = 0.6847
        if ratio > 0.5283:
            flow = math.sqrt(7.0 * (ratio ** (2.0 / 1.4) - ratio ** (2.4 / 1.4)))
        state.pressure[tire] -= dt * truck.laws.polytropic * state.pressure[tire] * (
            area * GAS_SPEED_MPS / TIRE_VOLUME_M3 * flow)
