"""The thesis's figures and tables by number, from made-up runs: all of them draw and say it all."""

from __future__ import annotations

import numpy as np
import pytest

from truck_blowout_sim import Blowout, InputError, Recording, Series, load_vehicle
from truck_blowout_sim.cli.plot_thesis import chosen
from truck_blowout_sim.recordings.channels import channels_for
from truck_blowout_sim.report.thesis import FIGURES, TABLES, figure_picture, thesis_table
from truck_blowout_sim.report.thesis.page import thesis_page
from truck_blowout_sim.simulation.thesis_data import SHEETS, ThesisData, thesis_data
from truck_blowout_sim.simulation.tire_rig import TireMap


def made_up(start_s: float, end_s: float) -> Recording:
    time = np.linspace(start_s, end_s, 200)
    wave = np.sin(time) + 1.0
    channels = {c.name: Series(time, wave) for c in channels_for()}
    return Recording("run", channels, (Blowout(0.0, ("steer_left",)),))


@pytest.fixture(scope="module")
def data() -> ThesisData:
    vehicles = {sheet: load_vehicle(name) for sheet, name in SHEETS.items()}
    steer = {sheet: made_up(-4.9, 10.0) for sheet in SHEETS}
    turns = {(axle, case): made_up(0.0, 12.0) for axle in ("trailer", "drive")
             for case in ("no blowout", "left duals", "right duals", "left outer")}
    slip, load = np.radians(np.linspace(0, 20, 41)), np.linspace(0.0, 5e4, 11)
    values = np.outer(np.sin(slip), load)
    maps = {(sheet, flat): TireMap(slip, load, values, values)
            for sheet in SHEETS for flat in (False, True)}
    return ThesisData(vehicles, made_up(-4.9, 10.0), steer, turns, maps)


def test_every_plot_of_the_thesis_has_its_number() -> None:
    assert set(FIGURES) == {*range(3, 7), *range(10, 22), *range(29, 46)}
    assert set(TABLES) == set(range(1, 11))


@pytest.mark.parametrize("number", sorted(FIGURES))
def test_a_figure_draws_and_carries_the_statement(number: int, data: ThesisData) -> None:
    picture = figure_picture(number, data)
    words = " ".join(text.get_text() for part in picture.figure.subfigs[1].axes
                     for text in part.texts).replace("\n", " ")  # fmt: skip
    assert FIGURES[number].stated.split()[0] in words
    assert picture.figure.subfigs[0].axes


@pytest.mark.parametrize("number", sorted(TABLES))
def test_a_table_is_complete(number: int, data: ThesisData) -> None:
    table = thesis_table(number, data)
    assert table.rows
    assert all(len(row) == len(table.header) and all(row) for row in table.rows)


def test_tables_show_what_the_sheets_say(data: ThesisData) -> None:
    rows = {row[0]: row for row in thesis_table(8, data).rows}
    assert rows["steer"][1] == rows["steer"][3] == "491; 980"
    assert thesis_table(9, data).rows[-1] == ("0.50", "300.0", "98000")
    assert thesis_table(1, data).rows[0][2] == "51,998"


def test_words_choose_figures_and_tables() -> None:
    assert chosen(["18", "figure_20", "table8"]) == ([18, 20], [8])
    assert chosen(["3-6", "Table 1"])[0] == [3, 4, 5, 6]
    assert chosen(["all"]) == (list(FIGURES), list(TABLES))
    for wrong in ("7", "46", "table11", "fig"):
        with pytest.raises(InputError, match="3-6"):
            chosen([wrong])


def test_the_page_holds_figures_and_tables(data: ThesisData) -> None:
    page = thesis_page([figure_picture(12, data)], [thesis_table(8, data)])
    assert "Figure 12. Brake torque" in page
    assert "Table 8. Tires" in page


def test_figures_of_the_sheet_alone_need_no_run() -> None:
    (axes,) = figure_picture(13, thesis_data(())).figure.subfigs[0].axes
    assert {text.get_text() for text in axes.get_legend().get_texts()} == set(SHEETS)
    rest = [line.get_ydata()[0] for line in axes.lines if list(line.get_xdata()) == [0.0]]
    assert rest == pytest.approx([24.0, 24.0], abs=3.0)  # kN, half of what the axle carries
