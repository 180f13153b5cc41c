# SPDX-License-Identifier: BSD-3-Clause
"""A cloud beside other props: each hides and is hidden where a mesh of the same surface is."""

import numpy as np
import pytest
from scenes import (
    ACCURACY,
    MAPPERS,
    TUBE,
    Scene,
    array,
    assert_baseline,
    assert_same_surface,
    cloud_and_mesh,
    difference,
    grow,
    input_of,
    still,
    torus_cloud,
    torus_mesh,
    variants,
)
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPiecewiseFunction
from vtkmodules.vtkFiltersSources import vtkCylinderSource, vtkPlaneSource, vtkSphereSource
from vtkmodules.vtkRenderingCore import (
    vtkActor,
    vtkColorTransferFunction,
    vtkPolyDataMapper,
    vtkPropPicker,
    vtkTextActor,
    vtkVolume,
    vtkVolumeProperty,
    vtkWorldPointPicker,
)
import vtkmodules.vtkRenderingFreeType  # noqa: F401  without it VTK crashes on text
from vtkmodules.vtkRenderingLOD import vtkLODActor, vtkQuadricLODActor
from vtkmodules.vtkRenderingUI import vtkGenericRenderWindowInteractor  # VTK's of 9.6 needs a display
from vtkmodules.vtkRenderingVolume import vtkGPUVolumeRayCastMapper
from vtkmodules.vtkRenderingVolumeOpenGL2 import vtkSmartVolumeMapper

def add_mesh(scene, source, color=(0.9, 0.5, 0.1)):
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*color)
    scene.renderer.AddActor(actor)
    scene.renderer.ResetCameraClippingRange()
    return actor


def ball(scene, center, radius):
    source = vtkSphereSource()
    source.SetCenter(*center)
    source.SetRadius(radius)
    source.SetThetaResolution(60)
    source.SetPhiResolution(60)
    return add_mesh(scene, source)


def rod_through(scene):
    source = vtkCylinderSource()
    source.SetRadius(0.2)
    source.SetHeight(4)
    source.SetResolution(60)
    add_mesh(scene, source).RotateX(20)


def plane_through(scene):
    source = vtkPlaneSource()
    source.SetOrigin(-2, -2, -0.15)
    source.SetPoint1(2, -2, 0.25)
    source.SetPoint2(-2, 2, 0.05)
    add_mesh(scene, source)


def toward_viewer(scene, share):
    return share * np.array(scene.camera.GetPosition()) + np.array([0.3, 0, 0])


def blob(mapper_class, cpu=False):
    """A half transparent cloud of mist around a part of the ring."""

    def prepare(scene):
        z, y, x = np.mgrid[-1:1:40j, -1:1:40j, -1:1:40j]
        density = 255 * np.clip(1.1 - np.sqrt(x**2 + y**2 + z**2), 0, 1)
        image = vtkImageData()
        image.SetDimensions(40, 40, 40)
        image.SetOrigin(0, -1.6, -0.5)
        image.SetSpacing(*([1.2 / 39] * 3))
        image.GetPointData().SetScalars(array(density.ravel(), "density", np.uint8))
        mapper = mapper_class()
        mapper.SetInputData(image)
        if cpu:
            mapper.SetRequestedRenderModeToRayCast()
        color, opacity = vtkColorTransferFunction(), vtkPiecewiseFunction()
        color.AddRGBPoint(0, 0.2, 0.9, 0.3)
        color.AddRGBPoint(255, 1, 0.2, 0.2)
        opacity.AddPoint(0, 0)
        opacity.AddPoint(255, 0.2)
        volume = vtkVolume()
        volume.SetMapper(mapper)
        volume.SetProperty(vtkVolumeProperty())
        volume.GetProperty().SetColor(color)
        volume.GetProperty().SetScalarOpacity(opacity)
        volume.GetProperty().SetScalarOpacityUnitDistance(0.05)
        volume.GetProperty().SetInterpolationTypeToLinear()
        scene.renderer.AddVolume(volume)
        scene.renderer.ResetCameraClippingRange()

    return prepare


COMPANY = {
    "in front": lambda s: ball(s, toward_viewer(s, 0.4), 0.3),
    "behind": lambda s: ball(s, toward_viewer(s, -0.5), 1.2),
    "a rod through": rod_through,
    "a plane through": plane_through,
    "a ball in the tube": lambda s: ball(s, (1, 0, 0.15), TUBE),
    "a volume, GPU": blob(vtkGPUVolumeRayCastMapper),
    "a volume, CPU": blob(vtkSmartVolumeMapper, cpu=True),
}


def wrong_pixels(cloud, mesh):
    return np.abs(cloud.color() - mesh.color()).max(axis=-1) > 0.1


@pytest.fixture(scope="module")
def alone():
    """For each mapper the picture without company, and the pixels, along outlines, that are another colour there."""
    clouds = {mapper_class: still(mapper_class) for mapper_class in MAPPERS}
    mesh = still(vtkPolyDataMapper, make_data=torus_mesh)
    return {mapper_class: (cloud.color(), wrong_pixels(cloud, mesh)) for mapper_class, cloud in clouds.items()}


