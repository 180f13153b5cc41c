# SPDX-License-Identifier: BSD-3-Clause
"""The yardstick itself beside analytic surfaces."""

import os
import sys

import numpy as np
import pytest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Reference"))
from ewa_splats import draw_ewa_splats  # noqa: E402

SIZE = (160, 120)
FOCAL_LENGTH = 200.0
LOOKING_ALONG_Z = np.eye(4)


def sphere_points(count, center):
    """Even points on a unit sphere, by the golden angle, and their normals."""
    i = np.arange(count) + 0.5
    z, angle = 1 - 2 * i / count, i * np.pi * (3 - np.sqrt(5))
    ring = np.sqrt(1 - z**2)
    normals = np.stack([ring * np.cos(angle), ring * np.sin(angle), z], axis=1)
    return normals + center, normals


def true_sphere(center):
    """The rays' discriminant, and the normals and depth where it is positive."""
    width, height = SIZE
    x, y = np.meshgrid(np.arange(width) + 0.5 - width / 2, np.arange(height) + 0.5 - height / 2)
    rays = np.stack([x / FOCAL_LENGTH, y / FOCAL_LENGTH, -np.ones_like(x)], axis=-1)
    a, b = np.sum(rays**2, axis=-1), rays @ center
    discriminant = b**2 - a * (center @ center - 1)
    depth = (b - np.sqrt(np.maximum(discriminant, 0))) / a
    return discriminant, rays * depth[..., None] - center, depth


def test_sphere():
    center = np.array([0.1, -0.2, -5.0])
    count = 20000
    points, normals = sphere_points(count, center)
    spacing = np.sqrt(4 * np.pi / count)
    drawn_normals, depth = draw_ewa_splats(
        points, normals, np.full(count, 1.5 * spacing), LOOKING_ALONG_Z, FOCAL_LENGTH, SIZE
    )
    discriminant, true_normals, true_depth = true_sphere(center)
    inside = discriminant > 0
    assert np.array_equal(drawn_normals.any(axis=-1), depth > 0)
    assert np.all(depth[inside] > 0)
    # A disc stands out from the sphere by at most r^2/2, and by a low-pass filter of a third of a pixel.
    assert np.count_nonzero((depth > 0) & ~inside) < 0.03 * np.count_nonzero(inside)

    hits = true_normals + center
    facing = inside & (np.sum(true_normals * hits, axis=-1) < -0.5 * np.linalg.norm(hits, axis=-1))
    angles = np.degrees(np.arccos(np.clip(np.sum(drawn_normals * true_normals, axis=-1)[facing], -1, 1)))
    assert angles.mean() < 0.2
    assert np.abs(depth - true_depth)[facing].max() < (1.5 * spacing) ** 2


def test_the_nearer_of_two_spheres_hides_the_other():
    near, far = np.array([0, 0, -5.0]), np.array([0, 0, -9.0])
    (near_points, near_normals), (far_points, far_normals) = (sphere_points(5000, center) for center in (near, far))
    radii = np.full(10000, 0.1)
    _, both = draw_ewa_splats(
        np.concatenate([far_points, near_points]),
        np.concatenate([far_normals, near_normals]),
        radii,
        LOOKING_ALONG_Z,
        FOCAL_LENGTH,
        SIZE,
    )
    _, alone = draw_ewa_splats(near_points, near_normals, radii[:5000], LOOKING_ALONG_Z, FOCAL_LENGTH, SIZE)
    assert np.count_nonzero(alone) > 4000
    assert np.allclose(both, alone)


def test_a_point_covers_the_pixel_that_it_falls_in():
    depth = 4.0
    x, y = 37, 81
    point = np.array([(x + 0.5 - 80) / FOCAL_LENGTH * depth, (y + 0.5 - 60) / FOCAL_LENGTH * depth, -depth])
    normals, drawn = draw_ewa_splats(point[None], [[0, 0, 1.0]], [1e-6], LOOKING_ALONG_Z, FOCAL_LENGTH, SIZE)
    assert np.argwhere(drawn).tolist() == [[y, x]]
    assert drawn[y, x] == pytest.approx(depth, abs=1e-5)
    assert normals[y, x] == pytest.approx([0, 0, 1])
    facing_away = draw_ewa_splats(point[None], [[0, 0, -1.0]], [1e-6], LOOKING_ALONG_Z, FOCAL_LENGTH, SIZE)
    assert not np.any(facing_away[1])


def test_a_tilted_disc_is_an_ellipse_in_its_plane():
    radius, depth, tilt = 0.5, 5.0, np.radians(60)
    normal = np.array([np.sin(tilt), 0, np.cos(tilt)])
    turn = np.array([[0.0, 0, -1, 3], [0, 1, 0, 0], [1, 0, 0, 0], [0, 0, 0, 1]])  # from the world to the eye
    center = np.array([0, 0, -depth])
    world_center = turn[:3, :3].T @ (center - turn[:3, 3])
    _, drawn = draw_ewa_splats(
        world_center[None], (turn[:3, :3].T @ normal)[None], [radius], turn, FOCAL_LENGTH, SIZE
    )
    rows, columns = np.nonzero(drawn)
    pixels = radius * FOCAL_LENGTH / depth
    assert np.ptp(rows) + 1 == pytest.approx(2 * pixels, abs=1)
    assert np.ptp(columns) + 1 == pytest.approx(2 * pixels * np.cos(tilt), abs=1)
    assert len(rows) == pytest.approx(np.pi * pixels**2 * np.cos(tilt), rel=0.04)
    x, y = (columns + 0.5 - 80) / FOCAL_LENGTH, (rows + 0.5 - 60) / FOCAL_LENGTH
    on_plane = (normal @ center) / (np.stack([x, y, -np.ones_like(x)], axis=1) @ normal)
    assert np.allclose(drawn[rows, columns], on_plane)
