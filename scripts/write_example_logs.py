"""Makes the example logs of `config/logs`: one simulated run as other people's loggers write it.

The run is the shipped scenario `steer_axle_blowout`. What a logger does to it is done here: its own
rate, clock, units, axes, rounding, noise and delay. Run it again after a change of the model.

    python scripts/write_example_logs.py
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rosbags.rosbag2 import CompressionFormat, CompressionMode, StoragePlugin, Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from truck_blowout_sim import Recording, load_vehicle, simulate

FloatArray = NDArray[np.float64]
FOLDER = Path(__file__).resolve().parents[1] / "config" / "logs"
NS = 1_000_000_000
DEG = 180.0 / math.pi
GRAVITY_MPS2 = 9.80665
START_NS = 1_710_000_000 * NS
BAG_NS = 1_700_000_000  # a fixed beginning of the noise
LATE_NS = {"ins": 35_000_000, "can": 8_000_000}
FOREIGN = {
    "acme_vehicle_msgs/msg/WheelReport": "std_msgs/Header header\nfloat32 vehicle_speed_kph\n"
    "float32[2] steer_axle_rpm\n",
    "acme_vehicle_msgs/msg/HandWheel": "float32 angle_deg\nfloat32 torque_nm\n",
    "acme_vehicle_msgs/msg/Pedals": "float32 throttle_percent\nfloat32 trailer_brake_kpa_abs\n",
}


def main() -> None:
    """Simulate the run and write it as each logger would."""
    FOLDER.mkdir(parents=True, exist_ok=True)
    run = simulate(load_vehicle("international_9400i_trailmobile"), "steer_axle_blowout")
    write_vbox(run, FOLDER / "vbox_steer_blowout.csv")
    write_bag(run, FOLDER / "stack_steer_blowout")


def write_vbox(run: Recording, path: Path) -> None:
    """A GPS logger's text export: 20 Hz, semicolons, decimal commas, UTC, km/h, deg, g, z down."""
    noise = np.random.default_rng(BAG_NS)
    time_s = np.arange(run.start_s, run.end_s, 0.05)

    def taken(name: str, factor: float, sigma: float) -> FloatArray:
        return run.at(name, time_s) * factor + sigma * noise.standard_normal(time_s.size)

    rows = {
        "Speed [km/h]": (taken("tractor_vx_mps", 3.6, 0.05), 2),
        "Yaw rate [deg/s]": (taken("tractor_yaw_rate_radps", -DEG, 0.03), 2),
        "Lat acc [g]": (taken("tractor_ay_mps2", -1 / GRAVITY_MPS2, 0.004), 3),
        "Long acc [g]": (taken("tractor_ax_mps2", 1 / GRAVITY_MPS2, 0.004), 3),
        "Vert acc [g]": (taken("tractor_az_mps2", -1 / GRAVITY_MPS2, 0.004), 3),
        "Steering angle [deg]": (taken("steering_wheel_angle_rad", -DEG, 0.1), 1),
        "Throttle [%]": (np.clip(taken("throttle", 100.0, 0.2), 0.0, 100.0), 1),
        "Trailer brake [psi]": (taken("brake_pressure_trailer_pa", 1 / 6894.757, 0.05), 1),
        "Satellites": (np.full(time_s.size, 11.0), 0),
    }
    with path.open("w", encoding="cp1252", newline="\r\n") as out:
        out.write("GPS logger export\nDate: 14.03.2024\nAxes: x forward, y right, z down\n\n")
        out.write(";".join(["UTC time", *rows]) + "\n")
        for i, second in enumerate(time_s - time_s[0] + 45_015.0):
            minute, rest = divmod(second, 60.0)
            clock = f"{int(minute // 60):02d}:{int(minute % 60):02d}:{rest:05.2f}"
            cells = [f"{values[i]:.{digits}f}" for values, digits in rows.values()]
            out.write(";".join([clock, *cells]).replace(".", ",") + "\n")


