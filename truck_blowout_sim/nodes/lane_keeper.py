"""Entry point of the node `lane_keeper`; the node itself is `lane_keeper_node`."""

from __future__ import annotations

from collections.abc import Sequence

from truck_blowout_sim.nodes.door import open_node


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the node; returns the exit status."""
    return open_node("lane_keeper", arguments)


if __name__ == "__main__":
    raise SystemExit(main())
