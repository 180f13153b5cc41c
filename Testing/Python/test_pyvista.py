# SPDX-License-Identifier: BSD-3-Clause
"""PyVista's plotters with our mappers: what add_mesh's keywords do to a mesh, they do to the surface of its points."""

import doctest
import inspect
import re

import numpy as np
import pytest

pv = pytest.importorskip("pyvista", reason="PyVista is not installed; the wheel's tests have it")

import pointsurface.pyvista  # noqa: E402
from pointsurface.methods import METHODS  # noqa: E402
from pointsurface.pyvista import add_point_surface  # noqa: E402
from pointsurface.rendering import renderer_string  # noqa: E402

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


def test_auto_picks_by_normals():
    _, cloud = lit_cloud()
    plotter = pv.Plotter(off_screen=True, window_size=SIZE)
    spacing = np.sqrt(4 * np.pi / cloud.n_points)  # on a radius of 1
    noise = np.random.default_rng(1).normal(scale=spacing, size=cloud.n_points)
    bare = add_point_surface(plotter, cloud.points * (1 + noise[:, None]), method="auto").mapper
    lit = add_point_surface(plotter, cloud, method="auto").mapper
    assert bare.GetClassName() == "vtkDirectPointMapper"
    plotter.screenshot(return_img=True)
    is_software = "llvmpipe" in renderer_string(plotter.render_window)
    assert lit.GetClassName() == ("vtkSurfaceSplatMapper" if is_software else "vtkPullPushMapper")
    plotter.close()


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


def lit_cloud():
    """The points of a sphere, and their normals."""
    mesh = fine_sphere()
    cloud = pv.PolyData(mesh.points)
    cloud.point_data.active_normals = mesh.points / np.linalg.norm(mesh.points, axis=1, keepdims=True)
    return mesh, cloud


def test_subplots():
    _, cloud = lit_cloud()
    plotter = pv.Plotter(off_screen=True, window_size=(400, 200), shape=(1, 2))
    plotter.set_background("white")
    for column, color in enumerate(("red", "blue")):
        plotter.subplot(0, column)
        actor = add_point_surface(plotter, cloud, color=color)
        assert actor in plotter.renderers[column].actors.values()
    image = plotter.screenshot(return_img=True).astype(float)
    plotter.close()
    for half, own, other in ((image[:, :200], 0, 2), (image[:, 200:], 2, 0)):
        seen = half[covered(half)]
        assert len(seen) > 5000
        assert (seen[:, own] > 2 * seen[:, other]).mean() > 0.9  # the outline blends with the background


@pytest.mark.parametrize("effect", ["enable_eye_dome_lighting", "enable_ssao"])
def test_effects_do_what_they_do_to_the_mesh(effect):
    mesh, cloud = lit_cloud()
    floor = pv.Plane(center=(0, 0, -0.5), i_size=2, j_size=2)

    def drawn(add_sphere, with_effect):
        def add(plotter):
            add_sphere(plotter)
            plotter.add_mesh(floor, color="white")
            plotter.camera_position = [(1, 2, 0.6), (0, 0, -0.2), (0, 0, 1)]
            if with_effect:
                getattr(plotter, effect)(**({"radius": 0.3, "blur": True} if effect == "enable_ssao" else {}))

        return picture(add)

    def add_cloud(plotter):
        add_point_surface(plotter, cloud, color="white")

    plain, found = drawn(add_cloud, False), drawn(add_cloud, True)
    wanted = drawn(lambda plotter: plotter.add_mesh(mesh, color="white", smooth_shading=True), True)
    changed = np.abs(found - plain).max(axis=2) > 10
    assert changed.sum() > 300, "it does something"
    assert (found <= plain + 3).mean() > 0.97, "it darkens"
    assert np.abs(found - wanted).mean() < 3  # of 255
    assert np.abs(found - wanted).mean() < 0.5 * np.abs(plain - wanted).mean()


