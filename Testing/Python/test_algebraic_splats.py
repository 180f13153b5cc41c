# SPDX-License-Identifier: BSD-3-Clause
"""vtkAlgebraicSplats, vtkLocallyOptimalProjection and vtkAlgebraicSplatMapper. Truth: surfaces with a formula, sums in
plain numpy, and the double-precision ray tracer of Testing/Reference."""
import math
import os
import sys
from decimal import Decimal, getcontext

import numpy as np
import pytest
from pointsurface import rendering, vtkAlgebraicSplatMapper, vtkAlgebraicSplats, vtkLocallyOptimalProjection
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints, vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter
from vtkmodules.vtkRenderingCore import vtkActor, vtkHardwareSelector, vtkRenderer

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Reference"))
import algebraic_splats as reference  # noqa: E402


def cloud(positions, normals=None, **arrays):
    poly = vtkPolyData()
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(positions, float), deep=True))
    poly.SetPoints(points)
    if normals is not None:
        poly.GetPointData().SetNormals(numpy_to_vtk(np.ascontiguousarray(normals, np.float32), deep=True))
    for name, values in arrays.items():
        array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
        array.SetName(name)
        poly.GetPointData().AddArray(array)
    return poly


def sphere(count):
    i = np.arange(count)
    z = 1 - (2 * i + 1) / count
    r, a = np.sqrt(1 - z * z), np.pi * (1 + 5 ** 0.5) * i
    x = np.stack([r * np.cos(a), r * np.sin(a), z], axis=1)
    return cloud(x, x)


def fit(poly, **properties):
    splats = vtkAlgebraicSplats()
    splats.SetInputData(poly)
    for name, value in properties.items():
        getattr(splats, "Set" + name)(value)
    splats.Update()
    return splats


def array(poly, name):
    return vtk_to_numpy(poly.GetPointData().GetArray(name))


def positions(poly):
    return vtk_to_numpy(poly.GetPoints().GetData())


def drawn(splats, size=(96, 96), **properties):
    mapper, actor, renderer = vtkAlgebraicSplatMapper(), vtkActor(), vtkRenderer()
    mapper.SetInputData(splats)
    mapper.ScalarVisibilityOff()
    mapper.RecordPointIdsOn()
    for name, value in properties.items():
        getattr(mapper, "Set" + name)(value)
    actor.SetMapper(mapper)
    renderer.AddActor(actor)
    window = rendering.offscreen_window(renderer, size)
    renderer.ResetCamera()
    return mapper, renderer, window


def surface_buffer(mapper):
    buffer = vtkImageData()
    assert mapper.ReadSurfaceBuffer(buffer)
    return lambda name: array(buffer, name)


def patch_points(splats, i, uv):
    """Points of a splat's patch at (u, v) in units of its disc."""
    n, u = array(splats, "Normals")[i].astype(float), array(splats, "SplatAxes")[i].astype(float)
    order, radius = array(splats, "SplatOrder")[i], float(array(splats, "radius")[i])
    c = array(splats, "SplatCoefficients")[i].astype(float)
    terms = [uv[:, 0] ** (d - b) * uv[:, 1] ** b for d in range(order + 1) for b in range(d + 1)]
    height = sum(k * t for k, t in zip(c, terms))
    return positions(splats)[i] + radius * (
        np.outer(uv[:, 0], u) + np.outer(uv[:, 1], np.cross(n, u)) + np.outer(height, n))


