"""Tables 1 to 10 of the thesis beside our two sheets.

Validated with: test/report/test_thesis_figures.py.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from truck_blowout_sim.recordings.units import GRAVITY_MPS2
from truck_blowout_sim.simulation.thesis_data import OURS, THESIS, ThesisData
from truck_blowout_sim.vehicle import Vehicle
from truck_blowout_sim.vehicle.statics import static_loads
from truck_blowout_sim.vehicle.units import INCH_M, KMH_MPS, POUND_KG

NONE = "–"


@dataclass(frozen=True)
class Table:
    """One table: a header and rows of text."""

    number: int
    title: str
    header: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def thesis_table(number: int, data: ThesisData) -> Table:
    """One table of the thesis.

    Raises:
        KeyError: no table of this number.
    """
    title, make = TABLES[number]
    header, rows = make(data.vehicles[OURS], data.vehicles[THESIS])
    return Table(number, title, tuple(header), tuple(tuple(row) for row in rows))


Rows = tuple[tuple[str, ...], list[tuple[str, ...]]]
_HEADER = ("quantity", "thesis", OURS, THESIS)


def _unit_mass_lb(vehicle: Vehicle, unit: str) -> str:
    spec = vehicle.unit_specs[unit]
    total = spec.body.mass_kg + sum(a.mass_kg for a in vehicle.spec.axles.values()
                                    if a.unit == unit)
    return f"{total / POUND_KG:,.0f}"


def _gross_lb(vehicle: Vehicle) -> str:
    weight_n = sum(static_loads(vehicle, GRAVITY_MPS2).road_n.values())
    return f"{weight_n / GRAVITY_MPS2 / POUND_KG:,.0f}"


def _tandem_m(vehicle: Vehicle, unit: str, skip: int) -> float:
    places = [a.x_m for a in vehicle.spec.axles.values() if a.unit == unit][skip:]
    return sum(places) / len(places)


def _tractor(a: Vehicle, b: Vehicle) -> Rows:
    tires = [[v.tire_specs[t].title for t in ("steer_left", "drive_1_left_outer")] for v in (a, b)]
    wheelbase = [f"{_tandem_m(v, 'tractor', 1) / INCH_M:.0f}" for v in (a, b)]
    return _HEADER, [
        ("loaded weight (lb)", "52,000", _gross_lb(a), _gross_lb(b)),
        ("curb weight, fuel included; ours with crew and instruments (lb)", "17,523",
         _unit_mass_lb(a, "tractor"), _unit_mass_lb(b, "tractor")),
        ("wheelbase to the middle of the tandem (in)", "236", *wheelbase),
        ("front suspension", "12,000 lb, 2 leaf springs", *_springs(a, b, "steer")),
        ("rear suspension", "40,000 lb, air", *_springs(a, b, "drive_1")),
        ("ABS", "Bendix 4S/4M", str(a.spec.abs.mode), str(b.spec.abs.mode)),
        ("steer tires", "275/80R22.5 Michelin Pilot XZA2", tires[0][0], tires[1][0]),
        ("drive tires", "295/75R22.5 Goodyear G372 LHD", tires[0][1], tires[1][1]),
        ("engine (hp)", "435", *(f"{v.spec.driveline.power_w / 745.7:.0f} at the wheels"
                                 for v in (a, b))),
    ]


def _springs(a: Vehicle, b: Vehicle, axle: str) -> list[str]:
    return [f"{v.spec.axles[axle].suspension.spring_npm / 1e3:.0f} N/mm a side" for v in (a, b)]


def _trailer(a: Vehicle, b: Vehicle) -> Rows:
    track = [f"{v.spec.axles['trailer_1'].track_m / INCH_M:.1f}" for v in (a, b)]
    tires = [v.tire_specs["trailer_1_left_outer"].title for v in (a, b)]
    return _HEADER, [
        ("gross rating (lb)", "80,000", NONE, NONE),
        ("unloaded curb weight (lb)", "about 12,000", _unit_mass_lb(a, "trailer"),
         _unit_mass_lb(b, "trailer")),
        ("track (in)", "77.5", *track),
        ("suspension of either axle", "20,000 lb, 2 leaf springs, trailing arm",
         *_springs(a, b, "trailer_1")),
        ("tires", "11R22.5 Goodyear and Bridgestone", *tires),
    ]


def _axles(a: Vehicle, b: Vehicle) -> Rows:
    rows = [("steer axle", "0", *(f"{v.spec.axles['steer'].x_m * 1e3:.0f}" for v in (a, b)))]
    for words, unit, skip, stated in (("middle of the drive axles", "tractor", 1, "5994"),
                                      ("middle of the trailer axles, from the kingpin", "trailer",
                                       0, "11226.5")):
        rows.append((words, stated, *(f"{_tandem_m(v, unit, skip) * 1e3:.1f}" for v in (a, b))))
    return ("axle, mm", *_HEADER[1:]), [tuple(row) for row in rows]


def _unsprung(a: Vehicle, b: Vehicle) -> Rows:
    stated = {"steer": (527, 612), "drive_1": (1004, 579), "drive_2": (973, 584),
              "trailer_1": (735, 586), "trailer_2": (735, 593)}
    rows = []
    for axle, (mass, inertia) in stated.items():
        ours = [v.spec.axles[axle] for v in (a, b)]
        rows.append((axle, f"{mass}; {inertia}",
                     *(f"{x.mass_kg:.0f}; {x.ixx_kgm2:.0f}" for x in ours)))
    return ("mass (kg); roll and yaw inertia (kg m²)", *_HEADER[1:]), rows


def _sprung(unit: str, stated: tuple[str, ...]) -> Callable[[Vehicle, Vehicle], Rows]:
    def make(a: Vehicle, b: Vehicle) -> Rows:
        rows = []
        words = ("mass (kg)", "height of the center of gravity (mm)", "roll inertia (kg m²)",
                 "pitch inertia (kg m²)", "yaw inertia (kg m²)")
        values = [(v.mass_kg, v.z_m * 1e3, v.ixx_kgm2, v.iyy_kgm2, v.izz_kgm2)
                  for v in (a.unit_specs[unit].body, b.unit_specs[unit].body)]
        for k, (name, text) in enumerate(zip(words, stated, strict=True)):
            rows.append((name, text, *(f"{column[k]:,.0f}" for column in values)))
        return _HEADER, rows
    return make


def _payload(a: Vehicle, b: Vehicle) -> Rows:
    stated = {"mass (kg)": ("3978", "5967"), "height of its middle (mm)": ("1575", "1575"),
              "length (mm)": ("1574", "4089"), "width (mm)": ("1828", "1828"),
              "height (mm)": ("610", "610"), "behind the kingpin (mm)": ("200", "10500")}
    keys = ("mass_kg", "z_m", "length_m", "width_m", "height_m", "x_m")
    rows = []
    for (words, texts), key in zip(stated.items(), keys, strict=True):
        factor = 1.0 if key == "mass_kg" else 1e3
        ours = ["; ".join(f"{getattr(box, key) * factor:.0f}"
                          for box in v.unit_specs["trailer"].payload.values()) for v in (a, b)]
        rows.append((words, "; ".join(texts), *ours))
    return ("blocks 1 and 2", *_HEADER[1:]), rows


def _tire_rates(a: Vehicle, b: Vehicle) -> Rows:
    rows = []
    for words, tire, radius in (("steer", "steer_left", 491), ("drive", "drive_1_left_outer", 481),
                                ("trailer", "trailer_1_left_outer", 491)):
        rows.append((words, f"{radius}; 980", *(_rolling(v, tire) for v in (a, b))))
    return ("rolling radius (mm); spring rate (N/mm)", *_HEADER[1:]), rows


def _rolling(vehicle: Vehicle, tire: str) -> str:
    """Rolling radius at rest and radial rate of one tire."""
    spec, hub = vehicle.tire_specs[tire], vehicle.hub_of_tire(tire)
    axle = vehicle.axle_of_hub(hub)
    rate = spec.stiffness_npm + spec.stiffness_npmppa * spec.pressure_pa
    load = static_loads(vehicle, GRAVITY_MPS2).road_n[axle] / 2 / len(vehicle.tires_of_hub(hub))
    radius = (spec.unloaded_radius_m - spec.radius_fraction * load / rate + spec.radius_offset_m)
    return f"{radius * 1e3:.0f}; {rate / 1e3:.0f}"


def _transient(a: Vehicle, b: Vehicle) -> Rows:
    steps = b.blowout.steps
    assert steps is not None
    rows: list[tuple[str, ...]] = [
        (f"{t:.2f}", f"{r * 1e3:.1f}", f"{k / 1e3:.0f}")
        for t, r, k in zip(steps.time_s, steps.radius_m, steps.stiffness_npm, strict=True)]
    return ("time after the blowout (s)", f"rolling radius (mm), {THESIS}",
            f"vertical stiffness (N/mm), {THESIS}"), rows


def _rolling_resistance(a: Vehicle, b: Vehicle) -> Rows:
    steps = b.blowout.steps
    assert steps is not None
    rows: list[tuple[str, ...]] = [
        (f"{t:.2f}", f"{c:.5f}", f"{v * KMH_MPS:.7f}")
        for t, c, v in zip(steps.time_s, steps.rolling_0, steps.rolling_spm, strict=True)]
    return ("time after the blowout (s)", f"R_RC, {THESIS}", f"R_RV (h/km), {THESIS}"), rows


TABLES: dict[int, tuple[str, Callable[[Vehicle, Vehicle], Rows]]] = {
    1: ("Tractor", _tractor),
    2: ("Semitrailer", _trailer),
    3: ("Axle locations", _axles),
    4: ("Unsprung masses", _unsprung),
    5: ("Sprung mass of the tractor",
        _sprung("tractor", ("6,483", "1,070", "6,879", "21,711", "19,665"))),
    6: ("Sprung mass of the semitrailer",
        _sprung("trailer", ("5,927", "1,000", "9,959.7", "171,336", "179,992"))),
    7: ("Payload", _payload),
    8: ("Tires", _tire_rates),
    9: ("Radius and stiffness of the transient tires", _transient),
    10: ("Rolling resistance of the transient tires", _rolling_resistance),
}
