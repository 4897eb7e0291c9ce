"""What loggers call a truck's quantities: names that hint at a channel.

References: CarSim/TruckSim output variable names (Vx, AVz, Steer_SW); Racelogic VBOX channels;
common CAN database and ROS message field names; German names as in MDF exports.
Known limits: names only; units and sizes are weighed in `proposing`.
Validated with: test/recordings/test_proposing.py, test/recordings/test_bring_your_own_log.py.
"""

from __future__ import annotations

import re

TRAILER = re.compile(r"\b(?:trailer|trl|semi|semitrailer|unit ?2|auflieger|anhaenger)\b|_2$|\b2$")

# short names that mean one thing exactly, after lower case and without the unit's number
EXACT = {
    "vx": "vx_mps", "vy": "vy_mps", "avz": "yaw_rate_radps", "avx": "roll_rate_radps",
    "avy": "pitch_rate_radps", "ax": "ax_mps2", "ay": "ay_mps2", "az": "az_mps2",
    "roll": "roll_rad", "pitch": "pitch_rad", "yaw": "yaw_rad", "xo": "x_m", "yo": "y_m",
    "steer sw": "steering_wheel_angle_rad", "throttle": "throttle", "velocity": "vx_mps",
    "heading": "yaw_rad", "cog": "yaw_rad", "longacc": "ax_mps2", "latacc": "ay_mps2",
    "a long": "ax_mps2", "a lon": "ax_mps2", "a lat": "ay_mps2",
    "swa": "steering_wheel_angle_rad", "lws angle": "steering_wheel_angle_rad",
    "speed": "vx_mps", "sog": "vx_mps", "r": "yaw_rate_radps", "pbk con": "brake_pressure_pa",
    "x": "x_m", "y": "y_m", "easting": "x_m", "northing": "y_m",
    "lat": "latitude_rad", "long": "longitude_rad", "lon": "longitude_rad",
    "lng": "longitude_rad", "altitude": "altitude_m", "alt": "altitude_m", "height": "altitude_m",
}  # fmt: skip

_CARSIM_AXLES = ("steer", "drive_1", "drive_2", "trailer_1", "trailer_2")
WHEELS = {
    f"avy {side[0]}{axle + 1}": f"hub_speed_{name}_{side}_radps"
    for axle, name in enumerate(_CARSIM_AXLES)
    for side in ("left", "right")
}
"""CarSim's wheel speeds, axles counted from the front."""

_WHEEL_SPEED = re.compile(r"wh?(ee)?l ?(sp(ee)?d|rpm|rate|vel\w*)|\b(sp(ee)?d|rpm) wh?(ee)?l\b")
_TIRE_PRESSURE = re.compile(r"\b(tires?|tyres?)\b.* ?(pres\w*|prs)\b|\breifen\w*druck\w*\b")
_OF_WHEELS = (
    (_WHEEL_SPEED, ("hub_speed_", "_radps")), (_TIRE_PRESSURE, ("tire_pressure_", "_pa")),
)  # fmt: skip
_CORNERS = (
    (re.compile(r"\b(f ?l|l ?f|v ?l|vorn links|front \w*? ?left|left front)\b"), "steer_left"),
    (re.compile(r"\b(f ?r|r ?f|v ?r|vorn rechts|front \w*? ?right|right front)\b"), "steer_right"),
    (re.compile(r"\b(r ?l|l ?r|h ?l|hinten links|rear \w*? ?left|left rear)\b"), "drive_1_left"),
    (re.compile(r"\b(r ?r|h ?r|hinten rechts|rear \w*? ?right|right rear)\b"), "drive_1_right"),
)