def symmetric_points(fold, count=63, seed=5):
    """The origin, and points that a turn by 1 / fold of a circle maps to each other."""
    random = np.random.default_rng(seed)
    radius, angle = np.sqrt(random.uniform(0.01, 1, count // fold)), random.uniform(0, 2 * np.pi, count // fold)
    turned = (angle + 2 * np.pi / fold * np.arange(fold)[:, None]).ravel()
    xy = np.tile(radius, fold)[:, None] * np.column_stack([np.cos(turned), np.sin(turned)])
    return np.vstack([[[0, 0]], xy])


# Whose plane at the origin is level by symmetry, so that they are polynomials over it: even ones over points that half a
# turn keeps, and those that a third of a turn keeps over points that it keeps.
POLYNOMIALS = {
    1: (3, lambda x, y: 0.3 * x - 0.2 * y + 0.1),
    2: (2, lambda x, y: 0.2 - 0.3 * x * x + 0.1 * x * y + 0.2 * y * y),
    3: (3, lambda x, y: 0.1 * (x * x + y * y) + 0.2 * (x ** 3 - 3 * x * y * y) - 0.1 * (3 * x * x * y - y ** 3)),
    4: (2, lambda x, y: 0.2 * x * x - 0.1 * x * y + 0.2 * x ** 4 - 0.1 * x ** 3 * y + 0.3 * x * x * y * y + 0.1 * y ** 4),
}


@pytest.mark.parametrize("order", POLYNOMIALS)
def test_recovers_polynomials(order):
    """A plane, a quadric, a cubic and a quartic come back from points of their own; a lower order cannot follow them."""
    fold, height = POLYNOMIALS[order]
    xy = symmetric_points(fold)
    poly = cloud(np.column_stack([xy, height(*xy.T)]), np.tile([0, 0, 1.0], (len(xy), 1)))
    uv = np.random.default_rng(6).uniform(-0.7, 0.7, (50, 2))

    def worst(fitted):
        splats = fit(poly, Order=fitted, NumberOfNeighbors=len(xy), Selection=0, ExtrapolationLimit=0).GetOutput()
        assert array(splats, "SplatOrder")[0] == fitted
        p = patch_points(splats, 0, uv)
        return np.abs(p[:, 2] - height(*p.T[:2])).max()

    print("order", order, "error", worst(order), "of the order below", worst(order - 1) if order > 1 else "")
    assert worst(order) < 1e-6
    assert order == 1 or worst(order - 1) > 1e-2


def test_error_falls_with_the_order():
    """The error of a patch over a disc of the size h is of the order h^(m + 1) (section 2.4)."""
    height = lambda x, y: 0.3 * np.sin(2 * x + 1) * np.cos(1.5 * y + 0.5)
    uv = np.random.default_rng(0).uniform(-0.7, 0.7, (20, 2))
    random = np.random.default_rng(1)
    for order in (1, 2, 3, 4):
        errors, sizes = [], []
        for side in (30, 90):
            grid = np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2)
            xy = (grid + random.uniform(0.2, 0.8, grid.shape)) / side * 2 - 1
            poly = cloud(np.column_stack([xy, height(*xy.T)]), np.tile([0, 0, 1.0], (len(xy), 1)))
            splats = fit(poly, Order=order, NumberOfNeighbors=40, ExtrapolationLimit=0).GetOutput()
            inner = np.nonzero((np.abs(positions(splats)[:, :2]) < 0.6).all(axis=1))[0]
            off = []
            for i in inner[:: max(1, len(inner) // 40)]:
                p = patch_points(splats, i, uv)
                off.append(np.abs(p[:, 2] - height(*p.T[:2])).mean())
            errors.append(np.mean(off))
            sizes.append(array(splats, "FeatureSize")[inner].mean())
        slope = np.log(errors[0] / errors[1]) / np.log(sizes[0] / sizes[1])
        print("order", order, "errors", errors, "slope", slope)
        assert abs(slope - (order + 1)) < 0.4


def solve(matrix, right):
    """The solution of linear equations in decimals, by Gauss, with pivots."""
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    count = len(rows)
    for k in range(count):
        pivot = max(range(k, count), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, count):
            factor = rows[i][k] / rows[k][k]
            rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k])]
    x = [Decimal(0)] * count
    for k in reversed(range(count)):
        x[k] = (rows[k][count] - sum(rows[k][i] * x[i] for i in range(k + 1, count))) / rows[k][k]
    return x


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def least_direction(points, weights, normal):
    """The direction in which weighted points vary least, near to `normal`, and their mean, by inverse iteration."""
    total = sum(weights)
    mean = [sum(w * p[k] for w, p in zip(weights, points)) / total for k in range(3)]
    d = [[p[k] - mean[k] for k in range(3)] for p in points]
    covariance = [[sum(w * q[i] * q[k] for w, q in zip(weights, d)) / total for k in range(3)] for i in range(3)]
    for _ in range(60):
        following = solve(covariance, normal)
        size = dot(following, following).sqrt()
        following = [x / size for x in following]
        change = max(abs(a - b) for a, b in zip(following, normal))
        normal = following
        if change < Decimal("1e-30"):
            break
    return normal, mean


