"""The class that an importing tool runs: one truck, stepped by its co-simulation master.

The builder copies this file into the FMU. Inputs are the five commands and one switch a tire;
outputs are those of the model, SI, pressures gauge, axes after ISO 8855.
"""

from __future__ import annotations

from pathlib import Path

from pythonfmu3 import Boolean, Float64, Fmi3Causality, Fmi3Slave, Fmi3Status, Fmi3Variability
from pythonfmu3.default_experiment import DefaultExperiment

from truck_blowout_sim import InitialState, Inputs, load_vehicle
from truck_blowout_sim import Truck as Model
from truck_blowout_sim.errors import InputError

_STEP_S = 0.001
_INPUTS = Inputs._fields


class Truck(Fmi3Slave):  # type: ignore[misc]
    """A truck of which any tire can be blown."""

    author = "truck_blowout_sim contributors"
    license = "Apache-2.0"
    description = "Tractor-semitrailer with tire blowouts, in three dimensions, 1 ms step"

    def __init__(self, **kwargs: object) -> None:
        super().__init__(**kwargs)
        note = Path(str(self.resources)) / "vehicle.txt"
        self.vehicle = load_vehicle(note.read_text(encoding="utf-8").strip())
        self.default_experiment = DefaultExperiment(start_time=0.0, stop_time=10.0, step_size=0.01)
        self.initial_speed_mps = 20.0
        self.commands = dict.fromkeys(_INPUTS, 0.0)
        self.switches = dict.fromkeys(self.vehicle.tires, False)
        self.start_s = 0.0
        self.model: Model | None = None
        self.ended = False
        self.results = dict.fromkeys(self._outputs(), 0.0)
        self._register()

    def _outputs(self) -> tuple[str, ...]:
        from truck_blowout_sim.physics.observe import output_names

        return output_names(self.vehicle.units, self.vehicle.hubs, self.vehicle.tires)

    def _register(self) -> None:
        self.register_variable(Float64(
            "time", causality=Fmi3Causality.independent, variability=Fmi3Variability.continuous,
            getter=lambda: self.model.time_s if self.model else self.start_s))
        self.register_variable(Float64(
            "initial_speed_mps", causality=Fmi3Causality.parameter,
            variability=Fmi3Variability.tunable))
        for name in _INPUTS:
            self.register_variable(Float64(
                name, causality=Fmi3Causality.input, getter=lambda n=name: self.commands[n],
                setter=lambda value, n=name: self.commands.__setitem__(n, value)))
        for tire in self.vehicle.tires:
            self.register_variable(Boolean(
                f"blow_{tire}", causality=Fmi3Causality.input,
                getter=lambda t=tire: self.switches[t],
                setter=lambda value, t=tire: self.switches.__setitem__(t, value)))
        for name in self.results:
            self.register_variable(Float64(
                name, causality=Fmi3Causality.output, getter=lambda n=name: self.results[n]))

    def setup_experiment(self, start_time: float) -> None:
        """Clock at the start."""
        self.start_s = start_time

    def exit_initialization_mode(self) -> None:
        """Settle the truck at its speed with the inputs as they are."""
        initial = InitialState(speed_mps=self.initial_speed_mps, time_s=self.start_s,
                               inputs=Inputs(**self.commands))
        self.ended = False
        self.model = Model(self.vehicle, step_s=_STEP_S, initial=initial)
        self._look()

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Advance whole milliseconds with the inputs held; False where the truck cannot go on."""
        assert self.model is not None  # initialization comes first
        n = round(step_size / _STEP_S)
        if n < 1 or abs(n * _STEP_S - step_size) > 1e-9:
            self.log(f"step of {step_size} s is no whole number of milliseconds")
            return False
        for tire, blown in self.switches.items():
            if blown:
                self.model.blow(tire)
        try:
            self.model.advance(Inputs(**self.commands), n)
        except InputError as error:
            self.log(str(error))
            return False
        self._look()
        return self._goes_on(self.model)

    def _goes_on(self, model: Model) -> bool:
        """Whether there is a next step; why not is said once."""
        ending = model.ending
        if ending and not self.ended:
            self.log(f"{ending.words} at {ending.time_s:.3f} s", Fmi3Status.discard)
        self.ended = ending is not None
        return not self.ended

    def _look(self) -> None:
        assert self.model is not None
        self.results = self.model.outputs()
