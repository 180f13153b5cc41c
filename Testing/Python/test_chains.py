# SPDX-License-Identifier: BSD-3-Clause
"""The image-space passes chain with VTK's own in any order, over points and over meshes: each does what it does alone,
whatever stands around it, and window depths come out as they went in. What VTK's own do not do in some order, of
themselves, is told here by name (see the class vtkImageSpacePass)."""

from functools import lru_cache
from itertools import permutations

import numpy as np
import pytest
from scenes import Scene, grow, polydata
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from pointsurface import passes, vtkSurfaceSmoothingPass

SIZE = (120, 110)
OFFSET = (37, 51)  # of a viewport off the window's origin
FILL = ("background-fill", "occluded-fill")
ALL = (*FILL, "smoothing", "antialiasing", "feature-lines", "silhouettes")
VTK = ("edl", "ssao", "fxaa")
NOTHING = ("nothing",)  # a pass of ours that leaves what it gets
LINE = 0.25  # brightness; nothing else is as dark but what vtkEDLShading has darkened


def sphere_points(radius, count=20_000):
    """Points, each a vertex, with normals; seen from outside some of them are two pixels apart."""
    i = np.arange(count) + 0.5
    z, angle = 1 - 2 * i / count, np.pi * (1 + 5**0.5) * i
    normals = np.stack([np.sqrt(1 - z * z) * np.cos(angle), np.sqrt(1 - z * z) * np.sin(angle), z], axis=1)
    cloud = polydata((radius * normals).astype(np.float32), normals)
    vertices = vtkCellArray()
    vertices.InsertNextCell(count)
    for point in range(count):
        vertices.InsertCellPoint(point)
    cloud.SetVerts(vertices)
    return cloud


def scene_of(*parts):
    """Parts, each data and its colour, on a bright background; the camera sees all of the first."""
    scene = Scene(vtkPolyDataMapper, parts[0][0], SIZE)
    scene.renderer.RemoveAllViewProps()
    scene.renderer.SetBackground(0.6, 0.7, 0.8)
    for data, color in parts:
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(data)
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(color)
        actor.GetProperty().BackfaceCullingOn()
        scene.renderer.AddActor(actor)
    scene.renderer.ResetCameraClippingRange()
    return scene


@lru_cache
def points():
    """A sphere with another one inside, which is to be hidden: as points of a pixel, with holes."""
    return scene_of((sphere_points(1.0), (0.9, 0.7, 0.4)), (sphere_points(0.7), (0.2, 0.4, 0.9)))


@lru_cache
def mesh():
    """A cube with a ball before it."""
    cube, ball = vtkCubeSource(), vtkSphereSource()
    ball.SetRadius(0.25)
    ball.SetCenter(0.1, -0.6, 0.45)
    ball.SetThetaResolution(100)
    ball.SetPhiResolution(100)
    for source in (cube, ball):
        source.Update()
    scene = scene_of((cube.GetOutput(), (0.9, 0.7, 0.4)), (ball.GetOutput(), (0.2, 0.4, 0.9)))
    scene.camera.Zoom(0.8)
    return scene


def make(name):
    if name == "nothing":
        result = vtkSurfaceSmoothingPass()
        result.SetIterations(0)
        return result
    result = passes.PASSES[name]()
    if name == "ssao":
        result.SetRadius(0.4)
        result.SetBias(0.02)
        result.SetKernelSize(16)
    return result


@lru_cache(maxsize=None)
def draw(scene, chain):
    """The picture and its window depths, through passes by their names, the innermost first."""
    passes.apply(scene().renderer, [make(name) for name in chain])
    return scene().color(), scene().depth()


def draw_off_the_origin(scene, chain):
    shown = scene()
    width, height = SIZE[0] + OFFSET[0], SIZE[1] + OFFSET[1]
    try:
        shown.window.SetSize(width, height)
        shown.renderer.SetViewport(OFFSET[0] / width, OFFSET[1] / height, 1, 1)
        color, depth = draw.__wrapped__(scene, chain)
        return color[OFFSET[1] :, OFFSET[0] :], depth[OFFSET[1] :, OFFSET[0] :]
    finally:
        shown.renderer.SetViewport(0, 0, 1, 1)
        shown.window.SetSize(*SIZE)