def test_fit_is_weighted_least_squares():
    """Of single splats, against the paper's two minimisations in forty decimals, by normal equations."""
    getcontext().prec = 40
    random = np.random.default_rng(3)
    x = random.uniform(-1, 1, (600, 2))
    z = 0.3 * np.sin(2 * x[:, 0]) * np.cos(1.5 * x[:, 1]) + 0.01 * random.standard_normal(600)
    poly = cloud(np.column_stack([x, z]), np.tile([0, 0, 1.0], (600, 1)))
    k = 40
    fitted = {order: fit(poly, Order=order, NumberOfNeighbors=k, Selection=0, ExtrapolationLimit=0).GetOutput()
              for order in (1, 2, 3, 4)}
    for i in (0, 194, 388):
        d = positions(poly) - positions(poly)[i]
        near = np.argsort((d * d).sum(axis=1))[:k]
        center = [Decimal(float(c)) for c in positions(poly)[i]]
        p = [[Decimal(float(c)) - c0 for c, c0 in zip(positions(poly)[j], center)] for j in near]

        def feature_size(normal):
            return sum((dot(q, q) - dot(q, normal) ** 2).sqrt() for q in p) / k

        # the plane: weights about the projection of the point onto the plane
        n, mean = least_direction(p, [Decimal(1)] * k, [Decimal(0), Decimal(0), Decimal(1)])
        h, offset = feature_size(n), dot(n, mean)
        for _ in range(60):
            away = [[c - offset * m for c, m in zip(q, n)] for q in p]
            following, mean = least_direction(p, [(-dot(q, q) / h ** 2).exp() for q in away], n)
            change = max(abs(a - b) for a, b in zip(following, n))
            n, offset = following, dot(following, mean)
            if change < Decimal("1e-14"):
                break
        h = feature_size(n)
        weights = [(-dot(q, q) / h ** 2).exp() for q in p]
        for order, splats in fitted.items():
            assert np.allclose([float(c) for c in n], array(splats, "Normals")[i], atol=2e-7)
            assert np.allclose([float(c + offset * m) for c, m in zip(center, n)], positions(splats)[i], atol=1e-9)
            assert float(h) == pytest.approx(array(splats, "FeatureSize")[i], rel=2e-7)
            radius = Decimal(float(splats.GetPointData().GetArray("radius").GetValue(i)))
            u = [Decimal(float(c)) for c in array(splats, "SplatAxes")[i]]
            v = [n[1] * u[2] - n[2] * u[1], n[2] * u[0] - n[0] * u[2], n[0] * u[1] - n[1] * u[0]]
            terms = []
            for q in p:
                a, b = dot(q, u) / radius, dot(q, v) / radius
                powers = [[math.prod([c] * e, start=Decimal(1)) for e in range(order + 1)] for c in (a, b)]
                terms.append([powers[0][m - j] * powers[1][j] for m in range(order + 1) for j in range(m + 1)])
            count = len(terms[0])
            matrix = [[sum(w * t[r] * t[s] for w, t in zip(weights, terms)) for s in range(count)] for r in range(count)]
            right = [sum(w * t[r] * (dot(q, n) - offset) / radius for w, t, q in zip(weights, terms, p))
                     for r in range(count)]
            c = np.array([float(value) for value in solve(matrix, right)])
            # u has come in single precision
            assert np.allclose(c, array(splats, "SplatCoefficients")[i], atol=2e-6 * max(1, np.abs(c).max()))
            off = [dot(q, n) - offset - radius * sum(Decimal(k) * x for k, x in zip(c, t)) for q, t in zip(p, terms)]
            residual = (sum(w * d * d for w, d in zip(weights, off)) / sum(weights)).sqrt()
            assert float(residual) == pytest.approx(array(splats, "Residual")[i], rel=1e-5)


