"""Write the parameter tables of the nodes into docs/ros.md, between their markers."""

from __future__ import annotations

import re
from pathlib import Path

from truck_blowout_sim.nodes import lane_keeper_node, player_parameters, simulator_parameters
from truck_blowout_sim.nodes.parameters import markdown
from truck_blowout_sim.nodes.simulator_parameters import inputs_markdown

PAGE = Path(__file__).resolve().parents[1] / "docs" / "ros.md"
INPUTS = (
    "Each input has `inputs.<input>.min` and `.max` (range taken), `.safe_value` (0; what applies\n"
    "before the first message and after the timeout) and `.timeout_s` (-1: as `input_timeout_s`;\n"
    "0: never). The last two can be changed while running."
)
TABLES = {
    "simulator": simulator_parameters.PLAIN_SPECS,
    "player": player_parameters.SPECS,
    "lane_keeper": lane_keeper_node.SPECS,
}


def main() -> None:
    text = PAGE.read_text(encoding="utf-8")
    for name, specs in TABLES.items():
        begin, end = f"<!-- parameters of {name} -->\n", f"<!-- end of {name} -->"
        pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end), re.DOTALL)
        more = f"\n{INPUTS}\n\n{inputs_markdown()}" if name == "simulator" else ""
        table = f"{begin}\n{markdown(specs)}{more}\n{end}"
        text, count = pattern.subn(lambda _, table=table: table, text)
        if count != 1:
            raise SystemExit(f"docs/ros.md has {count} places for the parameters of {name}")
    PAGE.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