@pytest.mark.parametrize("mapper_class, backend, name", variants(COMPANY))
def test_beside(alone, mapper_class, backend, name):
    cloud, mesh = cloud_and_mesh(mapper_class, COMPANY[name])
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    picture, wrong_alone = alone[mapper_class]
    changed = np.abs(cloud.color() - picture).max(axis=-1) > 0.1
    assert 300 < np.count_nonzero(changed) < 25000, "the company does not show, or nothing else does"
    # props hide each other in the same pixels, but for those along their borders
    wrong = wrong_pixels(cloud, mesh) & ~wrong_alone
    print(f"{name}: {np.count_nonzero(wrong)} of {np.count_nonzero(changed)} pixels differ")
    border = np.count_nonzero(grow(changed, 1) & ~changed)
    assert np.count_nonzero(wrong & grow(changed, 2)) < border
    assert np.mean(wrong) < 0.02
    assert not np.any(wrong & ~grow(~wrong, 2)), "more than a border is wrong"


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_picture(mapper_class):
    def prepare(scene):
        rod_through(scene)
        blob(vtkGPUVolumeRayCastMapper)(scene)

    cloud, _ = cloud_and_mesh(mapper_class, prepare)
    cloud.color()
    assert_baseline(cloud.window, f"Company-{mapper_class.__name__}")


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_two_clouds_interpenetrate(mapper_class):
    """A second ring, of a mapper of its own, hooked into the first one."""

    def hook(scene):
        mapper = type(scene.mapper)()
        mapper.SetInputData(input_of(type(mapper), (torus_mesh if scene.is_mesh else torus_cloud)()))
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(0.9, 0.3, 0.2)
        actor.SetPosition(0.9, 0, 0)
        actor.RotateX(80)
        scene.renderer.AddActor(actor)
        scene.renderer.ResetCamera(-1.4, 2.3, -1.4, 1.4, -1.4, 1.4)  # not by bounds, which differ

    cloud, mesh = cloud_and_mesh(mapper_class, hook)
    cloud.color()
    assert_same_surface(cloud, mesh, 8)
    wrong = np.abs(cloud.color() - mesh.color()).max(axis=-1) > 0.2
    assert wrong.mean() < 0.03


@pytest.mark.parametrize("actor_class", [vtkLODActor, vtkQuadricLODActor])
@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_levels_of_detail(mapper_class, actor_class):
    """With time to draw, an actor with levels of detail shows all of the surface; without, what it finds quickest."""
    scene = Scene(mapper_class, torus_cloud())
    cloud = scene.mapper.GetInput()
    vertices = vtkCellArray()
    for i in range(cloud.GetNumberOfPoints()):
        vertices.InsertNextCell(1, [i])
    cloud.SetVerts(vertices)  # the coarser levels are drawn by VTK, which draws no points without cells
    full = scene.color()
    actor = actor_class()
    actor.SetMapper(scene.mapper)
    scene.renderer.RemoveActor(scene.actor)
    scene.renderer.AddActor(actor)
    interactor = vtkGenericRenderWindowInteractor()
    interactor.SetRenderWindow(scene.window)
    scene.window.SetDesiredUpdateRate(1e-4)
    assert difference(scene.color(), full) < 0.2
    times = []
    for _ in range(8):
        scene.camera.Azimuth(45)  # views that are not kept
        scene.color()
        times.append(scene.mapper.GetTimeToDraw())
    assert max(times) > 1e-4, "the time that it takes is measured"
    interactor.SetDesiredUpdateRate(1e6)
    scene.window.SetDesiredUpdateRate(1e6)
    for _ in range(3):
        scene.color()
        assert np.count_nonzero(scene.depth() < 1) > 50
    scene.window.SetDesiredUpdateRate(1e-4)
    scene.color()
    assert difference(scene.color(), full) < 0.2


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_text_on_top(mapper_class):
    scene = Scene(mapper_class, torus_cloud())
    plain = scene.color()
    text = vtkTextActor()
    text.SetInput("PointSurface")
    text.SetPosition(40, 60)
    text.GetTextProperty().SetFontSize(24)
    text.GetTextProperty().SetColor(1, 0, 0)
    scene.renderer.AddViewProp(text)
    red = (scene.color() == (1, 0, 0)).all(axis=-1)
    assert np.count_nonzero(red) > 150
    rows, columns = (np.nonzero(red.any(axis=axis))[0] for axis in (1, 0))
    outside = np.ones_like(red)
    outside[rows.min() - 8 : rows.max() + 8, columns.min() - 8 : columns.max() + 8] = False
    assert np.array_equal(scene.color()[outside], plain[outside])


def distance_to_torus(point):
    x, y, z = point
    return abs(np.hypot(np.hypot(x, y) - 1, z) - TUBE)


def picked_points(scene, places):
    picker = vtkWorldPointPicker()
    for y, x in places:
        picker.Pick(int(x), int(y), 0, scene.renderer)
        yield picker.GetPickPosition()


@pytest.mark.parametrize("mapper_class, backend, parallel", variants([False, True]))
def test_pickers_land_on_the_surface(mapper_class, backend, parallel):
    """As near to it as on a mesh, where the picked position is that of a pixel's corner."""
    cloud, mesh = cloud_and_mesh(mapper_class, lambda s: s.camera.SetParallelProjection(parallel), live=True)
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    for scene in (cloud, mesh):
        scene.color()
    covered = ~grow((cloud.depth() == 1) | (mesh.depth() == 1), 3)
    places = np.argwhere(covered)[:: max(1, np.count_nonzero(covered) // 100)]
    distances = [[distance_to_torus(p) for p in picked_points(scene, places)] for scene in (cloud, mesh)]
    assert np.mean(distances[0]) < np.mean(distances[1]) + 0.001 * ACCURACY[mapper_class].factor
    farthest = np.max(distances[1]) + 0.015 * ACCURACY[mapper_class].factor
    assert np.max(distances[0]) < farthest
    picker = vtkPropPicker()
    for y, x in places[::20]:
        assert picker.Pick(int(x), int(y), 0, cloud.renderer)
        assert picker.GetViewProp() is cloud.actor
        assert distance_to_torus(picker.GetPickPosition()) < farthest
    assert not picker.Pick(2, 2, 0, cloud.renderer)
