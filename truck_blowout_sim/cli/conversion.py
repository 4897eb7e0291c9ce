"""What `import` and `export` share: a bag shows the truck; what they say at the end."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

import typer

from truck_blowout_sim.cli.drawn_vehicle import fitting_vehicle
from truck_blowout_sim.cli.listing import names_of
from truck_blowout_sim.cli.outputs import say
from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings import Recording, write_recording
from truck_blowout_sim.recordings.bag_export import Extra

VEHICLE: Any = typer.Option(
    None, help="Vehicle that a bag shows in /tf and robot_description, by name or path; by default"
    " the one the log names, else the first shipped one with its tires.",
    autocompletion=names_of("vehicles"),
)
SHOW: Any = typer.Option(True, "--show/--no-show", help="Write /tf, /tf_static, robot_description,"
                         " /clock and tire forces into a bag, so that it shows the truck.")
_BAG_ENDINGS = ("", ".mcap")


def convert(recording: Recording, output: Path, *, vehicle: str | None = None, show: bool = True,
            thesis_variables: bool = False, plain: bool = False) -> tuple[str, ...]:
    """Write a recording; a bag with what shows the truck.

    Args:
        recording: what is written.
        output: where to.
        vehicle: the one that the user names.
        show: whether a bag shows the truck.
        thesis_variables, plain: as in `write_recording`.

    Returns:
        What the bag shows and what was assumed for it, a sentence each.

    Raises:
        InputError: the vehicle cannot be loaded, or does not have a tire that was blown.
        StorageError: it cannot be written.
    """
    beside: Iterable[Extra] = ()
    words: tuple[str, ...] = ()
    if show and output.suffix.lower() in _BAG_ENDINGS:
        beside, words = _scene(recording, vehicle)
    write_recording(recording, output, thesis_variables=thesis_variables, plain=plain,
                    beside=beside)
    return words


def _scene(recording: Recording, wanted: str | None) -> tuple[Iterable[Extra], tuple[str, ...]]:
    """Messages that show the truck, and what was assumed for them."""
    from truck_blowout_sim.motion import shown

    found = fitting_vehicle(recording, wanted)
    if found is None:
        return (), ("no robot model: no shipped vehicle has these tires and hubs; --vehicle names"
                    " one",)
    vehicle, guess = found
    try:
        scene = shown(recording, vehicle)
    except InputError as error:
        if wanted is not None:
            raise
        return (), (f"no robot model: {error.problem}",)
    said = (guess or f"vehicle: {vehicle.name}", *scene.assumptions)
    return scene.messages, tuple(f"shown: {words}" for words in said)


def report(recording: Recording, output: Path, shown: tuple[str, ...], as_json: bool) -> None:
    """Say what was written."""
    tires = "+".join(dict.fromkeys(tire for b in recording.blowouts for tire in b.tires))
    event = f", {tires} blown at {recording.blowouts[0].time_s:g} s" if tires else ""
    result = {
        "output": str(output),
        "channels": sorted(recording.channels),
        "start_s": recording.start_s,
        "end_s": recording.end_s,
        "blowouts": [{"tires": list(b.tires), "at_s": b.time_s} for b in recording.blowouts],
        "missing_inputs": list(recording.missing_inputs),
        "notes": list(recording.notes),
        "shown": list(shown),
    }
    line = (f"{output}: {len(recording.channels)} channels,"
            f" {recording.start_s:g} s to {recording.end_s:g} s{event}")
    say(as_json, result, [line, *shown])
