# SPDX-License-Identifier: BSD-3-Clause
"""Direct point rendering as published, in double precision: slow and plain; nothing is shared with the mapper.

After H. Kawata, T. Kanai, Direct Point Rendering on GPU: from the nearest and the farthest points of an image buffer's
cells (section 3.2) to averages, normals (section 3.3) and splats (section 3.4). What the paper leaves open is taken as
vtkDirectPointMapper's documentation says: a splat is a square of three cells, its Gaussian has a deviation of half a
cell; points on a line, seen from the eye, give no plane, and the cell faces the viewer. Normals and depths are splatted,
and colours, which the caller may shade first, as the paper does.

Arrays are of (height, width) or (height, width, components); row 0 is at the bottom.
"""

from dataclasses import dataclass

import numpy as np

SPLAT_RADIUS = 1.5  # cells
COLLINEAR = 1e-3  # least share of the determinant of the points' scatter in its trace's square
NEAR = 1e-5  # of a threshold
NEAR_EDGE = 1e-4  # pixels from a splat's edge: single precision resolves no less across a viewport


@dataclass
class Points:
    """One point a cell: depth (0: none), displacement from the cell's centre in cells, colour (or None), id."""

    depth: np.ndarray
    displacement: np.ndarray
    colors: np.ndarray
    ids: np.ndarray


@dataclass
class Surface:
    """A surface buffer; depth 0: no surface. near_decision: pixels where rounding may have decided."""

    normals: np.ndarray
    depth: np.ndarray
    colors: np.ndarray
    ids: np.ndarray
    near_decision: np.ndarray


def select_points(eye, projection, size, gamma):
    """Passes 1 and 2: ids of the nearest and of the farthest point of each cell, -1 where there is none.

    eye: (n, 3), eye coordinates; projection: (4, 4), for column vectors; size: (width, height) in cells.
    """
    clip = np.c_[eye, np.ones(len(eye))] @ projection.T
    cell = np.floor((clip[:, :2] / clip[:, 3:] + 1) / 2 * size).astype(int)
    nearest, farthest = (np.full((size[1], size[0]), -1) for _ in range(2))
    inside = np.all((cell >= 0) & (cell < size) & (np.abs(clip[:, 2:3]) <= clip[:, 3:]), axis=1)
    depth = -eye[:, 2]
    for i in np.flatnonzero(inside):
        x, y = cell[i]
        if nearest[y, x] < 0 or depth[i] < depth[nearest[y, x]]:
            nearest[y, x] = i
    for i in np.flatnonzero(inside):
        x, y = cell[i]
        if depth[i] <= depth[nearest[y, x]] + gamma and (
            farthest[y, x] < 0 or depth[i] > depth[farthest[y, x]]
        ):
            farthest[y, x] = i
    return nearest, farthest


def reconstruct(nearest, farthest, projection, size, shade=lambda colors, normals, means: colors):
    """The surface buffer of size (width, height) from the Points of the two passes.

    shade: makes the colours that are splatted from those of the cells (or None), their normals and their means.
    """
    occupied = nearest.depth > 0
    cells = np.array(nearest.depth.shape[::-1])
    points = np.stack([_positions(p, projection, cells) for p in (nearest, farthest)])
    means = points.mean(axis=0)
    parallel = projection[3, 2] == 0
    normals = np.zeros_like(means)
    near_line = np.zeros(occupied.shape, bool)
    for y, x in np.argwhere(occupied):
        window = np.s_[max(y - 1, 0) : y + 2, max(x - 1, 0) : x + 2]
        samples = points[(slice(None), *window)][:, occupied[window]].reshape(-1, 3)
        normals[y, x], near_line[y, x] = _fit_normal(samples, means[y, x], parallel)
    colors = None if nearest.colors is None else (nearest.colors + farthest.colors) / 2
    colors = shade(colors, normals, means)
    return _draw_splats(means, normals, colors, nearest.ids, near_line, occupied, projection, size)


