"""Hand-wheel angle from road-wheel angle: the vehicle's steering gear turned around.

References: road = gear (1 + curve gear^2), gear = (hand - offset) / ratio, as in
`physics/steering.py`.
Known limits: free play, compliance and lag stay the model's: in a turn under load the road wheels
reach a little less than was asked for, as on the truck.
"""

from __future__ import annotations

from truck_blowout_sim.vehicle import Vehicle

_ITERATIONS = 20


def hand_wheel_rad(vehicle: Vehicle, road_wheel_rad: float) -> float:
    """Hand-wheel angle that asks for a mean road-wheel angle; both rad, left positive."""
    steering = vehicle.spec.steering
    if steering is None:
        return road_wheel_rad
    return steering.offset_rad + steering.ratio * _gear(road_wheel_rad, steering.ratio_curve_prad2)


def _gear(road_rad: float, curve_prad2: float) -> float:
    """Root of gear (1 + curve gear^2) = road by Newton's method, from the straight gear."""
    gear = road_rad
    for _ in range(_ITERATIONS if curve_prad2 else 0):
        slope = 1.0 + 3.0 * curve_prad2 * gear * gear
        if slope <= 0.1:  # a gear that bends back has no answer beyond here
            break
        gear -= (gear * (1.0 + curve_prad2 * gear * gear) - road_rad) / slope
    return gear