def test_splats_reach_less_far_over_borders():
    """Those of a square's rim are smaller than those amid it and moved inwards, and still leave no point without one."""
    xy = np.random.default_rng(2).uniform(-1, 1, (6000, 2))
    poly = cloud(np.column_stack([xy, 0.2 * xy[:, 0] ** 2]), np.tile([0, 0, 1.0], (6000, 1)))

    def overhang(limit):
        splats = fit(poly, ExtrapolationLimit=limit).GetOutput()
        centers, radii = positions(splats), array(splats, "radius")
        near = np.linalg.norm(positions(poly)[::5, None] - centers[None], axis=2) <= radii
        assert near.any(axis=1).all()
        return (np.abs(centers[:, :2]).max(axis=1) + radii - 1).max()

    print("overhang", overhang(5.0), "without a limit", overhang(0.0))
    assert overhang(5.0) < 0.45 * overhang(0.0)


@pytest.mark.parametrize("selection", (1, 2))
def test_lone_wrong_normals_leave_no_hole(selection, capfd):
    """A point whose normal all others contradict has neighbours all the same, and gets their side."""
    count = 3000
    poly = sphere(count)
    normals = positions(poly).copy()
    wrong = np.arange(0, count, 50)
    normals[wrong] *= -1
    poly = cloud(positions(poly), normals)
    splats = fit(poly, Selection=selection, NumberOfSplats=300).GetOutput()
    sizes = array(splats, "FeatureSize")
    assert "lower order" not in capfd.readouterr().err
    assert sizes.min() > 0.5 * np.median(sizes)
    chosen = array(splats, "InputPointIds")
    assert np.isin(chosen, wrong).sum() > 5  # else nothing is tested
    assert (array(splats, "Normals") * positions(splats)).sum(axis=1).min() > 0.9


def test_few_neighbours_on_one_side_leave_no_holes():
    """A sheet just above one that is denser: of a point's neighbours one in seven is on its side, and farther away."""

    def even(rows, z, random):
        xy = np.stack(np.meshgrid(np.arange(rows), np.arange(rows)), axis=-1).reshape(-1, 2)
        xy = 2 * (xy + random.uniform(0.1, 0.9, xy.shape)) / rows - 1
        return np.column_stack([xy, np.full(len(xy), z)])

    random = np.random.default_rng(0)
    upper, lower = even(40, 1e-3, random), even(98, 0, random)
    sides = np.repeat([1.0, -1.0], [len(upper), len(lower)])
    points = np.concatenate([upper, lower])
    splats = fit(cloud(points, np.outer(sides, [0, 0, 1])), Order=1).GetOutput()
    is_upper = array(splats, "Normals")[:, 2] > 0
    centers, radii = positions(splats)[is_upper, :2], array(splats, "radius")[is_upper]
    line = np.linspace(-0.9, 0.9, 300)
    bare = [(np.hypot(line[:, None] - centers[:, 0], y - centers[:, 1]) > radii).all(axis=1).mean() for y in line]
    print(f"{100 * np.mean(bare):.3f}% of the upper sheet without a splat")
    assert np.mean(bare) < 0.001


def test_hole_free_selection_covers_every_point():
    poly = sphere(20000)
    for quality in (0.5, 1.0):
        splats = fit(poly, Quality=quality).GetOutput()
        share = splats.GetNumberOfPoints() / 20000
        print("quality", quality, "share", share)
        chosen = positions(poly)[array(splats, "InputPointIds")]
        reach = quality * array(splats, "FeatureSize")
        distances = np.linalg.norm(positions(poly)[::7, None] - chosen[None], axis=2)
        assert (distances <= reach * (1 + 1e-6)).any(axis=1).all()
    assert share < 0.1  # the paper's, at 1