def write_bag(run: Recording, path: Path) -> None:
    """Another stack's bag: compressed SQLite, own message types, Unix time, late, UTM."""
    store = get_typestore(Stores.ROS2_JAZZY)
    for name, text in FOREIGN.items():
        store.register(get_types_from_msg(text, name))
    made = store.types
    writer = Writer(path, version=9, storage_plugin=StoragePlugin.SQLITE3)
    writer.set_compression(CompressionMode.FILE, CompressionFormat.ZSTD)
    with writer:
        topics = {topic: writer.add_connection(topic, kind, typestore=store) for topic, kind in (
            ("/ins/odometry", "nav_msgs/msg/Odometry"), ("/ins/imu", "sensor_msgs/msg/Imu"),
            ("/acme/wheel_report", "acme_vehicle_msgs/msg/WheelReport"),
            ("/acme/hand_wheel", "acme_vehicle_msgs/msg/HandWheel"),
            ("/acme/pedals", "acme_vehicle_msgs/msg/Pedals"))}

        def put(topic: str, at_ns: int, message: object) -> None:
            late_ns = LATE_NS["ins" if topic.startswith("/ins") else "can"]
            data = store.serialize_cdr(message, topics[topic].msgtype)
            writer.write(topics[topic], at_ns + late_ns, data)

        for time_s in np.arange(run.start_s, run.end_s, 0.02).tolist():
            at_ns = START_NS + round((time_s - run.start_s) * NS)
            now = {name: float(series.at([time_s])[0]) for name, series in run.channels.items()}
            for topic, message in _messages(made, now, at_ns).items():
                put(topic, at_ns, message)


def _messages(
    made: Mapping[str, Any], now: Mapping[str, float], at_ns: int
) -> dict[str, object]:
    """What this stack publishes at one instant."""
    header = made["std_msgs/msg/Header"](
        made["builtin_interfaces/msg/Time"](at_ns // NS, at_ns % NS), "ins")
    vector, no_noise = made["geometry_msgs/msg/Vector3"], np.zeros(9)
    half = 0.5 * now["tractor_yaw_rad"]
    turn = made["geometry_msgs/msg/Quaternion"](0.0, 0.0, math.sin(half), math.cos(half))
    place = made["geometry_msgs/msg/Point"](
        443_000.0 + now["tractor_x_m"], 4_177_000.0 + now["tractor_y_m"], 0.0)
    pose = made["geometry_msgs/msg/PoseWithCovariance"](
        made["geometry_msgs/msg/Pose"](place, turn), np.zeros(36))
    twist = made["geometry_msgs/msg/TwistWithCovariance"](made["geometry_msgs/msg/Twist"](
        vector(now["tractor_vx_mps"], now["tractor_vy_mps"], 0.0),
        vector(0.0, 0.0, now["tractor_yaw_rate_radps"])), np.zeros(36))
    rates = vector(now["tractor_roll_rate_radps"], now["tractor_pitch_rate_radps"],
                   now["tractor_yaw_rate_radps"])
    force = vector(now["tractor_ax_mps2"], now["tractor_ay_mps2"], now["tractor_az_mps2"])
    unknown = np.array([-1.0, *np.zeros(8)])
    hubs = np.array([now[f"hub_speed_steer_{side}_radps"] * 30.0 / math.pi
                     for side in ("left", "right")], dtype=np.float32)
    acme = "acme_vehicle_msgs/msg/"
    return {
        "/ins/odometry": made["nav_msgs/msg/Odometry"](header, "base_link", pose, twist),
        "/ins/imu": made["sensor_msgs/msg/Imu"](
            header, made["geometry_msgs/msg/Quaternion"](0.0, 0.0, 0.0, 1.0), unknown, rates,
            no_noise, force, no_noise),
        "/acme/wheel_report": made[acme + "WheelReport"](
            header, 3.6 * now["tractor_vx_mps"], hubs),
        "/acme/hand_wheel": made[acme + "HandWheel"](
            DEG * now["steering_wheel_angle_rad"], 0.0),
        "/acme/pedals": made[acme + "Pedals"](
            100.0 * now["throttle"], (now["brake_pressure_trailer_pa"] + 101_325.0) / 1e3),
    }


if __name__ == "__main__":
    main()
