# SPDX-License-Identifier: BSD-3-Clause
"""PyVista's plotters with our mappers: what add_mesh's keywords do to a mesh, they do to the surface of its points."""

import doctest

import numpy as np
import pytest

pv = pytest.importorskip("pyvista", reason="PyVista is not installed; the wheel's tests have it")

import pointsurface.pyvista  # noqa: E402
from pointsurface.methods import METHODS  # noqa: E402
from pointsurface.pyvista import add_point_surface  # noqa: E402

SIZE = (300, 300)


def fine_sphere():
    return pv.Icosphere(nsub=6)


def picture(add, background="white"):
    plotter = pv.Plotter(off_screen=True, window_size=SIZE)
    plotter.set_background(background)
    add(plotter)
    image = plotter.screenshot(return_img=True).astype(float)
    plotter.close()
    return image


def covered(image):
    return (image < 255).any(axis=2)


@pytest.mark.parametrize(
    "keywords",
    [
        {"color": "tan"},
        {"color": "tan", "opacity": 0.5, "culling": "back"},
        {"color": "tan", "pbr": True, "metallic": 0.5, "roughness": 0.5},
        {"scalars": "height", "cmap": "viridis", "clim": (-0.3, 0.3), "show_scalar_bar": False},
        {"scalars": "colors", "rgb": True},
    ],
    ids=lambda keywords: "-".join(keywords),
)
def test_looks_like_the_mesh(keywords):
    mesh = fine_sphere()
    mesh["height"] = mesh.points[:, 2]
    mesh["colors"] = np.rint(255 * (0.5 + mesh.points)).clip(0, 255).astype(np.uint8)
    cloud = pv.PolyData(mesh.points)
    for name in ("height", "colors"):
        cloud[name] = mesh[name]
    cloud.point_data.active_normals = mesh.points / np.linalg.norm(mesh.points, axis=1, keepdims=True)
    wanted = picture(lambda plotter: plotter.add_mesh(mesh, smooth_shading=True, **keywords))
    found = picture(lambda plotter: add_point_surface(plotter, cloud, **keywords))
    inside = covered(wanted) & covered(found)
    assert (covered(wanted) ^ covered(found)).sum() < 0.02 * inside.sum()
    assert np.abs(wanted - found)[inside].mean() < 3  # of 255
    assert found[inside].std() > 5


def test_scalar_bar():
    cloud = pv.PolyData(fine_sphere().points)
    cloud["height"] = cloud.points[:, 2]
    plotter = pv.Plotter(off_screen=True, window_size=SIZE)
    actor = add_point_surface(plotter, cloud, scalars="height", cmap="viridis", clim=(-1, 2))
    assert list(plotter.scalar_bars.keys()) == ["height"]
    assert actor.mapper.scalar_range == (-1, 2)
    assert actor.mapper.GetClassName() == "vtkPullPushMapper"
    plotter.close()


def test_array_is_not_copied():
    points = fine_sphere().points
    plotter = pv.Plotter(off_screen=True, window_size=SIZE)
    actor = add_point_surface(plotter, points)
    assert np.shares_memory(pv.wrap(actor.mapper.GetInput()).points, points)
    plotter.close()


def test_same_name_replaces():
    plotter = pv.Plotter(off_screen=True, window_size=SIZE)
    for _ in range(2):
        add_point_surface(plotter, fine_sphere().points, name="cloud")
    assert list(plotter.actors) == ["cloud"]
    plotter.close()


def test_radius():
    cloud = pv.PolyData(fine_sphere().points)
    cloud["size"] = np.full(cloud.n_points, 0.02)
    plotter = pv.Plotter(off_screen=True, window_size=SIZE)
    assert add_point_surface(plotter, cloud, radius=0.01, radius_scale=2).mapper.GetRadius() == 0.01
    assert add_point_surface(plotter, cloud, radius="size").mapper.GetRadiusArray() == "size"
    with pytest.raises(ValueError, match="no array 'sizes' of radii; they have .*size"):
        add_point_surface(plotter, cloud, radius="sizes")
    plotter.close()