def _positions(points, projection, cells):
    """Eye coordinates of points that are given by their place in a cell and their depth."""
    height, width = points.depth.shape
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    place = np.stack([x, y], axis=-1) + points.displacement
    ndc = 2 * place / cells - 1
    z = -points.depth[..., None]
    # the rows of x and y: P[k, :2] . xy = ndc_k w - P[k, 2] z - P[k, 3]
    w = projection[3, 2] * z + projection[3, 3]
    right = ndc * w - projection[:2, 2] * z - projection[:2, 3]
    xy = np.linalg.solve(projection[:2, :2], right[..., None])[..., 0]
    return np.concatenate([xy, z], axis=-1)


def _fit_normal(samples, mean, parallel):
    """The normal of z = a x + b y + c, and whether it was a close decision that there is one."""
    centered = samples - samples.mean(axis=0)
    scatter = centered[:, :2].T @ centered[:, :2]
    share = np.linalg.det(scatter) / max(np.trace(scatter) ** 2, 1e-300)
    if share > COLLINEAR:
        slopes = np.linalg.lstsq(centered[:, :2], centered[:, 2], rcond=None)[0]
        normal = np.array([-slopes[0], -slopes[1], 1.0])
    else:
        normal = np.array([0.0, 0.0, 1.0]) if parallel else -mean
    towards = normal[2] if parallel else -normal @ mean
    # of a line of points rounding leaves any small share
    return normal / np.linalg.norm(normal) * (1 if towards >= 0 else -1), abs(share - COLLINEAR) < NEAR


def _draw_splats(means, normals, colors, ids, near_line, occupied, projection, size):
    width, height = size
    step = np.array(size) / occupied.shape[::-1]
    radius = SPLAT_RADIUS * step
    clip = np.concatenate([means, np.ones((*means.shape[:2], 1))], axis=-1) @ projection.T
    with np.errstate(invalid="ignore", divide="ignore"):
        places = (clip[..., :2] / clip[..., 3:] + 1) / 2 * size

    layers = 4 if colors is None else 8
    sums = np.zeros((height, width, layers + 1))
    largest = np.zeros((height, width))
    source = np.full((height, width), -1)
    near = np.zeros((height, width), bool)
    for y, x in np.argwhere(occupied):
        place = places[y, x]
        first = np.maximum(np.floor(place - radius - 1).astype(int), 0)
        last = np.minimum(np.ceil(place + radius + 1).astype(int), size)
        if np.any(last <= first):
            continue
        window = np.s_[first[1] : last[1], first[0] : last[0]]
        dx = np.abs(np.arange(first[0], last[0]) + 0.5 - place[0])[None, :]
        dy = np.abs(np.arange(first[1], last[1]) + 0.5 - place[1])[:, None]
        covers = (dx <= radius[0]) & (dy <= radius[1])
        near[window] |= (np.abs(dx - radius[0]) < NEAR_EDGE) & (dy < radius[1] + NEAR_EDGE)
        near[window] |= (np.abs(dy - radius[1]) < NEAR_EDGE) & (dx < radius[0] + NEAR_EDGE)
        near[window] |= covers & near_line[y, x]
        weight = np.where(covers, np.exp(-2 * ((dx / step[0]) ** 2 + (dy / step[1]) ** 2)), 0)
        values = [*normals[y, x], -means[y, x, 2], *([] if colors is None else colors[y, x]), 1]
        sums[window] += weight[..., None] * values
        near[window] |= (weight > 0) & (np.abs(weight - largest[window]) < NEAR * weight)
        wins = weight > largest[window]
        source[window] = np.where(wins, ids[y, x], source[window])
        largest[window] = np.maximum(weight, largest[window])
    weights = np.maximum(sums[..., -1:], 1e-300)
    length = np.linalg.norm(sums[..., :3], axis=-1, keepdims=True)
    near |= (length[..., 0] < 1e-3 * weights[..., 0]) & (largest > 0)
    return Surface(
        sums[..., :3] / np.maximum(length, 1e-300),
        (sums[..., 3:4] / weights)[..., 0],
        None if colors is None else sums[..., 4:8] / weights,
        source,
        near,
    )