def test_fixed_count_is_fitted_at_projected_points():
    """h is the mean distance of the eight nearest ones within the plane (section 2.3.3), and points are these and the input."""
    random = np.random.default_rng(4)
    x = random.uniform(-1, 1, (3000, 2))
    poly = cloud(np.column_stack([x, 0.2 * x[:, 0] ** 2]), np.tile([0, 0, 1.0], (3000, 1)))
    projection = vtkLocallyOptimalProjection()
    projection.SetInputData(poly)
    projection.SetNumberOfPoints(150)
    projection.SetSeed(7)
    projection.Update()
    points = positions(projection.GetOutput()).astype(float)
    splats = fit(poly, Selection=2, NumberOfSplats=150, Seed=7, Order=2, NumberOfNeighbors=6, ExtrapolationLimit=0,
                 Overlap=1).GetOutput()
    away = points[:, None, :2] - points[None, :, :2]  # the input's normals are (0, 0, 1)
    solid = np.linalg.norm(points[:, None] - points[None], axis=2)
    nearest = np.argsort(solid, axis=1)[:, 1:9]
    expected = np.take_along_axis(np.linalg.norm(away, axis=2), nearest, axis=1).mean(axis=1)
    assert np.allclose(array(splats, "FeatureSize"), expected, rtol=1e-5)
    assert np.allclose(array(splats, "radius"), expected, rtol=1e-5)
    union = np.vstack([positions(poly), points])
    for i in np.argsort(np.linalg.norm(points[:, :2], axis=1))[:10]:
        n, u = array(splats, "Normals")[i].astype(float), array(splats, "SplatAxes")[i].astype(float)
        h, d = expected[i], union - points[i]
        d = d[np.linalg.norm(d, axis=1) <= 2 * h]
        a, b = d @ u / h, d @ np.cross(n, u) / h
        root = np.exp(-0.5 * (d * d).sum(axis=1) / h ** 2)
        height = d @ n - (positions(splats)[i] - points[i]) @ n
        terms = np.column_stack([np.ones_like(a), a, b, a * a, a * b, b * b])
        c = np.linalg.lstsq(terms * root[:, None], height / h * root, rcond=None)[0]
        assert np.allclose(array(splats, "SplatCoefficients")[i], c, atol=1e-4)


def test_same_for_any_threads_and_other_for_another_seed():
    poly = sphere(2000)

    def run(seed, selection):
        splats = fit(poly, Seed=seed, Selection=selection, NumberOfSplats=100).GetOutput()
        return np.concatenate([positions(splats).ravel(), array(splats, "SplatCoefficients").ravel()]).tobytes()

    for selection in (1, 2):
        first = run(1, selection)
        for backend in ("Sequential", "STDThread", "TBB"):
            if vtkSMPTools.SetBackend(backend):
                for threads in (1, 3):
                    vtkSMPTools.Initialize(threads)
                    assert run(1, selection) == first
        vtkSMPTools.Initialize()
        assert run(2, selection) != first


def test_adaptive_order_meets_its_tolerance():
    x = np.random.default_rng(1).uniform(-1, 1, (8000, 2))
    z = np.where(x[:, 0] < 0, 0, x[:, 0] ** 3)
    poly = cloud(np.column_stack([x, z]), np.tile([0, 0, 1.0], (8000, 1)))
    splats = fit(poly, Order=4, Tolerance=1e-5, ExtrapolationLimit=0).GetOutput()
    orders, residuals = array(splats, "SplatOrder"), array(splats, "Residual")
    assert (residuals[orders < 4] <= 1e-5 * (1 + 1e-6)).all()
    assert set(orders[positions(splats)[:, 0] < -0.3]) == {1}
    assert orders[positions(splats)[:, 0] > 0.3].mean() > 2
    assert len(set(orders)) > 2


def test_errors_of_equations_3_and_4():
    poly = sphere(3000)
    filter = fit(poly, Order=2, ComputeErrors=True, Quality=1.0)
    splats, errors = filter.GetOutput(0), array(filter.GetOutput(1), "ApproximationError")
    expected = np.zeros(3000)
    for i in range(splats.GetNumberOfPoints()):
        d = positions(poly) - positions(splats)[i]
        n, u = array(splats, "Normals")[i].astype(float), array(splats, "SplatAxes")[i].astype(float)
        radius, h = float(array(splats, "radius")[i]), float(array(splats, "FeatureSize")[i])
        a, b = d @ u / radius, d @ np.cross(n, u) / radius
        c = array(splats, "SplatCoefficients")[i].astype(float)
        height = sum(k * t for k, t in zip(c, (1, a, b, a * a, a * b, b * b)))
        inside = (d * d).sum(axis=1) <= radius ** 2
        expected += np.where(inside, np.abs(d @ n - radius * height) * np.exp(-(d * d).sum(axis=1) / h ** 2), 0)
    assert np.allclose(errors, expected, atol=2e-6 * expected.max() + 1e-8)
    assert filter.GetTotalError() == pytest.approx(expected.sum(), rel=1e-4)