def test_wrong_use():
    plotter = pv.Plotter(off_screen=True, window_size=SIZE)
    with pytest.raises(ValueError, match="no method 'splat'; use one of pull-push"):
        add_point_surface(plotter, fine_sphere(), method="splat")
    with pytest.raises(ValueError, match="no points"):
        add_point_surface(plotter, pv.PolyData())
    assert not plotter.actors
    plotter.close()


@pytest.mark.parametrize("method", METHODS)
def test_every_method(method):
    sphere = fine_sphere()
    cloud = pv.PolyData(sphere.points)

    def from_one_place(add):
        def add_and_look(plotter):
            add(plotter)
            plotter.camera_position = [(2, 2, 2), (0, 0, 0), (0, 0, 1)]

        return covered(picture(add_and_look))

    wanted = from_one_place(lambda plotter: plotter.add_mesh(sphere, color="tan"))
    found = from_one_place(lambda plotter: add_point_surface(plotter, cloud, method=method, color="tan"))
    assert wanted.sum() > 10000
    assert (wanted ^ found).sum() < 0.05 * wanted.sum()


def two_spheres(as_points):
    blocks = {name: fine_sphere().translate((x, 0, 0)) for name, x in (("left", 0), ("right", 1.2))}
    for name, block in blocks.items():
        block["height"] = block.points[:, 2]
    return pv.MultiBlock({name: block.cast_to_pointset() if as_points else block for name, block in blocks.items()})


@pytest.mark.parametrize(
    "keywords",
    [{"color": "tan"}, {"scalars": "height", "cmap": "viridis", "show_scalar_bar": False}, {"multi_colors": ["red", "blue"]}],
    ids=lambda keywords: "-".join(keywords),
)
def test_blocks_look_like_those_of_a_mesh(keywords):
    wanted = picture(lambda plotter: plotter.add_mesh(two_spheres(False), smooth_shading=True, **keywords))
    found = picture(lambda plotter: add_point_surface(plotter, two_spheres(True), **keywords))
    inside = covered(wanted) & covered(found)
    assert inside.sum() > 5000
    assert (covered(wanted) ^ covered(found)).sum() < 0.04 * inside.sum()
    assert np.abs(wanted - found)[inside].mean() < 5  # of 255


def test_attributes_of_a_block():
    def hide_one(plotter):
        actor = add_point_surface(plotter, two_spheres(True), color="tan", radius=0.02)
        attributes = actor.mapper.GetCompositeDataDisplayAttributes()
        attributes[1].visible = False
        attributes[2].color = "blue"

    found = picture(hide_one)
    rows, columns = np.nonzero(covered(found))
    assert np.ptp(rows) == pytest.approx(np.ptp(columns), abs=5), "one sphere"
    seen = found[covered(found)]
    assert len(seen) > 5000 and (seen[:, 2] > seen[:, 0]).all()


def test_accessors():
    sphere = pv.PolyData(fine_sphere().points)
    radii = sphere.point_surface.radii()["radius"]
    spacing = np.sqrt(np.pi / sphere.n_points)  # of points in squares, on a sphere of radius 1/2
    assert spacing < radii.mean() < 3 * spacing
    normals = sphere.point_surface.normals().point_data.active_normals
    assert np.abs(np.sum(normals * sphere.points, axis=1) * 2).min() > 0.99
    splats = sphere.point_surface.splats(order=2, neighbors=100)
    assert 20 < splats.n_points < 0.1 * sphere.n_points and splats["Residual"].max() < 1e-3
    grid = pv.ImageData(dimensions=(41, 41, 41), spacing=(0.05,) * 3, origin=(-1,) * 3)
    grid["distance"] = np.linalg.norm(grid.points, axis=1)
    surface = grid.point_surface.isosurface([0.5, 0.8])
    distances = np.linalg.norm(surface.points, axis=1)
    assert (np.minimum(np.abs(distances - 0.5), np.abs(distances - 0.8)) < 1e-3).all()
    assert surface.n_cells == 0


def test_examples_of_the_documentation():
    assert doctest.testmod(pointsurface.pyvista).failed == 0
