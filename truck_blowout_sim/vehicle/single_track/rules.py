"""The rules of thumb: one number each, with its spread and source, in `config/single_track`."""


from __future__ import annotations

from dataclasses import dataclass

from truck_blowout_sim.resources import config_file
from truck_blowout_sim.vehicle.document import read_document
from truck_blowout_sim.vehicle.fields import at_least_zero, fraction, number, positive
from truck_blowout_sim.vehicle.reading import Notes, build

FOLDER = "single_track"


@dataclass(frozen=True, kw_only=True)
class RulesSpec:
    """Numbers that fill in a vehicle of one kind; `_per_` and `_share` say of what they are."""

    # masses
    axle_mass_share: float = fraction("unsprung mass of an axle over the mass that rests on it")
    axle_gyration_per_track: float = positive("radius of gyration of an axle over its track")
    roll_gyration_per_track: float = positive("roll radius of gyration of the body over the track")
    yaw_inertia_index: float = positive("yaw inertia over mass times both lever arms of the axles")
    cg_height_per_track: float = positive("height of the center of gravity over the track")
    front_overhang_per_wheelbase: float = positive("front overhang over the wheelbase")
    rear_overhang_per_wheelbase: float = positive("rear overhang over the wheelbase")
    track_m: float = positive("between the wheel centers")
    axle_spread_m: float = positive("between neighboring axles of a group")
    rear_tires_per_axle: float = number("2 or 4", low=2.0, high=4.0)
    dual_gap_share: float = at_least_zero("gap between twin tires over the section width")
    # frame and hitch
    torsion_nmprad: float = positive("torsional stiffness of the frame")
    torsion_damping_s: float = positive("time constant of the twist")
    hitch_height_m: float = positive("fifth wheel above the road")
    # suspension
    front_ride_hz: float = positive("natural frequency of heave over the front axle")
    rear_ride_hz: float = positive("natural frequency of heave over the rear axles")
    damping_ratio: float = at_least_zero("damper rate over critical")
    friction_share: float = at_least_zero("friction of one side over the load it carries")
    friction_transition_m: float = positive("travel over which friction turns over")
    roll_gradient_rad: float = positive("roll of the body at a lateral acceleration of 1 g")
    front_roll_share: float = fraction("share of the roll stiffness of the front axle")
    spring_spacing_share: float = positive("distance of the springs over the track")
    front_roll_centre_m: float = at_least_zero("roll center of the front axle above the road")
    rear_roll_centre_m: float = at_least_zero("roll center of a rear axle above the road")
    travel_m: float = positive("suspension travel to either stop")
    stop_per_spring: float = positive("rate of a stop over the rate of the spring")
    equalizer_m: float = at_least_zero("travel over which two rear axles share their load")
    # tires
    tire_pressure_pa: float = positive("gauge pressure")
    cornering_per_load: float = positive("cornering stiffness over load, per rad")
    cornering_load: float = positive("load of the largest stiffness over the load at rest")
    peak_friction: float = positive("peak friction on a dry road")
    slip_stiffness: float = positive("longitudinal slip stiffness over load")
    relaxation_per_radius: float = positive("relaxation length over the free radius")
    trail_per_radius: float = positive("pneumatic trail over the free radius")
    rolling_resistance: float = at_least_zero("rolling resistance over load")
    # controls
    drag_area_m2: float = positive("drag coefficient times frontal area")
    side_area_per_wheelbase_m: float = at_least_zero("side force area per rad over the wheelbase")
    air_height_per_cg_height: float = positive("height of air forces over that of the mass")
    power_wpkg: float = positive("engine power over the mass of vehicle and trailer")
    engine_drag_mps2: float = at_least_zero("deceleration with the throttle closed")
    brake_full_pa: float = positive("brake pressure of a full stop")
    brake_full_mps2: float = positive("deceleration that this pressure gives")
    brake_pushout_pa: float = at_least_zero("pressure at which the shoes touch")
    brake_delay_s: float = at_least_zero("delay of the brakes")
    brake_lag_s: float = at_least_zero("lag of the brakes")


@dataclass(frozen=True, kw_only=True)
class Rules:
    """The rules of one kind with what their file says of each."""

    kind: str
    spec: RulesSpec
    notes: Notes

    def source(self, name: str) -> str:
        """Where a rule comes from."""
        return self.notes.sources[name]

    def relative_spread(self, name: str) -> float:
        """One standard deviation of a rule over its value; 0 where its value is 0."""
        value = abs(float(getattr(self.spec, name)))
        return self.notes.spreads[name] / value if value > 0.0 else 0.0


def load_rules(kind: str) -> Rules:
    """The rules of `car`, `truck` or `trailer`.

    Raises:
        InputError: a rule is missing or wrong, or lacks its source or spread.
    """
    path = config_file(FOLDER, kind)
    tree, notes = read_document(path, FOLDER), Notes()
    spec = build(RulesSpec, tree, notes)
    for name, entry in tree.entries.items():
        if name not in notes.sources or name not in notes.spreads:
            raise entry.place.error(f"{name} lacks a source or a spread", "{value, spread, source}")
    return Rules(kind=kind, spec=spec, notes=notes)