def test_input_that_is_hard(capfd):
    line = np.zeros((50, 3))
    line[:, 0] = np.arange(50)
    splats = fit(cloud(line), Order=3)
    assert "lower order" in capfd.readouterr().err and np.isfinite(array(splats.GetOutput(), "SplatCoefficients")).all()
    assert fit(vtkPolyData()).GetOutput().GetNumberOfPoints() == 0
    one = fit(cloud([[1, 2, 3]])).GetOutput()
    assert one.GetNumberOfPoints() == 1
    capfd.readouterr()
    x = positions(sphere(1000)).copy()
    x[5] = np.nan
    fit(cloud(x, x))
    assert "NaN" in capfd.readouterr().err
    # all in units of the cloud, whatever these are
    for scale in (1e-12, 1e12):
        small = fit(cloud(positions(sphere(1000)) * scale, positions(sphere(1000)))).GetOutput()
        plain = fit(sphere(1000)).GetOutput()
        assert np.allclose(array(small, "SplatCoefficients"), array(plain, "SplatCoefficients"), atol=1e-5)


def test_projection_spreads_points_evenly():
    random = np.random.default_rng(2)
    x = random.standard_normal((6000, 3))
    x /= np.linalg.norm(x, axis=1, keepdims=True)
    projection = vtkLocallyOptimalProjection()
    projection.SetInputData(cloud(x, x))
    projection.SetNumberOfPoints(300)
    projection.Update()
    y = positions(projection.GetOutput())
    assert len(y) == 300 and np.abs(np.linalg.norm(y, axis=1) - 1).max() < 0.05

    def spread(p):
        d = np.linalg.norm(p[:, None] - p[None], axis=2)
        nearest = np.sort(d, axis=1)[:, 1]
        return nearest.min() / nearest.mean()

    print("iterations", projection.GetNumberOfIterations(), "spread", spread(y), "random", spread(x[:300]))
    assert spread(y) > 0.5 > 5 * spread(x[:300])
    nearest = np.linalg.norm(y[:, None] - x[None], axis=2).argmin(axis=1)
    assert (array(projection.GetOutput(), "InputPointIds") == nearest).mean() > 0.99


def compare_to_reference(splats, mapper, renderer, size, what):
    """What was drawn has the reference's splats, but where that finds two near each other: both, and where it drew the same."""
    truth = reference.draw(splats, renderer, (size, size), mapper.GetDepthShift(), mapper.GetWeightFalloff(),
                           mapper.GetSeparateSides())
    buffer = surface_buffer(mapper)
    covered = truth["depth"] > 0
    differ = (((buffer("Depth") > 0) != covered) | (buffer("PointIds") != truth["id"])) & ~truth["close"]
    print(what, "covered", covered.sum(), "differ", differ.sum(), "close", truth["close"].sum())
    assert differ.sum() <= 0.001 * covered.sum()
    return buffer, truth, covered, covered & ~differ & ~truth["close"]


@pytest.mark.parametrize("backend", [1, 2])
def test_agrees_with_the_reference(backend):
    poly = sphere(1500)
    for order, scene in ((1, {}), (2, {"WeightFalloff": 1.0, "SeparateSides": False}), (3, {}), (4, {"DepthShift": 0.05})):
        splats = fit(poly, Order=order, NumberOfNeighbors=40).GetOutput()
        mapper, renderer, window = drawn(splats, Backend=backend, **scene)
        if order == 4:
            renderer.GetActiveCamera().ParallelProjectionOn()
        window.Render()
        buffer, truth, covered, same = compare_to_reference(splats, mapper, renderer, 96, f"order {order}")
        assert covered.sum() > 1000
        assert np.abs(buffer("Normals") - truth["normal"])[same].max() < 1e-4
        assert np.abs(buffer("Depth") / np.where(covered, truth["depth"], 1) - 1)[same].max() < 1e-4


