"""Entry point of the node `simulator`; the node itself is `simulator_node`."""

from __future__ import annotations

from collections.abc import Sequence

from truck_blowout_sim.nodes.door import open_node


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the node; returns the exit status."""
    return open_node("simulator", arguments)


if __name__ == "__main__":
    raise SystemExit(main())