def test_picking():
    _, cloud = lit_cloud()
    plotter = pv.Plotter(off_screen=True, window_size=SIZE)
    add_point_surface(plotter, cloud, color="tan")
    plotter.camera_position = [(0, -6, 0), (0, 0, 0), (0, 0, 1)]
    picked = []
    plotter.enable_point_picking(
        callback=lambda place: picked.append(np.array(place)), left_clicking=True, picker="hardware", show_message=False,
        show_point=False,
    )  # fmt: skip
    plotter.iren.picker.SetSnapToMeshPoint(True)  # or VTK looks for cells with an area
    plotter.show(auto_close=False)
    plotter.iren._mouse_left_button_click(190, 170)
    plotter.close()
    assert len(picked) == 1
    assert np.linalg.norm(picked[0]) == pytest.approx(1, abs=0.02)
    x, y, z = picked[0]
    scale = 150 / np.tan(np.radians(15))  # pixels, at distance 1
    assert scale * x / (y + 6) == pytest.approx(40, abs=6)
    assert scale * z / (y + 6) == pytest.approx(20, abs=6)
    assert y < 0, "on the near side"


def test_show_writes_the_picture(tmp_path):
    _, cloud = lit_cloud()
    plotter = pv.Plotter(off_screen=True, window_size=SIZE)
    plotter.set_background("white")
    add_point_surface(plotter, cloud, color="tan")
    plotter.show(screenshot=str(tmp_path / "shown.png"))
    shown = pv.read(tmp_path / "shown.png")
    assert shown.dimensions[:2] == SIZE
    pixels = shown.point_data.active_scalars.reshape(*SIZE, -1)[..., :3]
    expected = picture(lambda plotter: add_point_surface(plotter, cloud, color="tan"))
    assert covered(pixels).sum() == pytest.approx(covered(expected).sum(), rel=0.01) and covered(pixels).sum() > 10000


def test_animation(tmp_path):
    image = pytest.importorskip("PIL.Image", reason="Pillow is not installed")
    pytest.importorskip("imageio", reason="imageio is not installed")
    _, cloud = lit_cloud()
    plotter = pv.Plotter(off_screen=True, window_size=SIZE)
    plotter.set_background("white")
    add_point_surface(plotter, cloud, color="tan", radius=0.02)
    plotter.camera_position = [(0, -6, 0), (0, 0, 0), (0, 0, 1)]
    plotter.open_gif(str(tmp_path / "squeezed.gif"))
    for height in (1.0, 0.6, 0.3):
        cloud.points[:, 2] = fine_sphere().points[:, 2] * height
        cloud.GetPoints().Modified()
        plotter.write_frame()
    plotter.close()
    heights = []
    with image.open(tmp_path / "squeezed.gif") as animation:
        assert animation.n_frames == 3
        for i in range(3):
            animation.seek(i)
            rows = covered(np.asarray(animation.convert("RGB"), float) + 15).any(axis=1)  # colours of a palette
            heights.append(rows.sum())
    assert heights[0] > 90
    assert heights[1:] == pytest.approx([0.6 * heights[0], 0.3 * heights[0]], abs=6)


def test_opacity_shows_what_is_behind():
    _, cloud = lit_cloud()
    behind = pv.Cube(center=(0, 2, 0))

    def add(opacity):
        def add_both(plotter):
            plotter.add_mesh(behind, color="blue", lighting=False)
            add_point_surface(plotter, cloud, color="red", opacity=opacity)
            plotter.camera_position = [(0, -6, 0), (0, 0, 0), (0, 0, 1)]

        return picture(add_both)[150, 150]

    solid, half = add(1.0), add(0.5)
    assert solid[2] < 60 and half[2] == pytest.approx(0.5 * solid[2] + 127, abs=15)


def test_everything_has_hints_and_an_example():
    public = [add_point_surface]
    for accessor in (pointsurface.pyvista.PointsAccessor, pointsurface.pyvista.VolumeAccessor):
        public += [member for name, member in vars(accessor).items() if not name.startswith("_")]
    assert len(public) == 5
    for function in public:
        parameters = inspect.signature(function).parameters
        named = [name for name in parameters if name != "self"]
        assert {*named, "return"} <= set(function.__annotations__), function
        text = inspect.getdoc(function)
        for section in ("Parameters", "Returns", "Examples"):
            assert f"\n{section}\n{'-' * len(section)}\n" in text, (function, section)
        for name in named:
            assert re.search(rf"^(\*\*)?{name} : ", text, re.M), (function, name)
        assert ">>> " in text
