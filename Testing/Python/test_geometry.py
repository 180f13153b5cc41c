# SPDX-License-Identifier: BSD-3-Clause
"""Wherever an actor and a camera put a mesh, a cloud of the same surface is there too, lit alike."""

import numpy as np
import pytest
from scenes import (
    MAPPERS,
    Scene,
    array,
    assert_baseline,
    assert_same_surface,
    cloud_and_mesh,
    covered_by_both,
    difference,
    still,
    torus_cloud,
    variants,
)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkCommonTransforms import vtkTransform

from pointsurface import vtkDirectPointMapper

CENTER = np.array([1e7, -2e7, 5e6])
CENTIMETRE = 0.01


def matrix(rows):
    result = vtkMatrix4x4()
    for i, row in enumerate(rows):
        for j, value in enumerate(row):
            result.SetElement(i, j, value)
    return result


def place(scene):
    scene.actor.SetPosition(0.3, 0.2, -0.1)
    scene.actor.SetOrigin(0.1, 0.0, 0.2)
    scene.actor.SetOrientation(30, 40, 50)


def stretch(scene):
    scene.actor.SetScale(0.5, 1.0, 1.4)
    scene.actor.RotateX(35)


def mirror(scene):
    """VTK 9.1 lights a mirrored mesh from behind; this one is its own mirror image."""
    scene.actor.SetScale(0.8 if scene.is_mesh else -0.8, 1.0, 1.0)
    scene.actor.RotateZ(20)


def shear_actor(scene):
    scene.actor.SetUserMatrix(matrix([[1, 0.3, 0, 0.1], [0, 1, 0.4, 0], [0, 0, 0.8, 0], [0, 0, 0, 1]]))


def turn_view(scene):
    transform = vtkTransform()
    transform.Translate(0.2, 0.1, -0.5)
    transform.RotateZ(30)
    scene.camera.SetUserViewTransform(transform)


def stretch_picture(scene):
    transform = vtkTransform()
    transform.Translate(0.2, -0.1, 0)
    transform.RotateZ(25)
    transform.Scale(0.7, 1.1, 1)
    scene.camera.SetUserTransform(transform)


