"""`truck-blowout vehicle`: what a vehicle file amounts to."""

from __future__ import annotations

import typer

from truck_blowout_sim.cli.outputs import JSON, say


def command(
    vehicle: str = typer.Argument(help="Name of a shipped vehicle, or a YAML file."),
    speed_mps: float = typer.Option(
        20.0, "--speed", min=3.0, max=60.0, help="Speed of the gentle turns, m/s."
    ),
    as_json: bool = JSON,
) -> None:
    """Show loads, handling and what was filled in of a vehicle file.

    Example: truck-blowout vehicle my_truck.yaml
    """
    from truck_blowout_sim.simulation.vehicle_summary import summarize_vehicle
    from truck_blowout_sim.vehicle import load_vehicle

    summary = summarize_vehicle(load_vehicle(vehicle), speed_mps=speed_mps)
    say(as_json, summary.to_json(), summary.lines())
