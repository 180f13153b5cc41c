# SPDX-License-Identifier: BSD-3-Clause
"""The surface itself as a picture, a normal and a depth for each pixel: its mesh, drawn by VTK and supersampled."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals, vtkTriangleFilter
from vtkmodules.vtkRenderingCore import vtkActor, vtkCamera, vtkPolyDataMapper, vtkProperty, vtkRenderer
from vtkmodules.vtkRenderingOpenGL2 import vtkCameraPass, vtkRenderPassCollection, vtkSequencePass, vtkValuePass

from .metrics import SurfaceImage
from .rendering import box_average, offscreen_window, read_color

_POINT_FIELD_DATA = 3  # VTK_SCALAR_MODE_USE_POINT_FIELD_DATA


def render_truth(mesh, renderer, surface_property, size, supersampling=4):
    """A SurfaceImage of a mesh as `renderer` sees it: its camera, lights and background.

    mesh: vtkPolyData of polygons or strips with point normals.
    surface_property: the vtkProperty of the surface.
    size: (width, height) in pixels.
    supersampling: samples along each side of a pixel; 4 gives 16 samples a pixel. Normals and depth are at the pixels'
    centres. Normals are oriented as the mesh's, also where its back is seen.
    Raises ValueError for a mesh without polygons or without normals.
    """
    surface = _triangles_of(mesh)
    scene = _SceneOfOneSurface(surface, renderer, surface_property, size)
    color = box_average(read_color(scene.window, supersampling), supersampling)
    normals, depth = _normals_and_depth(scene, surface)
    return SurfaceImage(color, normals, depth)


def sample_depth(mesh, renderer, size, samples=4):
    """The depth of a mesh, as `renderer` sees it, at samples x samples places of each pixel, evenly apart.

    mesh, size: as in render_truth.
    Returns an array of (height, width, samples, samples), from the lowest row of a pixel and its left: the distance from
    the eye along the view direction, 0 where there is no surface.
    Raises ValueError as render_truth does.
    """
    surface = _triangles_of(mesh)
    width, height = size
    scene = _SceneOfOneSurface(surface, renderer, vtkProperty(), (width * samples, height * samples))
    _, depth = _normals_and_depth(scene, surface)
    return depth.reshape(height, samples, width, samples).swapaxes(1, 2)


def _triangles_of(mesh):
    triangles = vtkTriangleFilter()
    triangles.PassVertsOff()
    triangles.PassLinesOff()
    triangles.SetInputData(mesh)
    triangles.Update()
    surface = triangles.GetOutput()
    if surface.GetNumberOfPolys() == 0:
        raise ValueError("the mesh of the true surface has no polygons")
    if surface.GetPointData().GetNormals() is None:
        raise ValueError("the mesh of the true surface has no point normals")
    return surface


def mend_normals(mesh):
    """Gives a mesh normals where it has undefined ones: those of VTK's contours are no numbers, or zero, where the
    gradient vanishes; there the triangles' mean is taken."""
    normals = vtk_to_numpy(mesh.GetPointData().GetNormals()).copy()
    undefined = ~(np.linalg.norm(normals, axis=1) > 0.5)
    if np.any(undefined):
        normals[undefined] = vtk_to_numpy(with_normals(mesh).GetPointData().GetNormals())[undefined]
        array = numpy_to_vtk(normals, deep=True)
        array.SetName("Normals")
        mesh.GetPointData().SetNormals(array)


def with_normals(mesh):
    """The mesh with nothing but point normals, the means of its triangles', and its structure as it is."""
    bare = vtkPolyData()
    bare.CopyStructure(mesh)
    normals = vtkPolyDataNormals()
    normals.SetInputData(bare)
    normals.SplittingOff()
    normals.ConsistencyOff()
    normals.Update()
    return normals.GetOutput()


class _SceneOfOneSurface:
    """A surface alone in a window, with the camera, lights and background of another renderer."""

    def __init__(self, surface, like, surface_property, size):
        self.mapper = vtkPolyDataMapper()
        self.mapper.SetInputData(surface)
        actor = vtkActor()
        actor.SetMapper(self.mapper)
        actor.SetProperty(surface_property)
        self.renderer = vtkRenderer()
        self.renderer.SetBackground(like.GetBackground())
        self.renderer.SetAmbient(like.GetAmbient())
        for light in like.GetLights():
            self.renderer.AddLight(light)
        self.renderer.AddActor(actor)
        camera = vtkCamera()
        camera.DeepCopy(like.GetActiveCamera())
        self.renderer.SetActiveCamera(camera)
        self.renderer.ResetCameraClippingRange()
        self.window = offscreen_window(self.renderer, size)
        self.size = size

    def show(self, polydata):
        self.mapper.SetInputData(polydata)

    def read_values(self, names):
        """Point arrays of one component at the pixels' centres, with no shading: name to (height, width)."""
        values = vtkValuePass()
        values.SetInputComponentToProcess(0)
        passes = vtkRenderPassCollection()
        passes.AddItem(values)
        sequence = vtkSequencePass()
        sequence.SetPasses(passes)
        with_camera = vtkCameraPass()
        with_camera.SetDelegatePass(sequence)
        self.renderer.SetPass(with_camera)
        # The pass's first frame, which allocates its framebuffer, is drawn without a depth test.
        values.SetInputArrayToProcess(_POINT_FIELD_DATA, names[0])
        self.window.Render()

        result = {}
        width, height = self.size
        for name in names:
            values.SetInputArrayToProcess(_POINT_FIELD_DATA, name)
            self.window.Render()
            result[name] = vtk_to_numpy(values.GetFloatImageDataArray(self.renderer)).reshape(height, width).copy()
        self.renderer.SetPass(None)
        values.ReleaseGraphicsResources(self.window)
        return result


def _normals_and_depth(scene, surface):
    """Eye-space unit normals (height, width, 3) and depth (height, width), both 0 where there is no surface."""
    scene.show(_with_eye_space_arrays(surface, scene.renderer.GetActiveCamera()))
    axes = [f"normal {axis}" for axis in "xyz"]
    values = scene.read_values(["depth", *axes])
    mask = np.isfinite(values["depth"])  # the pass clears to NaN
    normals = np.where(mask[..., None], np.stack([values[name] for name in axes], axis=-1), 0)
    normals /= np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-30)
    return normals, np.where(mask, values["depth"], 0)


def _with_eye_space_arrays(surface, camera):
    """The surface with its eye depth and eye-space normal per point, one array a component."""
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    normals = vtk_to_numpy(surface.GetPointData().GetNormals()).astype(float)
    matrix = camera.GetViewTransformMatrix()
    view = np.array([[matrix.GetElement(row, column) for column in range(4)] for row in range(4)])
    eye_points = points @ view[:3, :3].T + view[:3, 3]
    eye_normals = normals @ view[:3, :3].T

    result = vtkPolyData()
    result.ShallowCopy(surface)
    _add_array(result.GetPointData(), "depth", -eye_points[:, 2])
    for i, axis in enumerate("xyz"):
        _add_array(result.GetPointData(), f"normal {axis}", eye_normals[:, i])
    return result


def _add_array(data, name, values):
    array = numpy_to_vtk(values.astype(np.float32), deep=True)
    array.SetName(name)
    data.AddArray(array)