def look(renderer, position, target, near, far, angle=40, center=(0, 0), parallel=False):
    camera = renderer.GetActiveCamera()
    camera.SetPosition(*position)
    camera.SetFocalPoint(*target)
    camera.SetViewAngle(angle)
    camera.SetWindowCenter(*center)
    camera.SetParallelProjection(parallel)
    camera.SetParallelScale(0.7)
    camera.SetClippingRange(near, far)


VIEWS = {
    "cut by the near plane": lambda r: look(r, (0, 0, 1.4), (0.3, 0.1, 0), 0.5, 5),
    "the eye amid splats": lambda r: look(r, (0, 0, 1.02), (0.5, 0.2, 0.6), 0.01, 5, angle=80),
    "grazing": lambda r: look(r, (1.01, 0, 1.5), (1.01, 0, -1), 0.1, 5),
    "off the axis": lambda r: look(r, (0, 0, 1.6), (1.6, 1.2, 0), 0.05, 5, angle=140),
    "off-centre window": lambda r: look(r, (0, 0, 4), (0, 0, 0), 1, 9, center=(0.6, -0.4)),
    "parallel, aside": lambda r: look(r, (0, 0.9, 4), (0.8, 0.9, 0), 1, 9, parallel=True),
}


@pytest.mark.parametrize("backend", [1, 2])
@pytest.mark.parametrize("view", VIEWS)
def test_no_splat_is_cut_by_what_bounds_it(backend, view):
    """Large ones, in views in which it is hard to tell where on the screen they are; the reference looks everywhere."""
    splats = fit(sphere(400), Order=2, NumberOfNeighbors=20).GetOutput()
    mapper, renderer, window = drawn(splats, (64, 64), Backend=backend)
    VIEWS[view](renderer)
    window.Render()
    buffer, truth, covered, same = compare_to_reference(splats, mapper, renderer, 64, view)
    assert covered.sum() > 300
    assert np.abs(buffer("Depth") / np.where(covered, truth["depth"], 1) - 1)[same].max() < 1e-4


def test_blending_normals_errs_no_more_than_blending_shades():
    """The paper blends colours that were lit splat by splat; the mapper blends normals, which are lit once."""
    for order in (1, 2, 3):
        splats = fit(sphere(4000), Order=order).GetOutput()
        mapper, renderer, window = drawn(splats)
        window.Render()
        size = (96, 96)
        image = reference.draw(splats, renderer, size, mapper.GetDepthShift(), mapper.GetWeightFalloff(),
                               mapper.GetSeparateSides())
        covered = image["depth"] > 0
        # The truth: where each pixel's ray meets the unit sphere.
        view = reference._matrix(renderer.GetActiveCamera().GetViewTransformMatrix())
        center, slope = view[:3, 3], np.tan(np.radians(renderer.GetActiveCamera().GetViewAngle() / 2))
        y, x = np.mgrid[0:96, 0:96]
        ray = np.stack([slope * ((2 * x + 1) / 96 - 1), slope * ((2 * y + 1) / 96 - 1), -np.ones((96, 96))], axis=-1)
        ray = ray.reshape(-1, 3) / np.linalg.norm(ray.reshape(-1, 3), axis=1, keepdims=True)
        along = ray @ center
        square = along**2 - center @ center + 1
        covered &= square > 0
        truth = np.abs((ray * (along - np.sqrt(np.maximum(square, 0)))[:, None] - center)[:, 2])
        assert covered.sum() > 1000
        normals, shades = (255 * np.sqrt(np.mean((shade - truth)[covered] ** 2))
                           for shade in (np.abs(image["normal"][:, 2]), image["shade"]))
        print("order", order, "grey levels off, normals blended", normals, "shades blended", shades)
        assert normals <= 1.05 * shades
        assert normals < (13, 0.1, 0.1)[order - 1]


