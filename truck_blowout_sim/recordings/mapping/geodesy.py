"""Latitude and longitude as east and north of a first fix, in the tangent plane of the earth.

    e^2 = f (2 - f),  N = a / sqrt(1 - e^2 sin^2 lat)
    X = (N + h) cos lat cos lon,  Y = (N + h) cos lat sin lon,  Z = (N (1 - e^2) + h) sin lat
    east  = -sin lon0 dX + cos lon0 dY
    north = -sin lat0 cos lon0 dX - sin lat0 sin lon0 dY + cos lat0 dZ

References: NIMA TR 8350.2 (WGS 84: a, f); Farrell and Barth, The Global Positioning System and
Inertial Navigation (1999), section 2.2 (earth-centered coordinates, local tangent plane).
Known limits: one height for the whole drive; without a recorded height that of the ellipsoid, which
makes distances 0.016 % too short per kilometer above it. Grid north of UTM is another direction.
Validated with: test/recordings/test_geodesy.py.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

SEMI_MAJOR_M = 6378137.0
FLATTENING = 1.0 / 298.257223563
_ECCENTRICITY_2 = FLATTENING * (2.0 - FLATTENING)


def east_north_m(
    latitude_rad: FloatArray, longitude_rad: FloatArray, height_m: float,
    origin: tuple[float, float],
) -> tuple[FloatArray, FloatArray]:  # fmt: skip
    """Places in the tangent plane of an origin.

    Args:
        latitude_rad, longitude_rad: geodetic, WGS 84, shape (n,).
        height_m: above the ellipsoid, of all places and the origin.
        origin: latitude and longitude at which the plane touches, rad.

    Returns:
        East and north of the origin, m.
    """
    lat0, lon0 = origin
    at = _earth_centered_m(latitude_rad, longitude_rad, height_m)
    zero = _earth_centered_m(np.array([lat0]), np.array([lon0]), height_m)
    dx, dy, dz = at - zero
    east = -np.sin(lon0) * dx + np.cos(lon0) * dy
    outward = np.cos(lon0) * dx + np.sin(lon0) * dy
    return east, np.cos(lat0) * dz - np.sin(lat0) * outward


def _earth_centered_m(latitude: FloatArray, longitude: FloatArray, height_m: float) -> FloatArray:
    sine, cosine = np.sin(latitude), np.cos(latitude)
    normal = SEMI_MAJOR_M / np.sqrt(1.0 - _ECCENTRICITY_2 * sine**2)
    around = (normal + height_m) * cosine
    up = (normal * (1.0 - _ECCENTRICITY_2) + height_m) * sine
    return np.stack((around * np.cos(longitude), around * np.sin(longitude), up))
