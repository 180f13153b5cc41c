# SPDX-License-Identifier: BSD-3-Clause
"""Algebraic splats drawn ray by ray in double precision, as Bolla and Narayanan have them: the reference of
vtkAlgebraicSplatMapper. Roots are eigenvalues of companion matrices; nothing is shared with the mapper."""
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy


def _matrix(m):
    return np.array([[m.GetElement(i, j) for j in range(4)] for i in range(4)])


def _terms(u, v, order):
    return np.stack([u ** (d - b) * v ** b for d in range(order + 1) for b in range(d + 1)], axis=-1)


def _slopes(u, v, order):
    du, dv = [], []
    for d in range(order + 1):
        for b in range(d + 1):
            a = d - b
            du.append(a * u ** max(a - 1, 0) * v ** b)
            dv.append(b * u ** a * v ** max(b - 1, 0))
    return np.stack(du, axis=-1), np.stack(dv, axis=-1)


def _first_roots(values, order):
    """The least real root in [0, 1] of polynomials that are given at `order` + 1 nodes; NaN where there is none.
    Also whether a root is nearly double or nearly at an end, where rounding decides."""
    nodes = 0.5 - 0.5 * np.cos(np.pi * np.arange(order + 1) / order)
    coefficients = np.linalg.solve(np.vander(nodes), values.T).T  # from the highest power on
    largest = np.abs(coefficients).max(axis=1, keepdims=True) + 1e-300
    coefficients = coefficients / largest
    lead = coefficients[:, :1]
    lead = np.where(np.abs(lead) < 1e-13, 1e-13, lead)
    companion = np.zeros((len(values), order, order))
    companion[:, 0, :] = -coefficients[:, 1:] / lead
    companion[:, np.arange(1, order), np.arange(order - 1)] = 1.0
    roots = np.linalg.eigvals(companion)
    inside = (roots.real >= 0) & (roots.real <= 1)
    real = np.abs(roots.imag) < 1e-9
    first = np.where(inside & real, roots.real, np.inf).min(axis=1)
    near_end = np.minimum(np.abs(roots.real), np.abs(roots.real - 1)) < 1e-5
    double = np.zeros(len(values), bool)
    for i in range(order):
        for k in range(i):
            double |= np.abs(roots[:, i] - roots[:, k]) < 3e-3
    close = (near_end & (np.abs(roots.imag) < 1e-3)).any(axis=1) | double
    return np.where(np.isfinite(first), first, np.nan), close


