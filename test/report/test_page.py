"""A page needs no other file, and its text is escaped."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from jinja2 import UndefinedError

from truck_blowout_sim.report.page import render, write_pictures, write_text
from truck_blowout_sim.report.style import Picture, new_axes, styled

CONTENT = {"name": "run <1>", "title": "a & b", "sentence": "it stayed in its lane",
           "facts": {"step": "1 ms"}, "notes": (), "vehicle": "truck"}


@styled
def picture() -> Picture:
    figure, axes = new_axes()
    axes.plot([0.0, 1.0], [0.0, 1.0])
    return Picture("line", "A line", "It rises.", figure)


def test_text_is_escaped_and_no_address_leads_outside() -> None:
    page = render("run.html", {**CONTENT, "pictures": [picture()]})
    assert "run &lt;1&gt;" in page
    assert "a &amp; b" in page
    addresses = re.findall(r'(?:src|href)="([^"]{5})', page) + re.findall(r"url\(([^)]*)", page)
    assert addresses == ["data:"]


def test_a_missing_value_is_an_error() -> None:
    with pytest.raises(UndefinedError, match="pictures"):
        render("run.html", CONTENT)


def test_text_and_pictures_are_written(tmp_path: Path) -> None:
    write_text("a\nb\n", tmp_path / "new" / "page.html")
    assert (tmp_path / "new/page.html").read_bytes() == b"a\nb\n"
    (path,) = write_pictures((picture(),), tmp_path)
    assert path.name == "line.png"
    assert path.read_bytes().startswith(b"\x89PNG")