# words of a name, the most telling first; a name of several words is tried as a whole
PATTERNS = tuple(
    (re.compile(pattern), stem)
    for pattern, stem in (
        (r"(road|front) ?wheel (angle|steer)|tire angle|steer\w* axle", ""),
        (r"(steer\w*|hand ?wheel|lenkrad\w*|swa|sas)( wheel)?.*(rate|vel|speed|torque|moment)", ""),
        (r"(steer\w*|str ?whl|hand ?wheel|lenkrad\w*|swa)( wheel)?.*(ang\w*|winkel|position|pos)?",
         "steering_wheel_angle_rad"),
        (r"(throttle|accel\w* ped\w*|gas ?pedal|fahrpedal|app)", "throttle"),
        (r"orientation yaw", "yaw_rad"),
        (r"orientation roll", "roll_rad"),
        (r"orientation pitch", "pitch_rad"),
        (r"(yaw ?(rate|vel\w*)|gyro ?z|gier\w*|ang\w* vel\w* z|angular z|rate ?z|wz)",
         "yaw_rate_radps"),
        (r"(roll ?(rate|vel\w*)|gyro ?x|ang\w* vel\w* x|angular x|rate ?x|wx)", "roll_rate_radps"),
        (r"(pitch ?(rate|vel\w*)|gyro ?y|ang\w* vel\w* y|angular y|rate ?y|wy)",
         "pitch_rate_radps"),
        (r"(lat\w* (acc\w*|g ?force)|(acc\w*|g ?force) (lat\w*|y)|linear acceleration y"
         r"|quer\w*besch\w*|a ?y)\b", "ay_mps2"),
        (r"(lon\w* (acc\w*|g ?force)|(acc\w*|g ?force) (lon\w*|x)|linear acceleration x"
         r"|laengs\w*besch\w*|a ?x)\b", "ax_mps2"),
        (r"(vert\w* (acc\w*|g ?force)|(acc\w*|g ?force) (vert\w*|z)|linear acceleration z"
         r"|a ?z)\b", "az_mps2"),
        (r"(lat\w* (vel\w*|speed)|vel\w* (lat\w*|y)|linear y|v ?y)\b", "vy_mps"),
        (r"(vert\w* (vel\w*|speed)|vel\w* (vert\w*|z)|linear z|wheel ?(speed|spd)|whl ?spd"
         r"|engine ?speed)", ""),
        (r"(veh\w* ?(spd|speed|vel\w*)|speed|lon\w* vel\w*|vel\w* x|linear x|\bv ?x\b|geschw\w*"
         r"|velocity)", "vx_mps"),
        (r"(yaw( ?angle)?|heading|course( over ground)?|track ?angle|psi|kurs)$", "yaw_rad"),
        (r"roll( ?angle)?$", "roll_rad"),
        (r"pitch( ?angle)?$", "pitch_rad"),
        (r"(position x|pos ?x|utm ?e\w*|easting|x ?pos\w*)$", "x_m"),
        (r"(position y|pos ?y|utm ?n\w*|northing|y ?pos\w*)$", "y_m"),
        (r"latitude|breitengrad|^(gps|gnss|pos\w*) lat$", "latitude_rad"),
        (r"longitude|laengengrad|^(gps|gnss|pos\w*) (long?|lng)$", "longitude_rad"),
        (r"art h\b|articulation|hitch ang\w*|knickwinkel", "articulation_rad"),
        (r"brake? ?.*(pres\w*|druck).*(trl|trailer)|(trl|trailer) ?brake?",
         "brake_pressure_trailer_pa"),
        (r"brake? ?.*(pres\w*|druck).*(front|steer)", "brake_pressure_steer_pa"),
        (r"brake? ?.*(pres\w*|druck).*(rear|drive)", "brake_pressure_drive_pa"),
        (r"br(a?ke?)? ?.*(pres\w*|prs|druck)|(master|line) ?cyl\w* ?pres\w*", "brake_pressure_pa"),
    )
)
_CAMEL = re.compile(r"(?<=[a-z])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])")
# channels that belong to no unit
_WHOLE = ("steering_wheel_angle_rad", "throttle", "brake_pressure", "articulation")


def words_of(name: str) -> str:
    """A name in lower-case words: ``VehSpd_kph`` as ``veh spd kph``."""
    apart = _CAMEL.sub(" ", name)
    return " ".join(re.sub(r"[^0-9A-Za-z]+", " ", apart).lower().split())


def channel_hinted(name: str) -> str:
    """Channel that a column's name hints at, empty if it hints at none."""
    parents, dot, part = name.rpartition(".")
    if dot and ":" not in name and (found := channel_hinted(part)):
        # a field of a structure: its own name says most
        of_trailer = TRAILER.search(words_of(parents)) and found.startswith("tractor_")
        return found.replace("tractor_", "trailer_", 1) if of_trailer else found
    words = words_of(name)
    as_is = " ".join(re.sub(r"[^0-9A-Za-z]+", " ", name).lower().split())
    if as_is in WHEELS:
        return WHEELS[as_is]
    for quantity, (before, after) in _OF_WHEELS:
        if quantity.search(words):
            hub = next((hub for corner, hub in _CORNERS if corner.search(words)), "")
            return f"{before}{hub}{after}" if hub else ""
    trailer = bool(TRAILER.search(words.replace("_", " ")) or TRAILER.search(name.lower()))
    bare = TRAILER.sub("", words).strip()
    short = TRAILER.sub("", as_is).strip()
    last = words_of(name.rpartition(":")[2])
    stem = EXACT.get(short) or EXACT.get(bare) or EXACT.get(last)
    if stem is None:
        field = words_of(name.partition(":")[2]) or words
        stem = next((s for text in (field, words) for p, s in PATTERNS if p.search(text)), "")
    if not stem or stem.startswith(_WHOLE):
        return stem
    return f"{'trailer' if trailer else 'tractor'}_{stem}"
