"""The truck behind the node: model, time and inputs, in one place that knows nothing of ROS."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from truck_blowout_sim.nodes.clock import NS, StepClock
from truck_blowout_sim.nodes.inputs import InputBank
from truck_blowout_sim.physics.observe import output_names
from truck_blowout_sim.simulation import InitialState, Inputs, Truck
from truck_blowout_sim.simulation.flat import check_tires
from truck_blowout_sim.vehicle import Vehicle


class Plant:
    """A truck that is advanced by ticks, has its tires blown, and can begin again.

    Args:
        vehicle: a loaded vehicle.
        step_s: integration step.
        initial: where and how fast it begins.
        bank: its inputs.
    """

    def __init__(
        self, vehicle: Vehicle, step_s: float, initial: InitialState, bank: InputBank
    ) -> None:
        self.vehicle = vehicle
        self.bank = bank
        self.clock = StepClock(round(step_s * NS))
        self._step_s = step_s
        self._initial = initial
        check_tires(vehicle, initial.flat)
        self._truck: Truck | None = None
        self.output_names = output_names(vehicle.units, vehicle.hubs, vehicle.tires)
        self.began_ns = 0
        self.blown_ns = self._flat_ns()
        self.applied: tuple[float, ...] = bank.applied(0)

    def build(self) -> None:
        """Build the truck; where the model is not compiled yet, this takes 20 to 40 s of a core."""
        truck = Truck(self.vehicle, step_s=self._step_s, initial=self._initial)
        # every compiled function once: none is to be compiled while time runs
        truck.advance(Inputs(*self.bank.applied(0)))
        truck.output_vector()
        _ = truck.ending
        truck.reset()
        self._truck = truck

    @property
    def ready(self) -> bool:
        """Whether the truck is built."""
        return self._truck is not None

    @property
    def truck(self) -> Truck:
        """The truck; only once it is built."""
        if self._truck is None:
            raise RuntimeError("the truck is not built yet")
        return self._truck

    @property
    def elapsed_ns(self) -> int:
        """Simulated time since this run began: at the start or at the last reset."""
        return self.now_ns - self.began_ns

    @property
    def now_ns(self) -> int:
        """Simulated time in nanoseconds."""
        return self.clock.now_ns

    @property
    def parts(self) -> Mapping[str, tuple[str, ...]]:
        """What can be blown: each tire, and each hub that carries several, with its tires."""
        hubs = {hub: self.vehicle.tires_of_hub(hub) for hub in self.vehicle.hubs}
        return {**hubs, **{tire: (tire,) for tire in self.vehicle.tires}}

    def advance(self, steps: int) -> None:
        """Take steps with the inputs as they stand now."""
        self.applied = self.bank.applied(self.now_ns)
        self.truck.advance(Inputs(*self.applied), steps)
        self.clock.advance(steps)

    def blow(self, part: str) -> tuple[tuple[str, ...], str]:
        """Blow a tire or all tires of a hub, now.

        Returns:
            The tires that were still whole, and one sentence about what happened and when.
        """
        fresh = tuple(tire for tire in self.parts[part] if self.truck.blow(tire))
        known = [tire for tire in self.parts[part] if tire not in fresh]
        for tire in fresh:
            self.blown_ns[tire] = self.now_ns
        said = [f"{' and '.join(fresh)} blown at {self.now_ns / NS:.3f} s"] if fresh else []
        said += [f"{tire} was already blown at {self._blown_s(tire):.3f} s" for tire in known]
        return fresh, "; ".join(said) + " (simulation time)"

    def is_blown(self, part: str) -> bool:
        """Whether a tire, or every tire of a hub, is blown."""
        return all(tire in self.blown_ns for tire in self.parts[part])

    def reset(self, initial: InitialState, pause_steps: int) -> None:
        """Return to an initial state, all tires whole that do not begin flat; time goes on.

        Args:
            initial: where and how fast it begins again.
            pause_steps: time that passes meanwhile, so that no two states share a stamp.
        """
        now_ns = self.now_ns + pause_steps * self.clock.step_ns
        if initial == self._initial:
            self.truck.reset()
        else:
            self._truck = Truck(self.vehicle, step_s=self._step_s, initial=initial)
            self._initial = initial
        self.clock.move_to(now_ns)
        self.began_ns = now_ns
        self.blown_ns = self._flat_ns()
        self.bank.clear()
        self.applied = self.bank.applied(now_ns)

    def move_to(self, now_ns: int) -> None:
        """The same truck at another time; the run, and its last commands, are as old as before."""
        elapsed_ns = self.elapsed_ns
        self.bank.shift(now_ns - self.now_ns)
        self.clock.move_to(now_ns)
        self.began_ns = now_ns - elapsed_ns
        self.blown_ns |= self._flat_ns()

    def outputs(self) -> NDArray[np.float64]:
        """Output vector of the model, in the order of `truck.output_names`."""
        return self.truck.output_vector()

    def _flat_ns(self) -> dict[str, int]:
        """When the tires burst that are flat from the start of this run on."""
        return {tire: self.began_ns - round(since_s * NS) for tire, since_s in self._initial.flat}

    def _blown_s(self, tire: str) -> float:
        return self.blown_ns.get(tire, 0) / NS
