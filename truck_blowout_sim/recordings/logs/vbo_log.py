"""Racelogic's `.vbo`: sections of text, columns apart by blanks, units in the header.

References: Racelogic VBOX file format: [header], [column names], [data]; time is UTC as HHMMSS.SS,
latitude and longitude are minutes (west positive), velocity is km/h.
Validated with: test/recordings/test_logs_text.py.
"""

from __future__ import annotations

from pathlib import Path

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.recordings.logs.csv_log import fill, text_of
from truck_blowout_sim.recordings.logs.log import Table
from truck_blowout_sim.recordings.units import find_unit

KIND = "VBOX .vbo"
# what the format itself says, where the header gives no unit
_UNITS = {"time": "hhmmss", "velocity": "km/h", "heading": "deg", "height": "m",
          "vert-vel": "km/h", "longacc": "g", "latacc": "g", "lat": "arcmin", "long": "arcmin",
          "latitude": "arcmin", "longitude": "arcmin"}  # fmt: skip


def open_vbo(path: Path) -> Table:
    """Read a `.vbo` file.

    Raises:
        InputError: a section is missing, or a row has another number of cells.
    """
    sections = _sections(text_of(path))
    for needed in ("column names", "data"):
        if not sections.get(needed):
            raise InputError(f"has no section [{needed}]", file=path, expected="a VBOX .vbo file")
    names = " ".join(line for _, line in sections["column names"]).split()
    units = _units(names, [line.strip() for _, line in sections.get("header", [])])
    rows, places = [], []
    for number, line in sections["data"]:
        cells = line.split()
        if len(cells) == len(names):
            rows.append(cells)
            places.append(number)
    if len(rows) < max(2, len(sections["data"]) - 2):
        raise InputError(f"{len(rows)} of {len(sections['data'])} rows are whole", file=path,
                         where="section [data]", expected=f"{len(names)} cells a row")  # fmt: skip
    table = Table(path, KIND, {})
    fill(table, names, units, rows, places, ".")
    if torn := len(sections["data"]) - len(rows):
        table.notes.append(f"{torn} rows with another number of cells left out")
    return table


def _sections(text: str) -> dict[str, list[tuple[int, str]]]:
    found: dict[str, list[tuple[int, str]]] = {}
    name = ""
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip().startswith("[") and line.strip().endswith("]"):
            name = line.strip()[1:-1].strip().lower()
        elif line.strip():
            found.setdefault(name, []).append((number, line))
    return found


def _units(names: list[str], header: list[str]) -> list[str]:
    """Units by column: the last word of the header's line of that column, or the format's own."""
    units = []
    for i, name in enumerate(names):
        line = header[i] if i < len(header) == len(names) else ""
        word = line.split()[-1] if len(line.split()) > 1 else ""
        units.append(word if find_unit(word) else _UNITS.get(name.lower(), ""))
    return units
