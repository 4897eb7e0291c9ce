"""`plot --thesis`: which figures and tables are meant, what they need, and where they go."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console

from truck_blowout_sim.errors import InputError, quoted
from truck_blowout_sim.recordings.claims import claim

PAGE = "thesis.html"


def plot_thesis(words: Sequence[str], folder: Path, forms: Sequence[str], dark: bool, force: bool
                ) -> list[Path]:
    """Draw figures and tables of the thesis; returns what was written, the page last.

    Raises:
        InputError: a word that is no figure or table, or output that exists.
    """
    from truck_blowout_sim.cli.plot import save_pictures
    from truck_blowout_sim.report.page import write_text
    from truck_blowout_sim.report.thesis import FIGURES, figure_picture, thesis_table
    from truck_blowout_sim.report.thesis.page import thesis_page
    from truck_blowout_sim.simulation.thesis_data import thesis_data

    numbers, tables = chosen(words)
    names = [f"figure_{n:02d}.{form}" for n in numbers for form in forms]
    claim(folder, force=force, writes=[PAGE, *names, *(f"table_{n:02d}.csv" for n in tables)])
    needs = {part for n in numbers for part in FIGURES[n].needs}
    with Console(stderr=True).status("preparing") as status:
        data = thesis_data(needs, lambda text: status.update(f"simulating: {text}"))
    pictures = [figure_picture(n, data) for n in numbers]
    made = [thesis_table(n, data) for n in tables]
    folder.mkdir(parents=True, exist_ok=True)
    write_text(thesis_page(pictures, made), folder / PAGE)
    paths = save_pictures(pictures, folder, forms, dark)
    for table in made:
        text = io.StringIO()
        csv.writer(text, lineterminator="\n").writerows([table.header, *table.rows])
        paths.append(folder / f"table_{table.number:02d}.csv")
        write_text(text.getvalue(), paths[-1])
    return [*paths, folder / PAGE]


def chosen(words: Sequence[str]) -> tuple[list[int], list[int]]:
    """Figures and tables that the words of ``--thesis`` mean.

    Raises:
        InputError: a word that is neither.
    """
    from truck_blowout_sim.report.thesis import FIGURES, TABLES

    figures: list[int] = []
    tables: list[int] = []
    text = re.sub(r"(?i)\b(figure|fig|table|tab)s?\s+(?=\d)", r"\1", " ".join(words))
    for word in text.replace(",", " ").split():
        if word == "all":
            figures, tables = list(FIGURES), list(TABLES)
            continue
        found = re.fullmatch(r"(?i)(figure|fig|table|tab)?[ _]?(\d+)(?:-(\d+))?", word)
        if found is None:
            raise _refused(word)
        is_table = (found[1] or "").lower().startswith("tab")
        span = range(int(found[2]), int(found[3] or found[2]) + 1)
        have = [n for n in span if n in (TABLES if is_table else FIGURES)]
        if not have:
            raise _refused(word)
        (tables if is_table else figures).extend(have)
    return list(dict.fromkeys(figures)), list(dict.fromkeys(tables))


def _refused(word: str) -> InputError:
    return InputError(f"--thesis {quoted(word)}",
                      expected="a figure 3-6, 10-21, 29-45, a table as table8, or all")