def shear_picture(scene):
    transform = vtkTransform()
    transform.SetMatrix([1, 0.3, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
    scene.camera.SetUserTransform(transform)


def sheared_view(scene):
    transform = vtkTransform()
    transform.SetMatrix([1, 0.4, 0, 0, 0, 1, 0, 0, 0.2, 0, 1, 0, 0, 0, 0, 1])
    scene.camera.SetUserViewTransform(transform)


def off_axis(scene):
    """A screen beside the viewer, as in a cave."""
    camera = scene.camera
    camera.SetEyePosition(np.array([0.4, 0.2, 4.0]))
    camera.UseOffAxisProjectionOn()
    camera.SetScreenBottomLeft(-1.3, -1.5, -1)
    camera.SetScreenBottomRight(1.5, -1.5, -1)
    camera.SetScreenTopRight(1.5, 1.3, -1)
    camera.SetPosition(0, 0, 0)
    camera.SetFocalPoint(0, 0, -1)
    camera.SetViewUp(0, 1, 0)
    scene.actor.RotateX(-50)
    scene.actor.SetPosition(0, 0, -2)
    camera.SetClippingRange(0.5, 20)


def slanted_screen(scene):
    """The screen of an off-axis projection turned, so that depth is not along the view's z."""
    off_axis(scene)
    scene.camera.SetScreenBottomRight(1.4, -1.4, -1.8)
    scene.camera.SetScreenTopRight(1.3, 1.2, -2.0)


def look_oblique(scene):
    scene.camera.SetViewShear(0.4, 0.2, 1.0)
    scene.camera.ParallelProjectionOn()


def eye(which):
    def prepare(scene):
        scene.window.SetStereoCapableWindow(True)
        scene.window.SetStereoRender(True)
        scene.window.SetStereoType(which)
        scene.camera.SetEyeAngle(8)

    return prepare


VTK_STEREO_LEFT, VTK_STEREO_RIGHT = 4, 5
CASES = {
    "placed": place,
    "stretched": stretch,
    "mirrored": mirror,
    "sheared actor": shear_actor,
    "parallel": lambda s: s.camera.ParallelProjectionOn(),
    "parallel, mirrored": lambda s: (s.camera.ParallelProjectionOn(), mirror(s)),
    "turned view": turn_view,
    "oblique view": look_oblique,
    "sheared picture": shear_picture,
    "sheared picture, parallel": lambda s: (s.camera.ParallelProjectionOn(), shear_picture(s)),
    "sheared view": sheared_view,
    "sheared view, parallel": lambda s: (s.camera.ParallelProjectionOn(), sheared_view(s)),
    "turned and stretched picture": stretch_picture,
    "wide window": lambda s: s.window.SetSize(301, 149),
    "off-centre window": lambda s: s.camera.SetWindowCenter(0.4, -0.3),
    "off-axis": off_axis,
    "off-axis, a slanted screen": slanted_screen,
    "left eye": eye(VTK_STEREO_LEFT),
    "right eye": eye(VTK_STEREO_RIGHT),
    "horizontal view angle": lambda s: (s.window.SetSize(150, 220), s.camera.UseHorizontalViewAngleOn()),
}


@pytest.mark.parametrize("mapper_class, backend, name", variants(CASES))
def test_where_the_mesh_is(mapper_class, backend, name):
    cloud, mesh = cloud_and_mesh(mapper_class, CASES[name])
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    assert_same_surface(cloud, mesh)


@pytest.mark.parametrize("mapper_class, backend, name", variants(["front faces culled"]))
def test_the_inside_is_seen(mapper_class, backend, name):
    """Without what faces the viewer the far side is seen, from within."""
    if mapper_class is vtkDirectPointMapper:
        pytest.skip("knows no sides")

    def cull(scene):
        scene.actor.GetProperty().FrontfaceCullingOn()

    cloud, mesh = cloud_and_mesh(mapper_class, cull)
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    assert_same_surface(cloud, mesh, 6)
    both = covered_by_both(cloud, mesh)
    assert np.median(np.abs(cloud.depth() - mesh.depth())[both]) < 1e-3
    assert np.median((cloud.depth() - still(mapper_class).depth())[both]) > 0.02, "it is farther than the near side"


def test_the_cases_differ():
    """Cases that all look alike would prove nothing."""
    pictures = {}
    for name, prepare in CASES.items():
        scene, _ = cloud_and_mesh(MAPPERS[0], prepare)
        pictures[name] = scene.color()
    plain = Scene(MAPPERS[0], torus_cloud()).color()
    for name, picture in pictures.items():
        assert picture.shape != plain.shape or difference(picture, plain) > 2, name


@pytest.mark.parametrize("backend", ["OpenGL", "CPU"])
@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_inside_the_cloud_in_parallel(mapper_class, backend):
    """A camera amid the cloud, as ResetCamera never places it, with a near plane behind it: what lies there shows."""

    def amid(scene):
        scene.camera.ParallelProjectionOn()
        scene.camera.SetParallelScale(1.5)
        scene.camera.SetPosition(0, 0, 0.1)
        scene.camera.SetFocalPoint(0, 0, -1)
        scene.camera.SetViewUp(0, 1, 0)
        scene.camera.SetClippingRange(-3, 3)

    cloud, mesh = cloud_and_mesh(mapper_class, amid)
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    assert_same_surface(cloud, mesh)


@pytest.mark.parametrize("mapper_class, backend, scale", variants([CENTIMETRE, 1.0]))
def test_far_from_the_origin(mapper_class, backend, scale):
    """Coordinates of 1e7 with detail of a centimetre: the picture is that of the cloud at the origin."""
    pictures = []
    for center in (np.zeros(3), CENTER):
        cloud = torus_cloud()
        points = vtk_to_numpy(cloud.GetPoints().GetData()).astype(float)
        if scale == CENTIMETRE:
            points *= 20 * CENTIMETRE  # the tube is eight centimetres thick
        # doubles at 1e7 are 2e-9 apart: what is left of the points is the same in both
        points = np.round(points * 2**26) / 2**26
        cloud.GetPoints().SetData(array(points + center, kind=np.float64))
        if scale == CENTIMETRE:
            radius = 20 * CENTIMETRE * vtk_to_numpy(cloud.GetPointData().GetArray("radius"))
            cloud.GetPointData().AddArray(array(radius, "radius"))
        scene = Scene(mapper_class, cloud)
        getattr(scene.mapper, f"SetBackendTo{backend}")()
        # the direction from a focal point of the same size in both
        scene.camera.SetFocalPoint(*center)
        scene.camera.SetPosition(*(center + np.array([1.0, -3.0, 2.5])))
        scene.renderer.ResetCamera()
        scene.camera.Zoom(1.6)
        pictures.append(scene.color())
    assert np.count_nonzero(pictures[0].std(axis=-1) < 0.01) > 1000, "nothing is drawn"
    assert difference(*pictures) < 0.2
    assert np.mean(np.abs(pictures[0] - pictures[1]).max(axis=-1) > 8 / 255) < 0.002


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_picture(mapper_class):
    scene, _ = cloud_and_mesh(mapper_class, lambda s: (shear_actor(s), off_axis(s)))
    scene.color()
    assert_baseline(scene.window, f"Geometry-{mapper_class.__name__}")
