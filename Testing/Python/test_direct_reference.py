# SPDX-License-Identifier: BSD-3-Clause
"""vtkDirectPointMapper with all departures off beside the double-precision reference, from the same image buffer."""

import os
import sys

import numpy as np
import pytest
from scenes import array
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkImageData, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer

from pointsurface import rendering, vtkDirectPointMapper

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "Reference"))
import direct_reference  # noqa: E402

DIFFERING_SHARE = 1e-3
TOLERANCE = 1e-4


def cloud(count, seed=7):
    """Two noisy spheres, one partly before the other, with scalars."""
    random = np.random.default_rng(seed)
    normals = random.normal(size=(count, 3))
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    size = np.where(np.arange(count) % 2, 1.0, 0.5)[:, None]
    shift = np.where(np.arange(count) % 2, 0.0, 1.1)[:, None] * (0.4, 0.2, 1.0)
    noise = 0.3 * np.sqrt(4 * np.pi / count) * random.normal(size=(count, 1))
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(array(normals * (size + noise) + shift))
    data.GetPointData().SetScalars(array(normals[:, 1], "height"))
    return data


class Frame:
    """A mapper, as published, after one frame."""

    def __init__(self, count, size, backend, parallel=False, colors=False, zoom=1.5, radius=None):
        self.cloud = cloud(count)
        self.mapper = vtkDirectPointMapper()
        self.mapper.SetInputData(self.cloud)
        self.mapper.SetToPublished()
        # the paper's resolution is the frame's for such scenes: a coarser buffer has more to show
        self.mapper.PublishedResolutionOff()
        self.mapper.SetRadius(radius or 1.2 * np.sqrt(4 * np.pi / count))
        self.mapper.SetScalarVisibility(colors)
        self.mapper.SetScalarRange(-1, 1)
        self.mapper.RecordPointIdsOn()
        self.mapper.SetBackend(getattr(vtkDirectPointMapper, backend))
        actor = vtkActor()
        actor.SetMapper(self.mapper)
        self.renderer = vtkRenderer()
        self.renderer.AddActor(actor)
        self.window = rendering.offscreen_window(self.renderer, size)
        self.renderer.ResetCamera()
        self.renderer.GetActiveCamera().SetParallelProjection(parallel)
        self.renderer.GetActiveCamera().Azimuth(20)
        self.renderer.GetActiveCamera().Zoom(zoom)
        self.renderer.ResetCameraClippingRange()
        self.window.Render()
        self.size = size

    def read(self):
        """The Points of the two passes, and the surface buffer as arrays by name."""
        nearest, farthest, surface = vtkImageData(), vtkImageData(), vtkImageData()
        assert self.mapper.ReadImageBuffer(nearest, farthest)
        assert self.mapper.ReadSurfaceBuffer(surface)
        field = nearest.GetFieldData()
        self.projection = vtk_to_numpy(field.GetArray("Projection")).reshape(4, 4)
        self.gamma = field.GetArray("Gamma").GetValue(0)
        # with the rim, that the image buffer reaches over the viewport by where the cloud does
        self.whole_size = tuple(vtk_to_numpy(field.GetArray("Size")))
        return self._points(nearest), self._points(farthest), _arrays(surface)

    def crop(self, surface):
        """The viewport of a surface buffer with a rim."""
        left, bottom = ((whole - size) // 2 for whole, size in zip(self.whole_size, self.size))
        viewport = np.s_[bottom : bottom + self.size[1], left : left + self.size[0]]
        layers = vars(surface).items()
        return direct_reference.Surface(**{name: None if layer is None else layer[viewport] for name, layer in layers})

    @staticmethod
    def _points(image):
        layers = _arrays(image)
        valid = layers["Valid"] > 0
        return direct_reference.Points(
            np.where(valid, layers["Depth"], 0), layers["Displacement"], layers.get("Colors"), layers["PointIds"]
        )


def _arrays(image):
    width, height, _ = image.GetDimensions()
    data = image.GetPointData()
    result = {}
    for i in range(data.GetNumberOfArrays()):
        values = vtk_to_numpy(data.GetArray(i))
        values = values.astype(float) if values.dtype == np.float32 else values
        result[data.GetArrayName(i)] = values.reshape(height, width, *values.shape[1:])
    return result


SCENES = [
    dict(count=6000, size=(160, 120)),
    dict(count=6000, size=(160, 120), colors=True, parallel=True),
    dict(count=200, size=(161, 97), zoom=1),
    dict(count=4000, size=(97, 133), colors=True, zoom=6),
    dict(count=20000, size=(40, 31), parallel=True),  # as many cells as pixels
    dict(count=1000, size=(3, 2)),
    dict(count=1000, size=(1, 1)),
]


@pytest.mark.parametrize("backend", ["CPU", "OpenGL"])
@pytest.mark.parametrize("scene", SCENES, ids=str)
def test_agreement(scene, backend):
    frame = Frame(backend=backend, **scene)
    nearest, farthest, surface = frame.read()
    expected = frame.crop(direct_reference.reconstruct(nearest, farthest, frame.projection, frame.whole_size))
    covered = (expected.depth > 0) | (surface["Depth"] > 0)
    near = expected.near_decision & covered
    differs = covered & (((expected.depth > 0) != (surface["Depth"] > 0)) | (expected.ids != surface["PointIds"]))
    same = covered & ~near & ~differs
    worst = {
        "normal": np.abs(expected.normals - surface["Normals"])[same].max(initial=0),
        "depth": (np.abs(expected.depth - surface["Depth"])[same] / expected.depth[same]).max(initial=0),
    }
    if expected.colors is not None:
        worst["color"] = np.abs(expected.colors - surface["Colors"])[same].max(initial=0)
    print(
        f"covered {covered.sum()}, near a decision {near.sum()} ({(near & differs).sum()} differing), "
        f"differing {(differs & ~near).sum()}, worst {worst}"
    )
    assert covered.sum() >= 0.1 * covered.size
    assert near.sum() <= max(1, 0.02 * covered.sum())
    assert (differs & ~near).sum() <= DIFFERING_SHARE * covered.sum()
    assert all(difference <= TOLERANCE for difference in worst.values())


@pytest.mark.parametrize("backend", ["CPU", "OpenGL"])
@pytest.mark.parametrize("scene", SCENES[:2], ids=str)
def test_shaded_before_splatting(scene, backend):
    """The picture has the means of lit colours, not the light on mean normals; both within a rounding to bytes."""
    frame = Frame(backend=backend, **scene)
    nearest, farthest, surface = frame.read()

    def lit(colors, normals, means):
        cosines = np.clip(normals[..., 2:], 0, None)  # to the headlight
        return cosines * (np.ones_like(cosines) if colors is None else colors) * np.ones(4)

    expected = frame.crop(direct_reference.reconstruct(nearest, farthest, frame.projection, frame.whole_size, lit))
    sure = (expected.depth > 0) & (surface["Depth"] > 0) & ~expected.near_decision
    assert sure.sum() > 5000
    early = np.abs(rendering.read_color(frame.window) - expected.colors[..., :3])[sure]
    frame.mapper.ShadeBeforeSplattingOff()
    once = np.abs(rendering.read_color(frame.window) - lit(surface.get("Colors"), surface["Normals"], None)[..., :3])[sure]
    between = np.abs(lit(surface.get("Colors"), surface["Normals"], None) - expected.colors)[sure]
    print(f"early {early.max()}, once {once.max()}, between them {between.max()}")
    assert early.max() < 0.6 / 255
    assert once.max() < 0.6 / 255
    assert between.max() > 0.05  # or there was no difference to see


@pytest.mark.parametrize("backend", ["CPU", "OpenGL"])
def test_passes_select_the_nearest_and_the_farthest_points(backend):
    frame = Frame(6000, (160, 120), backend, radius=0.1)
    nearest, farthest, _ = frame.read()
    points = vtk_to_numpy(frame.cloud.GetPoints().GetData()).astype(float)
    view = frame.renderer.GetActiveCamera().GetViewTransformMatrix()
    view = np.array([[view.GetElement(i, j) for j in range(4)] for i in range(4)])
    eye = points @ view[:3, :3].T + view[:3, 3]
    expected = direct_reference.select_points(eye, frame.projection, nearest.ids.shape[::-1], frame.gamma)
    for ids, points in zip(expected, (nearest, farthest)):
        assert (ids != points.ids).sum() <= 0.002 * (ids >= 0).sum()
    two = (expected[0] >= 0) & (expected[0] != expected[1])
    assert two.sum() > 100  # the second pass had something to find
