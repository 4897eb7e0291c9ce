"""What a person gets to read about a wrong file: one line with file, key, value, expectation."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from truck_blowout_sim.errors import InputError
from truck_blowout_sim.vehicle import load_road, load_vehicle

Extending = Callable[[str], Path]
Refusal = Callable[[Path], str]

BODY = "units: {tractor: {body: {%s}}}"
WRONG = {
    "unknown key": ("colour: red", "colour: unknown key 'colour'", "one of: title"),
    "misspelled key": (BODY % "mas_kg: 5000", "mas_kg", "did you mean 'mass_kg'?"),
    "misspelled section": ("stearing: {ratio: 20}", "stearing", "did you mean 'steering'?"),
    "no unit": (BODY % "mass: 5000", "units.tractor.body.mass: 5000 has no unit", "mass_kg"),
    "another unit": (BODY % "mass_stone: 800", "800 in 'stone'", "mass_kg or mass_lb"),
    "unit of another quantity": (BODY % "mass_m: 1", "1 in 'm': not a unit", "mass_kg"),
    "text for a number": (BODY % "mass_kg: heavy", "'heavy' is not a number", "greater than 0"),
    "list for a number": (BODY % "mass_kg: [1, 2]", "[1, 2] is not a number", "greater than 0"),
    "truth for a number": (BODY % "mass_kg: true", "True is not a number", "greater than 0"),
    "not a number": (BODY % "mass_kg: .nan", "NaN", "greater than 0"),
    "infinite": (BODY % "mass_kg: .inf", "inf is out of bounds", "greater than 0"),
    "negative mass": (BODY % "mass_kg: -5", "-5 is out of bounds", "greater than 0"),
    "negative in pounds": (BODY % "mass_lb: -5", "mass_lb: -5 is out", "greater than 0"),
    "section for a number": (BODY % "mass_kg: {a: 1}", "is a section", "a number"),
    "number for a section": ("units: {tractor: {body: 5}}", "5 is not a section", "keys below"),
    "word beside a value": (BODY % "mass_kg: {value: 1, src: x}", "'src'", "value, source, spread"),
    "source of the wrong kind": (BODY % "mass_kg: {value: 1, source: 2}", "source 2", "quotes"),
    "word of a choice": ("abs: {mode: on_demand}", "'on_demand' is not", "slip_threshold"),
    "number for a switch": ("steering: {compliant: 1}", "1 is not accepted", "true or false"),
    "inertia of no body": (BODY % "ixx_kgm2: 90000", "90000 is more than", "at most"),
    "product of inertia": (BODY % "ixz_kgm2: 20000", "20000 belongs to no body", "sqrt(Ixx Izz)"),
    "twin tires that steer": ("axles: {steer: {dual_spacing_m: 0.3}}", "dual_spacing_m",
                              "single tires on the steered axle"),
    "no pressure to divide by": ("blowout: {extends: continuous, pressure_valid: 0}",
                                 "0 is out of bounds", "greater than 0"),
    "no air left in a flat tire": ("blowout: {extends: continuous, flat_volume_fraction: 1}",
                                   "1 is out of bounds", "0.99"),
    "axle behind the frame": ("axles: {drive_2: {x_m: 9}}", "9 m lies outside", "-1.2 to 7.5 m"),
    "payload beside the deck": (
        "units: {trailer: {payload: {front_block: {x_m: 20}}}}",
        "20 m lies outside the frame",
        "-0.91 to 13.72 m",
    ),
    "frame inside out": ("units: {tractor: {frame: {rear_x_m: -2}}}", "is not ahead", "rearward"),
    "axle of no unit": ("axles: {steer: {unit: dolly}}", "'dolly'", "tractor, trailer"),
    "new axle, half described": ("axles: {lift: {unit: trailer}}", "axles.lift", "circuit"),
    "name of an axle": ("axles: {Lift: {unit: trailer}}", "axles.Lift", ""),
    "tire of unknown hub": ("tires: {stear_left: x}", "'stear_left' is no axle", "'steer_left'"),
    "unknown tire file": ("tires: {steer: steer_275}", "no tire", "steer_275_80r22_5"),
    "unknown blowout": ("blowout: bang", "no blowout of the name 'bang'", "continuous"),
    "unknown road": ("road: moon", "no road of the name 'moon'", "level_dry"),
    "duals wider than the axle": ("axles: {drive_1: {dual_spacing_m: 3}}", "3 m does", "1.83 m"),
    "two steered axles": ("axles: {drive_1: {steered: true}}", "drive_1 cannot be", "one steered"),
    "partner that is not": ("axles: {trailer_1: {equalized_with: trailer_3}}", "'trailer_3'", ""),
    "partner of another": ("axles: {drive_1: {equalized_with: drive_2}}", "drive_2 is", "both"),
    "drive shares": ("axles: {drive_1: {drive_share: 0.5}}", "adds up to 1.5", "1 over both"),
    "share above one": ("axles: {drive_1: {drive_share: 3}}", "3 is out of bounds", "at most 1"),
    "trailer without coupling": ("fifth_wheel: ", "fifth_wheel and trailer", "for the trailer"),
    "coupling without trailer": ("units: {trailer: }", "fifth_wheel and trailer", "none without"),
    "no hitch": ("units: {tractor: {hitch: }}", "hitch is missing", "x_m and z_m"),
    "undetermined loads": ("axles: {drive_2: {circuit: trailer}}", "on 3 groups", "2 different"),
    "axle that lifts": ("axles: {steer: {x_m: 4}}", "carries -", "both sides of the center"),
    "slip thresholds": ("abs: {slip_on: 0.9}", "is above slip_off", "at most 0.15"),
    "no steering": ("steering: ", "steer is steered by nothing", "a steering section"),
    "effect of unknown hub": (
        "effects: {hub.trailer_2_lef.brake_gain: 1}",
        "no parameter 'hub.trailer_2_lef.brake_gain'",
        "did you mean 'hub.trailer_2_left.brake_gain'?",
    ),
    "unknown effect": (
        "effects: {hub.steer_left.brake_gian: 1}",
        "brake_gian",
        "'hub.steer_left.brake_gain'",
    ),
    "effect that is no number": ("effects: {world.wind_x_mps: hard}", "'hard'", "a number"),
    "effect without bounds": ("effects: {hub.steer_left.toe_rad: .inf}", "inf is out", "finite"),
    "negative effect": ("effects: {unit.trailer.mass_kg: -1}", "-1 is out", "above 0"),
    "effects that are a list": ("effects: [1]", "[1] is not a section", "packed names"),
    "extends twice": ("extends: ferrari_250lm", "extends: is given twice", "one value"),
    "key twice": ("title: a\ntitle: b", "title: is given twice, first in line 2", "one value"),
    "key twice in two units": (BODY % "mass_kg: 1, mass_lb: 2", "mass_lb: is given", "one value"),
    "key that is a list": ("? [a, b]\n: 1", "a key is not a word", "a name"),
}


@pytest.mark.parametrize(("text", "found", "expected"), WRONG.values(), ids=WRONG.keys())
def test_one_line_says_what_is_wrong(
    extending: Extending, refusal: Refusal, text: str, found: str, expected: str
) -> None:
    line = refusal(extending(text))
    assert found in line
    assert expected in line
    assert "line " in line


UNREADABLE = {
    "empty": "",
    "not a mapping": "- 1\n- 2\n",
    "a word": "truck",
    "broken": "units: {tractor: [\n",
    "tab": "units:\n\ttractor: 1\n",
    "unknown tag": "title: !!python/object:os.system {}\n",
    "unknown alias": "title: *nobody\n",
    "contains itself": "title: t\nunits: &u {tractor: *u}\n",
    "list in itself": "title: &t [*t]\n",
    "merge of a number": "units: {<<: 5}\n",
    "extends a section": "extends: {a: 1}\n",
    "extends a number": "extends: 5\n",
    "extends nothing": "extends: no_such_vehicle\n",
    "merge that gives twice": "units: {<<: {a: 1}, <<: {a: 2}}\nunits: 1\n",
}


@pytest.mark.parametrize("text", UNREADABLE.values(), ids=UNREADABLE.keys())
def test_what_is_no_vehicle_is_refused(
    write: Callable[..., Path], refusal: Refusal, text: str
) -> None:
    assert "expected" in refusal(write(text)) or "not YAML" in refusal(write(text))


def test_bytes_that_are_no_text_are_refused(tmp_path: Path, refusal: Refusal) -> None:
    path = tmp_path / "binary.yaml"
    path.write_bytes(bytes(range(256)))
    assert "cannot be read" in refusal(path)


def test_growth_by_aliases_is_refused(write: Callable[..., Path], refusal: Refusal) -> None:
    levels = ["a0: &a0 {b: 1, c: 2}"]
    levels += [f"a{n}: &a{n} {{b: *a{n - 1}, c: *a{n - 1}}}" for n in range(1, 40)]
    assert "too large" in refusal(write("\n".join(levels)))


def test_a_wrong_tire_file_is_named_itself(
    write: Callable[..., Path], extending: Extending
) -> None:

    tire = write("extends: steer_275_80r22_5\npressure_psi: low\n", "soft.yaml")
    with pytest.raises(InputError, match=f"{tire}.*line 2: pressure_psi: 'low' is not a number"):
        load_vehicle(extending("tires: {steer: soft.yaml}"))


PATCH = "patch: {{x0_m: {0}, x1_m: {1}, y0_m: {2}, y1_m: {3}, scale: 0.3}}"


@pytest.mark.parametrize(("edges", "key", "words"), [
    ((20, 10, -5, 0), "x0_m", "20 m is not before x1_m, 10 m; expected less than x1_m"),
    ((10, 20, 0, 0), "y0_m", "0 m is not before y1_m, 0 m; expected less than y1_m"),
])
def test_a_patch_that_covers_nothing_is_refused(
    write: Callable[..., Path], extending: Extending, edges: tuple[int, ...], key: str, words: str
) -> None:
    """As a road of its own, and as one that a vehicle file names or writes out."""
    road = write(f"extends: level_dry\n{PATCH.format(*edges)}\n", "road.yaml")
    with pytest.raises(InputError, match=f"{road}, line 2: patch.{key}: {words}"):
        load_road(road)
    for text in ("road: road.yaml", f"road: {{extends: level_dry, {PATCH.format(*edges)}}}"):
        with pytest.raises(InputError, match=f"patch.{key}: {words}"):
            load_vehicle(extending(text))