def orders(ours):
    return [sum(order, ()) for order in permutations((ours, *((name,) for name in VTK)))]


def without(chain, name):
    return tuple(other for other in chain if other != name)


def changed(picture, other, by=0.02):
    return np.abs(picture - other).max(axis=-1) > by


def knows_positions(chain):
    """Whether vtkSSAOPass, if it is there, gets positions and normals: from mappers, or from a pass of ours with nothing
    between them but FXAA. vtkEDLShading has none to give, and VTK's FXAA draws over those of mappers: what SSAO makes of
    that is not defined, but for depths."""
    below = chain[: chain.index("ssao")] if "ssao" in chain else ()
    inner = without(below, "fxaa")
    return inner[-1] not in VTK if inner else not below


def knows_normals(chain, name):
    """Whether a pass of ours gets the mappers' normals: VTK's own hand none on."""
    return not set(chain[: chain.index(name)]) & set(VTK)


CASES = [(scene, ours) for scene in (points, mesh) for ours in (FILL, *((name,) for name in ALL[2:]), ALL)]
CASES.remove((mesh, FILL))  # nothing to fill
CASES.remove((points, ("feature-lines",)))  # raw points bend everywhere
CASES.remove((points, ("silhouettes",)))  # and are nothing but silhouettes
CASES.remove((points, ("antialiasing",)))
CASES.remove((points, ("smoothing",)))
IDS = [f"{scene.__name__}-{'all' if ours == ALL else '+'.join(ours)}" for scene, ours in CASES]


@pytest.mark.parametrize("scene, ours", CASES, ids=IDS)
def test_depths_come_out_as_without_the_others(scene, ours):
    """Raw window depths: of what no pass has changed, to the last bit. vtkEDLShading interpolates, with weights of 1e-5
    where the rasteriser places a texel's centre a trace beside it."""
    plain, alone = draw(scene, ())[1], draw(scene, ours)[1]
    assert np.count_nonzero(plain < 1) > 3000
    same = np.abs(alone - plain) < 1e-7
    assert np.count_nonzero(~same) > 200 if scene is points or "smoothing" in ours else same.all()
    for chain in orders(ours):
        depth = draw(scene, chain)[1]
        assert np.abs(depth - alone).max() < 2e-5, chain
    for first, second in permutations((ours, ("ssao",), ("fxaa",)), 2):
        depth = draw(scene, first + second)[1]
        assert np.array_equal(depth, alone if ours in (first, second) else plain), (first, second)


@pytest.mark.parametrize("ours", [FILL, ALL], ids=["fill", "all"])
def test_points_stay_filled(ours):
    """No hole within the sphere's outline, in depth or in colour, whatever the order."""
    surface = draw(points, FILL)[1] < 1
    inside = ~grow(~surface, 4)
    holes = inside & ((draw(points, ())[1] > draw(points, FILL)[1] + 1e-3))
    assert np.count_nonzero(inside) > 5000 and np.count_nonzero(holes) > 1000
    for chain in orders(ours):
        color, depth = draw(points, chain)
        assert (depth[inside] < 1).all(), chain
        assert np.abs(depth - draw(points, ours)[1])[inside].max() < 2e-5, chain
        # FXAA beneath the fill has mixed the points' colours with what is behind them
        if chain.index("fxaa") > chain.index(FILL[0]):
            orange = color[..., 0] > color[..., 2]
            assert np.mean(orange[holes] | (color[holes].max(axis=-1) < LINE)) > 0.99, chain


