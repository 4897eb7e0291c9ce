"""Latitude and longitude in the plane that touches the earth at the first fix."""

from __future__ import annotations

import math

import numpy as np
import pytest

from truck_blowout_sim.recordings.mapping.geodesy import FLATTENING, SEMI_MAJOR_M, east_north_m

E2 = FLATTENING * (2.0 - FLATTENING)


def radii_m(latitude_rad: float) -> tuple[float, float]:
    """Curvature radii of the meridian and of the prime vertical, the other textbook form."""
    w = math.sqrt(1.0 - E2 * math.sin(latitude_rad) ** 2)
    return SEMI_MAJOR_M * (1.0 - E2) / w**3, SEMI_MAJOR_M / w


@pytest.mark.parametrize("latitude_deg", [-89.0, -33.9, 0.0, 48.1, 89.0])
@pytest.mark.parametrize("longitude_deg", [-179.99, 0.0, 11.5])
def test_short_distances_are_those_of_the_curvature_radii(latitude_deg: float,
                                                          longitude_deg: float) -> None:
    lat, lon = math.radians(latitude_deg), math.radians(longitude_deg)
    meridian, normal = radii_m(lat)
    d = 1e-6
    east, north = east_north_m(np.array([lat + d, lat]), np.array([lon, lon + d]), 0.0, (lat, lon))
    assert north[0] == pytest.approx(meridian * d, rel=1e-5)
    assert east[1] == pytest.approx(normal * math.cos(lat) * d, rel=1e-5)
    assert abs(east[0]) < 1e-4
    assert abs(north[1]) < 1e-3


def test_one_degree_along_the_equator_and_the_meridian() -> None:
    """111.3195 km and 110.574 km are the lengths of the arcs; the plane shows their sines."""
    one = np.array([math.radians(1.0)])
    east, _ = east_north_m(np.zeros(1), one, 0.0, (0.0, 0.0))
    _, north = east_north_m(one, np.zeros(1), 0.0, (0.0, 0.0))
    assert east[0] == pytest.approx(SEMI_MAJOR_M * math.sin(one[0]), rel=1e-9)
    assert north[0] == pytest.approx(110_574.0, rel=2e-4)


def test_height_stretches_the_plane() -> None:
    lat, lon = np.array([0.84, 0.84001]), np.array([0.2, 0.2])
    low, high = (east_north_m(lat, lon, h, (0.84, 0.2))[1][1] for h in (0.0, 1600.0))
    assert high / low - 1.0 == pytest.approx(1600.0 / 6.37e6, rel=0.01)


def test_the_date_line_is_no_jump() -> None:
    lon = np.array([math.pi - 1e-6, -math.pi + 1e-6])
    east, _ = east_north_m(np.zeros(2), lon, 0.0, (0.0, float(lon[0])))
    assert east[1] == pytest.approx(2e-6 * SEMI_MAJOR_M, rel=1e-6)