@pytest.mark.parametrize("backend", [1, 2])
def test_sphere_is_closed_round_and_selectable(backend, tmp_path):
    count = 8000
    poly = sphere(count)
    colors = numpy_to_vtk(np.tile(np.uint8([200, 100, 50]), (count, 1)), deep=True)
    colors.SetName("colors")
    poly.GetPointData().SetScalars(colors)
    path = str(tmp_path / "splats.vtp")
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(fit(poly, Order=2).GetOutput())
    writer.SetFileName(path)
    writer.Write()
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    splats = reader.GetOutput()
    mapper, renderer, window = drawn(splats, (128, 128), Backend=backend)
    mapper.ScalarVisibilityOn()
    window.Render()
    buffer = surface_buffer(mapper)
    depth = buffer("Depth")
    camera = renderer.GetActiveCamera()
    scale = np.tan(np.radians(camera.GetViewAngle() / 2))
    y, x = np.mgrid[0:128, 0:128]
    ray = np.stack([((2 * x + 1) / 128 - 1) * scale, ((2 * y + 1) / 128 - 1) * scale, -np.ones((128, 128))], axis=-1)
    ray = ray.reshape(-1, 3)
    eye = camera.GetDistance()
    a, b, c = (ray ** 2).sum(axis=1), ray[:, 2] * eye, eye ** 2 - 1
    inside = b * b - a * c > 0
    t = (-b - np.sqrt(np.where(inside, b * b - a * c, 0))) / a
    both = inside & (depth > 0)
    normal = ray * t[:, None] + [0, 0, eye]
    assert (depth > 0)[inside & (np.linalg.norm(normal[:, :2], axis=1) < 0.96)].all()  # closed, but for the rim
    assert ((depth > 0) != inside).sum() <= 0.01 * inside.sum()
    middle = both & (np.linalg.norm(normal[:, :2], axis=1) < 0.7)
    cosine = (normal * buffer("Normals")).sum(axis=1)
    print("depth", np.abs(depth - t)[middle].max(), "cosine", cosine[middle].min())
    assert np.abs(depth - t)[middle].max() < 5e-3
    assert cosine[middle].min() > 0.999
    assert np.allclose(buffer("Colors")[both, :3], np.array([200, 100, 50]) / 255, atol=1e-4)

    selector = vtkHardwareSelector()
    selector.SetRenderer(renderer)
    selector.SetArea(64, 64, 64, 64)
    selector.SetFieldAssociation(0)
    node = selector.Select().GetNode(0)
    splat = node.GetSelectionList().GetValue(0)
    point = array(splats, "InputPointIds")[splat]
    assert np.linalg.norm(positions(poly)[point] - [0, 0, 1]) < 2 * array(splats, "radius").max()
    assert mapper.GetLastFramePointsDrawn() in (0, splats.GetNumberOfPoints())


@pytest.mark.parametrize("backend", [1, 2])
def test_colours_of_splats_that_changed_without_them(backend):
    """Splats are grouped by order, and so are their colours, which stay the same array here."""
    poly = sphere(2000)
    across = (positions(poly)[:, :1] + 1) / 2
    poly.GetPointData().SetScalars(numpy_to_vtk(np.uint8(255 * np.hstack([across, 1 - across, across, across ** 0])), deep=True))
    splats = fit(poly, Order=2).GetOutput()
    mapper, renderer, window = drawn(splats, Backend=backend)
    mapper.ScalarVisibilityOn()
    before = rendering.read_color(window)
    mapper.ScalarVisibilityOff()
    orders = splats.GetPointData().GetArray("SplatOrder")
    vtk_to_numpy(orders)[::2] = 1  # planes, whose group was empty
    orders.Modified()
    window.Render()
    mapper.ScalarVisibilityOn()
    assert np.abs(rendering.read_color(window) - before).mean() < 2 / 255


def test_input_without_splats_is_an_error(capfd):
    mapper, renderer, window = drawn(sphere(100), (32, 32))
    window.Render()
    assert "vtkAlgebraicSplats" in capfd.readouterr().err