def draw(splats, renderer, size, depth_shift, weight_falloff, separate_sides):
    """A dictionary of images, the lower left pixel first: depth (0 where there is no surface), normal (eye space),
    shade (by a headlight, each splat's own and then blended, as the paper has it), id (of the heaviest splat, -1 where
    there is none), close (a decision that rounding may turn)."""
    width, height = size
    data = splats.GetPointData()
    array = lambda name: vtk_to_numpy(data.GetArray(name)).astype(float)
    centers = vtk_to_numpy(splats.GetPoints().GetData()).astype(float)
    normals, axes, radii = array("Normals"), array("SplatAxes"), array("radius")
    coefficients, orders = array("SplatCoefficients"), array("SplatOrder").astype(int)
    camera = renderer.GetActiveCamera()
    view = _matrix(camera.GetViewTransformMatrix())
    projection = _matrix(camera.GetProjectionTransformMatrix(width / height, -1, 1))

    y, x = np.mgrid[0:height, 0:width]
    ndc = np.stack([(2 * x + 1) / width - 1, (2 * y + 1) / height - 1], axis=-1).reshape(-1, 2)

    def unproject(z):
        p = np.concatenate([ndc, np.full((len(ndc), 1), z), np.ones((len(ndc), 1))], axis=1)
        p = p @ np.linalg.inv(projection).T
        return p[:, :3] / p[:, 3:]

    near, far = unproject(-1.0), unproject(1.0)  # eye space: what is outside is clipped

    hits = []
    for i in range(len(centers)):
        n = normals[i] / np.linalg.norm(normals[i])
        v = np.cross(n, axes[i])
        v /= np.linalg.norm(v)
        frame = np.stack([np.cross(v, n), v, n])
        to_eye = view[:3, :3] @ frame.T * radii[i]
        center = (view @ np.append(centers[i], 1.0))[:3]
        inverse = np.linalg.inv(to_eye)
        # pixels around a ball that the patch lies in
        reach = radii[i] * (1 + np.abs(coefficients[i]).sum())
        corners = center + reach * np.array([[a, b, c] for a in (-1, 1) for b in (-1, 1) for c in (-1, 1)])
        clip = np.concatenate([corners, np.ones((8, 1))], axis=1) @ projection.T
        pixels = np.arange(len(ndc))
        if (clip[:, 3] > 0).all():
            window = clip[:, :2] / clip[:, 3:]
            low, high = window.min(axis=0), window.max(axis=0)
            pixels = np.nonzero(((ndc >= low) & (ndc <= high)).all(axis=1))[0]
        if len(pixels) == 0:
            continue
        start = (near[pixels] - center) @ inverse.T
        step = (far[pixels] - near[pixels]) @ inverse.T
        # where the ray lies over the disc
        a = (step[:, :2] ** 2).sum(axis=1)
        b = (start[:, :2] * step[:, :2]).sum(axis=1)
        c = (start[:, :2] ** 2).sum(axis=1) - 1
        square = b * b - a * c
        over = square > 0
        pixels, start, step = pixels[over], start[over], step[over]
        a, b, root = a[over], b[over], np.sqrt(square[over])
        begin, end = np.maximum((-b - root) / a, 0), np.minimum((-b + root) / a, 1)
        over = begin < end
        pixels, start, step, begin, end = (q[over] for q in (pixels, start, step, begin, end))
        if len(pixels) == 0:
            continue
        # many rays look along the disc's axis for long; only where the patch can be is of interest
        order = orders[i]
        g = coefficients[i][: (order + 1) * (order + 2) // 2]
        bound = np.abs(g).sum() + 1e-3
        with np.errstate(divide="ignore", invalid="ignore"):
            ends = np.sort(np.stack([(bound - start[:, 2]) / step[:, 2], (-bound - start[:, 2]) / step[:, 2]]), axis=0)
        ends = np.where(step[:, 2] == 0, np.array([[-np.inf], [np.inf]]), ends)
        begin, end = np.maximum(begin, ends[0]), np.minimum(end, ends[1])
        over = begin < end
        pixels, start, step, begin, end = (q[over] for q in (pixels, start, step, begin, end))
        if len(pixels) == 0:
            continue
        nodes = 0.5 - 0.5 * np.cos(np.pi * np.arange(order + 1) / order)
        t = begin[:, None] + nodes * (end - begin)[:, None]
        p = start[:, None, :] + t[..., None] * step[:, None, :]
        s, close = _first_roots(_terms(p[..., 0], p[..., 1], order) @ g - p[..., 2], order)
        for k in pixels[close]:
            hits.append((k, np.nan, 0.0, None, i, True))
        found = np.isfinite(s)
        pixels, t = pixels[found], (begin + s * (end - begin))[found]
        p = start[found] + t[:, None] * step[found]
        du, dv = _slopes(p[:, 0], p[:, 1], order)
        normal = np.stack([-du @ g, -dv @ g, np.ones(len(t))], axis=1) @ inverse
        normal /= np.linalg.norm(normal, axis=1, keepdims=True)
        ray = (far - near)[pixels]
        facing = (normal * ray).sum(axis=1) / np.linalg.norm(ray, axis=1)
        depth = -(near[pixels] + t[:, None] * ray)[:, 2]
        weight = np.exp(-weight_falloff * (p[:, :2] ** 2).sum(axis=1))
        for k in range(len(pixels)):
            hits.append((pixels[k], depth[k], weight[k], normal[k], i, facing[k]))

    count = width * height
    close = np.zeros(count, bool)
    nearest = np.full((2, count), np.inf)  # of backs, of fronts
    for pixel, depth, _, normal, _, facing in hits:
        if normal is None:
            close[pixel] = True
            continue
        side = int(facing < 0 or not separate_sides)
        nearest[side, pixel] = min(nearest[side, pixel], depth)
        close[pixel] |= separate_sides and abs(facing) < 1e-5
    both = np.isfinite(nearest).all(axis=0)
    with np.errstate(invalid="ignore"):
        close |= both & (np.abs(nearest[0] / nearest[1] - 1) < 1e-5)
    front = nearest[1] <= nearest[0]
    visible = np.where(front, nearest[1], nearest[0]) * (1 + depth_shift)
    sums = np.zeros((count, 6))
    heaviest = np.zeros((count, 2))  # the two largest weights
    ids = np.full(count, -1)
    for pixel, depth, weight, normal, i, facing in hits:
        if normal is None or (separate_sides and (facing < 0) != front[pixel]):
            continue
        close[pixel] |= abs(depth / visible[pixel] - 1) < 1e-5
        if depth > visible[pixel]:
            continue
        sums[pixel, :3] += weight * normal
        sums[pixel, 3] += weight * depth
        sums[pixel, 4] += weight
        sums[pixel, 5] += weight * abs(normal[2])
        if weight > heaviest[pixel, 0]:
            heaviest[pixel] = weight, heaviest[pixel, 0]
            ids[pixel] = i
        elif weight > heaviest[pixel, 1]:
            heaviest[pixel, 1] = weight
    covered = sums[:, 4] > 0
    close |= covered & (heaviest[:, 0] - heaviest[:, 1] < 1e-5)
    normal = sums[:, :3] / (np.linalg.norm(sums[:, :3], axis=1, keepdims=True) + 1e-300)
    depth, shade = (np.where(covered, sums[:, k] / np.where(covered, sums[:, 4], 1), 0) for k in (3, 5))
    return {"depth": depth, "normal": normal, "shade": shade, "id": ids, "close": close}
