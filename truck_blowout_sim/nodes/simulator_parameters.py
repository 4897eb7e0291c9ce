"""The parameters of the simulator node, and what follows from them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.nodes.inputs import Input
from truck_blowout_sim.nodes.outputs import GROUPS
from truck_blowout_sim.nodes.parameters import Spec
from truck_blowout_sim.recordings import Blowout
from truck_blowout_sim.recordings.blowout_words import parse_blowouts
from truck_blowout_sim.recordings.channels import by_name, channels_for
from truck_blowout_sim.recordings.checks import STAMPS_END_S
from truck_blowout_sim.simulation import InitialState
from truck_blowout_sim.simulation.flat import Flat, flat_at
from truck_blowout_sim.simulation.plausible import MOST_BRAKE_PA

DEFAULT_VEHICLE = "international_9400i_trailmobile"

# by name: topic, unit, and what it may be at least and at most
# Released: nobody at the wheel, foot off the pedals. A trailer whose line is cut would brake by its
# springs; who wants that sets the safe value of its circuit.
_COMMANDS = {
    "steering_wheel_angle_rad": ("steering_wheel_angle", "rad", -20.0, 20.0),
    "throttle": ("throttle", "", 0.0, 1.0),
    "brake_pressure_steer_pa": ("brake_pressure/steer", "Pa", 0.0, 0.0),
    "brake_pressure_drive_pa": ("brake_pressure/drive", "Pa", 0.0, 0.0),
    "brake_pressure_trailer_pa": ("brake_pressure/trailer", "Pa", 0.0, 0.0),
}
_ROWS = by_name(channels_for())
# What is taken as control pressure where `max` is left at 0.
_MOST_PA = {"air": 1.0e6, "hydraulic": MOST_BRAKE_PA["hydraulic"]}

_GENERAL = (
    Spec("vehicle", DEFAULT_VEHICLE, "Name of a shipped vehicle, or path of a vehicle file."),
    Spec("initial_speed_mps", 0.0, "Speed at the start and after `reset`.", "m/s", 0, 60, True),
    Spec("initial_lateral_speed_mps", 0.0, "Same, to the left.", "m/s", -20, 20, True),
    Spec("initial_yaw_rate_radps", 0.0, "Yaw rate at the start and after `reset`.", "rad/s",
         -2, 2, True),
    Spec("initial_x_m", 0.0, "Position of `tractor/base_link` in `map` then.", "m",
         -1e6, 1e6, True),
    Spec("initial_y_m", 0.0, "Same, to the left.", "m", -1e6, 1e6, True),
    Spec("initial_yaw_rad", 0.0, "Heading then, counter-clockwise from x.", "rad", -7, 7, True),
    Spec("initial_articulation_rad", 0.0, "Trailer yaw minus tractor yaw then.", "rad", -1.5, 1.5,
         True),
    Spec("initial_flat", "", "Tires flat then, and seconds since they burst: `TIRE@SECONDS`.",
         live=True),
    Spec("step_s", 0.001, "Integration step.", "s", 1e-5, 0.005),
    Spec("publish_rate_hz", 100.0, "Outputs per simulated second.", "Hz", 1, 1000),
    Spec("clock_rate_hz", 100.0, "`/clock` messages per simulated second.", "Hz", 1, 1000),
    Spec("real_time_factor", 1.0, "Simulated seconds per second of wall time; 0: as fast as it"
         " can.", "", 0, 1000, True),
    Spec("start_paused", False, "Wait for `resume` or `step`."),
    Spec("blow", "", "Blowouts at set instants: `TIRE@SECONDS`, several joined by commas; simulated"
         " time since the start, and again since each `reset`.", live=True),
    Spec("blowout_input", False, "Take `blowout` as an input, too: a tire that somebody else names"
         " there is blown. For playing back bags."),
    Spec("step_periods", 1, "Publishing periods that one call of `step` advances.", "", 1, 1000000,
         True),
    Spec("step_awaits", "", "Inputs, joined by commas, of which `step` awaits a new message (for at"
         " most a second) before it advances: `steering_wheel_angle,throttle`.", live=True),
    Spec("max_clock_jump_s", 1.0, "A followed `/clock` that leaps ahead by more is a jump: the"
         " truck keeps its state; the gap is skipped.", "s", 0.01, 3600, True),
    Spec("record_path", "", "Bag to write from the start; later ones get a number. Ends in"
         " `.mcap`: a bare file, else a rosbag2 folder. Changed while running, it must lie under"
         " `record_folder`.", live=True),
    Spec("record_folder", "", "Where relative paths of bags begin, and the only folder in which"
         " other nodes may have bags written; empty: the folder in which the node was started."),
    Spec("input_timeout_s", 1.0, "Silence of an input, in simulated time, after which its safe"
         " value applies; 0: never, the last value holds.", "s", 0, 3600, True),
    Spec("publish_tf", True, "Publish /tf and /tf_static (where tf2_msgs is installed)."),
    Spec("tf_of_joints", True, "Put wheels, steering and trailer of the robot model into /tf, too;"
         " false where robot_state_publisher does so."),
    Spec("marker_rate_hz", 10.0, "Tire force markers per simulated second; 0: none.", "Hz",
         0, 100),
    Spec("diagnostics_rate_hz", 1.0, "`/diagnostics` messages per second of wall time.", "Hz",
         0.1, 10),
)  # fmt: skip

_RATES = tuple(
    Spec(f"rates.{group}_hz", 0.0, f"Rate of the {group.replace('_', ' ')} messages;"
         " 0: as `publish_rate_hz`.", "Hz", 0, 1000)
    for group in GROUPS
)  # fmt: skip


def _input_specs(name: str) -> tuple[Spec, ...]:
    topic, unit, low, high = _COMMANDS[name]
    ends = _ROWS[name].lowest, _ROWS[name].highest  # beyond these the truck takes no input
    by_brakes = "" if high else "; 0: by the vehicle's brakes"
    return (
        Spec(f"inputs.{name}.min", low, f"Smallest value taken on `{topic}`.", unit, *ends),
        Spec(f"inputs.{name}.max", high, f"Largest value taken on `{topic}`{by_brakes}.", unit,
             *ends),
        Spec(f"inputs.{name}.safe_value", 0.0, f"What applies before the first message on `{topic}`"
             " and after its timeout.", unit, low, high or _MOST_PA["hydraulic"], True),
        Spec(f"inputs.{name}.timeout_s", -1.0, "Timeout of this input alone; -1: as"
             " `input_timeout_s`; 0: never.", "s", -1, 3600, True),
    )  # fmt: skip


PLAIN_SPECS: tuple[Spec, ...] = (*_GENERAL, *_RATES)
"""All but those of the inputs, of which every input has four."""

SPECS: tuple[Spec, ...] = (
    *PLAIN_SPECS,
    *(spec for name in _COMMANDS for spec in _input_specs(name)),
)

Values = Mapping[str, Any]


def inputs_markdown() -> str:
    """The parameters of the inputs as a table for the documentation, one row an input."""
    rows = ["| `<input>` | topic | `min` | `max` | unit |", "|---|---|---|---|---|"]
    for name, (topic, unit, low, high) in _COMMANDS.items():
        most = f"{high:g}" if high else " or ".join(f"{p:g} ({k})" for k, p in _MOST_PA.items())
        rows.append(f"| `{name}` | `{topic}` | {low:g} | {most} | {unit} |")
    return "\n".join(rows) + "\n"


def initial_state(values: Values) -> InitialState:
    """Where the truck begins."""
    return InitialState(
        speed_mps=values["initial_speed_mps"],
        lateral_speed_mps=values["initial_lateral_speed_mps"],
        yaw_rate_radps=values["initial_yaw_rate_radps"],
        x_m=values["initial_x_m"],
        y_m=values["initial_y_m"],
        yaw_rad=values["initial_yaw_rad"],
        articulation_rad=values["initial_articulation_rad"],
        flat=flat_of(values["initial_flat"]),
    )


def flat_of(text: str) -> tuple[Flat, ...]:
    """Tires that burst before the start, and how long before, of the words of `initial_flat`.

    Raises:
        InputError: a word of another form, or an instant that cannot be.
    """
    expected = "TIRE@SECONDS before the start"
    try:
        events = parse_blowouts(text.split(",") if text else [])
    except InputError as error:
        raise InputError(error.problem.removeprefix("--blow "), file="parameter",
                         where="initial_flat", expected=expected) from None  # fmt: skip
    before = [Blowout(-b.time_s, b.tires) for b in events]
    if not all(-STAMPS_END_S < b.time_s <= 0.0 for b in before):
        raise InputError(f"{quoted(text)}: a tire that bursts later, or too long ago",
                         file="parameter", where="initial_flat", expected=expected)  # fmt: skip
    return flat_at(sorted(before, key=lambda b: b.time_s), 0.0)


def inputs_of(values: Values, brakes: str = "air") -> list[Input]:
    """The five guarded inputs.

    Args:
        values: parameters.
        brakes: what is in the vehicle's brake lines; bounds pressures whose `max` is 0.

    Raises:
        InputError: a range without a value in it, or a safe value outside of it.
    """
    found = []
    for name, (topic, _, _, most) in _COMMANDS.items():
        high = values[f"inputs.{name}.max"]
        one = Input(
            name=name,
            topic=topic,
            low=values[f"inputs.{name}.min"],
            high=high if high or most else _MOST_PA[brakes],
            timeout_s=timeout_of(values, name),
            safe_value=values[f"inputs.{name}.safe_value"],
        )
        if not one.low <= one.high:
            raise InputError(f"{one.low:g} lies above max, {one.high:g}", file="parameter",
                             where=f"inputs.{name}.min", expected="min <= max")  # fmt: skip
        check_safe_value(one, one.safe_value)
        found.append(one)
    return found


def check_safe_value(one: Input, value: float) -> None:
    """What applies without messages must be a value that a message may bring.

    Raises:
        InputError: it lies outside of the input's range.
    """
    if not one.low <= value <= one.high:
        raise InputError(f"{value:g} is out of range", file="parameter",
                         where=f"inputs.{one.name}.safe_value",
                         expected=f"min to max, {one.low:g} to {one.high:g}")  # fmt: skip


def timeout_of(values: Values, name: str) -> float:
    """Timeout of one input, its own or the common one."""
    own = float(values[f"inputs.{name}.timeout_s"])
    return own if own >= 0 else float(values["input_timeout_s"])


@dataclass(frozen=True)
class Timing:
    """Rates turned into whole numbers of steps and ticks.

    Attributes:
        tick_steps: steps of a tick, the shortest interval at which anything is published.
        publish_every, clock_every, marker_every: ticks between messages; 0: none.
        group_every: same, by output group.
        notes: rates that had to be rounded, in words.
    """

    tick_steps: int
    publish_every: int
    clock_every: int
    marker_every: int
    group_every: Mapping[str, int]
    notes: tuple[str, ...]


def timing_of(values: Values, *, following: bool) -> Timing:
    """Fit the rates to the step.

    Args:
        values: parameters.
        following: somebody else publishes `/clock`, so its rate does not count here.
    """
    wanted = {
        f"rates.{group}_hz": values[f"rates.{group}_hz"] or values["publish_rate_hz"]
        for group in GROUPS
    }
    wanted["publish_rate_hz"] = values["publish_rate_hz"]
    if not following:
        wanted["clock_rate_hz"] = values["clock_rate_hz"]
    step_s = values["step_s"]
    tick_steps = max(1, round(1.0 / (max(wanted.values()) * step_s)))
    tick_hz = 1.0 / (tick_steps * step_s)
    notes = []
    every = {}
    for name, rate_hz in wanted.items():
        every[name] = max(1, round(tick_hz / rate_hz))
        got_hz = tick_hz / every[name]
        if abs(got_hz / rate_hz - 1) > 1e-6:
            notes.append(f"{name}: {rate_hz:g} Hz does not fit the step, {got_hz:.4g} Hz it is")
    marker_hz = values["marker_rate_hz"]
    return Timing(
        tick_steps=tick_steps,
        publish_every=every["publish_rate_hz"],
        clock_every=every.get("clock_rate_hz", 0),
        marker_every=max(1, round(tick_hz / marker_hz)) if marker_hz else 0,
        group_every={group: every[f"rates.{group}_hz"] for group in GROUPS},
        notes=tuple(notes),
    )