@pytest.mark.parametrize("scene, ours", [c for c in CASES if c[1][-1] in ("silhouettes", "feature-lines")])
def test_lines_are_where_they_are_alone(scene, ours):
    base = FILL if scene is points else ()
    plain, alone = draw(scene, base)[0], draw(scene, ours)[0]
    full = (alone.max(axis=-1) < 0.05) & (plain.max(axis=-1) > LINE)
    anywhere = grow(changed(alone, plain), 2)
    assert np.count_nonzero(full) > 60 and anywhere.mean() < 0.5
    for chain in orders(ours):
        color = draw(scene, chain)[0]
        assert np.mean(color[full].max(axis=-1) < LINE) > 0.97, chain
        if not knows_positions(chain) or (scene is points and not knows_normals(chain, ours[-1])):
            continue  # no two pictures are the same; by normals from depths points bend everywhere
        # the same chain with a pass that does nothing in the place of the lines
        bare = tuple(NOTHING[0] if name in ("silhouettes", "feature-lines") else name for name in chain)
        marks = changed(color, draw(scene, bare)[0], 0.1) & ~anywhere
        # normals of the ball from depths are those of its facets
        assert np.count_nonzero(marks) <= (2 if knows_normals(chain, ours[-1]) else 60), chain


def test_the_other_filters_do_in_a_chain_what_they_do_alone():
    """Anti-aliasing blends the pixels along edges in depth, and smoothing changes what is bent, in every order."""
    plain = draw(mesh, ())[0]
    for name in ("antialiasing", "smoothing"):
        alone = changed(draw(mesh, (name,))[0], plain)
        for chain in filter(knows_positions, orders((name,))):
            bare = tuple(NOTHING[0] if each == name else each for each in chain)
            marks = changed(draw(mesh, chain)[0], draw(mesh, bare)[0])
            assert np.count_nonzero(marks) > 0.1 * np.count_nonzero(alone) > 10, chain
            if name == "antialiasing":  # of lit colours, and SSAO and EDL change those on either side of an edge
                assert np.count_nonzero(marks & ~grow(alone, 2)) <= 0.05 * np.count_nonzero(marks), chain


@pytest.mark.parametrize("scene, ours", [(mesh, ALL), (points, NOTHING), (mesh, NOTHING)])
def test_passes_of_vtk_leave_their_marks(scene, ours):
    """In every order; SSAO where it gets positions, be it from a pass that does nothing else."""
    least = {"edl": 2000, "ssao": 150, "fxaa": 30}
    for chain in filter(knows_positions, orders(ours)):
        for name in VTK:
            if knows_positions(without(chain, name)):
                marks = np.count_nonzero(changed(draw(scene, chain)[0], draw(scene, without(chain, name))[0]))
                assert marks > least[name], (chain, name)


@pytest.mark.parametrize("scene", [points, mesh])
def test_ssao_behind_fxaa_occludes_as_without_it(scene):
    """A pass of ours keeps positions and normals from FXAA, which VTK's mappers do not."""
    def occlusion(*below):
        lit = draw(scene, below)[0]
        return np.mean((lit - draw(scene, (*below, "ssao"))[0]) / np.maximum(lit, 0.05))

    alone, lost, kept = occlusion(), occlusion("fxaa"), occlusion(*NOTHING, "fxaa")
    print(f"mean occlusion: alone {alone:.4f}, over FXAA {lost:.4f}, with ours between {kept:.4f}")
    assert abs(kept - alone) < 0.15 * alone


@pytest.mark.parametrize("scene", [points, mesh])
@pytest.mark.parametrize("chain", [
    order
    for length in (1, 2, 3)
    for names in permutations((ALL, *((name,) for name in VTK)), length)
    if ALL in names and "ssao" != (order := sum(names, ()))[-1] and "fxaa" not in order[:-1]
    and order[-2:] != ("ssao", "fxaa") and knows_positions(order)
])  # fmt: skip
def test_off_the_windows_origin(scene, chain):
    """As at the origin, where FXAA is the outermost and something is around SSAO: VTK's own draw elsewhere otherwise, FXAA
    within any other pass, and SSAO of VTK before 9.7 around all of them."""
    color, depth = draw(scene, chain)
    other, other_depth = draw_off_the_origin(scene, chain)
    assert np.abs(depth - other_depth).max() < 1e-4
    assert np.count_nonzero(changed(color, other, 0.05)) < 60
