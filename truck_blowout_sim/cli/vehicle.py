"""`truck-blowout vehicle`: what a vehicle file amounts to."""

from __future__ import annotations

from pathlib import Path

import typer

from truck_blowout_sim.cli.listing import list_option, names_of
from truck_blowout_sim.cli.outputs import FORCE, JSON, say
from truck_blowout_sim.recordings.claims import claim


def command(
    vehicle: str = typer.Argument(
        help="Name of a shipped vehicle, or a YAML file.", autocompletion=names_of("vehicles")
    ),
    speed_mps: float = typer.Option(
        20.0, min=3.0, max=60.0, help="Speed of the gentle turns, m/s."
    ),
    tires: list[str] = typer.Option(
        [], "--tire", help="Tire, hub or axle whose rig plot is drawn; 'all' for one of each axle."
        " May be repeated."
    ),
    output: Path = typer.Option(
        Path("rig"), "-o", "--output", help="Folder for the rig plots (PNG)."
    ),
    listed: bool = list_option("vehicles"),
    force: bool = FORCE,
    as_json: bool = JSON,
) -> None:
    """Show loads, handling and filled-in values of a vehicle file.

    Example: truck-blowout vehicle my_truck.yaml --tire steer_left -o rig
    """
    from truck_blowout_sim.simulation.vehicle_summary import summarize_vehicle, tires_named
    from truck_blowout_sim.vehicle import load_vehicle, pack

    packed = pack(load_vehicle(vehicle))
    drawn = tires_named(packed.vehicle, tires)
    names = [f"rig_{tire}.png" for tire in drawn]
    if drawn:
        claim(output, force=force, inputs=[packed.vehicle.path], writes=names)
    summary = summarize_vehicle(packed, speed_mps=speed_mps)
    pictures: list[str] = []
    if drawn:
        from truck_blowout_sim.report.tire_rig_figures import write_rig_pictures

        axle_of = {tire: packed.vehicle.axle_of_hub(packed.vehicle.hub_of_tire(tire))
                   for tire in drawn}  # fmt: skip
        loads = {tire: summary.tire_load_n[axle] for tire, axle in axle_of.items()}
        pictures = [str(path) for path in write_rig_pictures(packed, loads, output)]
    say(as_json, {**summary.to_json(), "pictures": pictures}, [*summary.lines(), *pictures])
