# SPDX-License-Identifier: BSD-3-Clause
"""A cloud has the colours that a mesh of the same surface has, wherever VTK takes them from."""

import numpy as np
import pytest
from scenes import (
    BACKENDS,
    MAPPERS,
    Scene,
    array,
    assert_baseline,
    assert_same_surface,
    cloud_and_mesh,
    covered_by_both,
    difference,
    torus_cloud,
    variants,
)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkColorTransferFunction, vtkTexture

def positions(scene):
    return vtk_to_numpy(scene.mapper.GetInput().GetPoints().GetData())


def data_of(scene):
    return scene.mapper.GetInput().GetPointData()


def wave(scene):
    x, y, z = positions(scene).T
    return np.sin(2 * x) * np.cos(1.5 * y) + 0.5 * z


def table():
    result = vtkLookupTable()
    result.SetNumberOfTableValues(64)
    result.SetHueRange(0.7, 0)
    result.SetValueRange(0.7, 1)
    result.SetTableRange(-1, 1)
    result.SetNanColor(0.9, 0.1, 0.9, 1)
    result.Build()
    return result


def use_scalars(scene, values=None, lookup_table=None):
    data_of(scene).SetScalars(array(wave(scene) if values is None else values, "wave"))
    scene.mapper.SetLookupTable(lookup_table or table())
    scene.mapper.SetScalarRange(-1, 1)


def by_name(scene):
    data_of(scene).AddArray(array(wave(scene), "wave"))
    data_of(scene).AddArray(array(-wave(scene), "other"))
    scene.mapper.SetScalarModeToUsePointFieldData()
    scene.mapper.SelectColorArray("wave")
    scene.mapper.SetLookupTable(table())
    scene.mapper.SetScalarRange(-1, 1)


def by_component(scene):
    values = np.stack([wave(scene), -wave(scene), positions(scene)[:, 2]], axis=-1)
    data_of(scene).AddArray(array(values, "vectors"))
    lookup_table = table()
    lookup_table.SetVectorModeToComponent()
    lookup_table.SetVectorComponent(1)
    scene.mapper.SetScalarModeToUsePointFieldData()
    scene.mapper.SelectColorArray("vectors")
    scene.mapper.SetLookupTable(lookup_table)
    scene.mapper.SetScalarRange(-1, 1)


def transfer_function(scene):
    function = vtkColorTransferFunction()
    for value, color in ((-1, (0, 0.2, 0.9)), (0, (0.9, 0.9, 0.9)), (1, (0.9, 0.3, 0))):
        function.AddRGBPoint(value, *color)
    use_scalars(scene, lookup_table=function)


def interpolated(scene):
    use_scalars(scene)
    scene.mapper.InterpolateScalarsBeforeMappingOn()


def not_a_number(scene):
    use_scalars(scene, np.where(positions(scene)[:, 0] > 0.2, np.nan, wave(scene)))


def beyond_the_range(scene):
    use_scalars(scene, 2 * wave(scene))
    lookup_table = scene.mapper.GetLookupTable()
    lookup_table.SetAboveRangeColor(1, 1, 1, 1)
    lookup_table.SetBelowRangeColor(0.1, 0.1, 0.1, 1)
    lookup_table.UseAboveRangeColorOn()
    lookup_table.UseBelowRangeColorOn()


def direct(components, kind):
    def prepare(scene):
        x, y, z = positions(scene).T
        color = np.stack([0.5 + 0.3 * x, 0.5 + 0.3 * y, 0.5 + z, np.ones_like(x)], axis=-1)[:, :components]
        color = np.clip(color, 0, 1)
        data_of(scene).SetScalars(array(255 * color if kind == np.uint8 else color, "color", kind))
        scene.mapper.SetColorModeToDirectScalars()

    return prepare


def hidden(scene):
    use_scalars(scene)
    scene.mapper.ScalarVisibilityOff()
    scene.actor.GetProperty().SetColor(0.9, 0.6, 0.1)


def of_cells(scene):
    """The cloud's cells are its points; those of the mesh are too small to tell from points."""
    data = scene.mapper.GetInput()
    if scene.is_mesh:
        corners = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 4)
        values = wave(scene)[corners].mean(axis=1)
    else:
        vertices = vtkCellArray()
        for i in range(data.GetNumberOfPoints()):
            vertices.InsertNextCell(1, [i])
        data.SetVerts(vertices)
        values = wave(scene)
    data.GetCellData().SetScalars(array(values, "wave"))
    scene.mapper.SetScalarModeToUseCellData()
    scene.mapper.SetLookupTable(table())
    scene.mapper.SetScalarRange(-1, 1)


def of_field_data(scene):
    """One tuple of the field data for the whole surface."""
    scene.mapper.GetInput().GetFieldData().AddArray(array([-0.9, 0.7, 0.1], "of the whole"))
    scene.mapper.SetScalarModeToUseFieldData()
    scene.mapper.SelectColorArray("of the whole")
    scene.mapper.SetFieldDataTupleId(1)
    scene.mapper.SetLookupTable(table())
    scene.mapper.SetScalarRange(-1, 1)


def checkers():
    y, x = np.indices((64, 64))
    color = np.where(((x // 16 + y // 16) % 2)[..., None] == 1, (230, 200, 40), (40, 60, 160))
    image = vtkImageData()
    image.SetDimensions(64, 64, 1)
    image.GetPointData().SetScalars(array(color.reshape(-1, 3), kind=np.uint8))
    texture = vtkTexture()
    texture.SetInputData(image)
    texture.InterpolateOn()
    return texture


def in_srgb():
    texture = checkers()
    texture.UseSRGBColorSpaceOn()
    return texture


def wrapped_floats():
    """Grey values that a table maps, mirrored beyond the unit square, turned and scaled."""
    y, x = np.indices((48, 64))
    image = vtkImageData()
    image.SetDimensions(64, 48, 1)
    image.GetPointData().SetScalars(array((np.sin(x / 8) + np.cos(y / 6)).ravel()))
    lookup_table = table()
    lookup_table.SetTableRange(-2, 2)
    texture = vtkTexture()
    texture.SetInputData(image)
    texture.SetLookupTable(lookup_table)
    texture.InterpolateOn()
    texture.SetWrap(vtkTexture.MirroredRepeat)
    transform = vtkTransform()
    transform.RotateZ(30)
    transform.Scale(2, 1.5, 1)
    texture.SetTransform(transform)
    return texture


def textured(scene, texture=None):
    data_of(scene).SetTCoords(array(0.5 + 0.35 * positions(scene)[:, :2], "tcoords"))
    scene.actor.SetTexture(texture or checkers())


def textured_and_interpolated(scene):
    """Of a mesh VTK 9.1 looks the texture up at the scalars' place in the table, so that one is not interpolated."""
    (use_scalars if scene.is_mesh else interpolated)(scene)
    textured(scene)


def replaced(scene):
    """What users put into VTK's shaders applies: their code, and their uniforms."""
    prop = scene.actor.GetShaderProperty()
    prop.GetFragmentCustomUniforms().SetUniformf("share", 0.8)
    prop.AddFragmentShaderReplacement(
        "//VTK::Light::Impl",
        True,
        "//VTK::Light::Impl\n  fragOutput0.rgb = share * fragOutput0.brg + 0.2 * abs(normalVCVSOutput);\n",
        False,
    )
    scene.actor.GetProperty().SetColor(0.3, 0.6, 0.9)


CASES = {
    "by name": by_name,
    "by component": by_component,
    "lookup table": use_scalars,
    "transfer function": transfer_function,
    "interpolated before mapping": interpolated,
    "NaN": not_a_number,
    "beyond the range": beyond_the_range,
    "RGB of bytes": direct(3, np.uint8),
    "RGBA of bytes": direct(4, np.uint8),
    "RGB of floats": direct(3, np.float32),
    "RGBA of floats": direct(4, np.float32),
    "not visible": hidden,
    "of cells": of_cells,
    "field data": of_field_data,
    "texture": textured,
    "texture under colours": lambda s: (use_scalars(s), textured(s)),
    "texture under interpolated colours": textured_and_interpolated,
    "texture in sRGB under colours": lambda s: (use_scalars(s), textured(s, in_srgb())),
    "texture of floats under RGBA": lambda s: (direct(4, np.uint8)(s), textured(s, wrapped_floats())),
    "shader replacement": replaced,
}
SHARP = {
    "NaN": 6,
    "beyond the range": 5,
    "texture": 6,
    "texture under colours": 6,
    "texture in sRGB under colours": 6,
    "texture under interpolated colours": 6,
    "lookup table": 3.5,
    "by name": 3.5,
    "by component": 3.5,
    "of cells": 4,
}


@pytest.mark.parametrize("mapper_class, backend, name", variants(CASES))
def test_coloured_as_the_mesh(mapper_class, backend, name):
    cloud, mesh = cloud_and_mesh(mapper_class, CASES[name])
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    assert_same_surface(cloud, mesh, SHARP.get(name, 3.0))
    plain = Scene(mapper_class, torus_cloud())
    assert difference(cloud.color(), plain.color(), covered_by_both(cloud, plain)) > 20, "no colour is seen"


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_colour_bar(mapper_class):
    """The bar beside a cloud is the bar beside a mesh, and its colours are those of the cloud."""

    def with_bar(scene):
        use_scalars(scene)
        scene.actor.GetProperty().LightingOff()
        bar = vtkScalarBarActor()
        bar.SetLookupTable(scene.mapper.GetLookupTable())
        bar.SetDrawTickLabels(False)
        bar.SetPosition(0.85, 0.1)
        bar.SetWidth(0.1)
        scene.renderer.AddViewProp(bar)

    cloud, mesh = cloud_and_mesh(mapper_class, with_bar, size=(260, 200))
    pictures = cloud.color(), mesh.color()
    both = covered_by_both(cloud, mesh)
    outside = (cloud.depth() == 1) & (mesh.depth() == 1)
    assert np.array_equal(pictures[0][outside], pictures[1][outside])
    bar = pictures[0][:, 225:240].reshape(-1, 3)
    distance = np.abs(pictures[0][both][::7, None] - bar[None, ::15]).max(axis=-1).min(axis=1)
    assert np.mean(distance) < 0.02
    assert_baseline(cloud.window, f"Colors-{mapper_class.__name__}")


def test_a_texture_that_changes():
    """The texture under colours is looked up anew when its image does, and is gone when the actor has none."""
    scene, _ = cloud_and_mesh(MAPPERS[0], lambda s: (use_scalars(s), textured(s)))
    first = scene.color()
    bytes_of_image = vtk_to_numpy(scene.actor.GetTexture().GetInput().GetPointData().GetScalars())
    bytes_of_image[:] = bytes_of_image // 2
    scene.actor.GetTexture().GetInput().Modified()
    second = scene.color()
    assert difference(first, second) > 5
    scene.actor.SetTexture(None)
    colored = cloud_and_mesh(MAPPERS[0], use_scalars)[0].color()
    assert np.array_equal(scene.color(), colored)


@pytest.mark.parametrize("mapper_class", MAPPERS)
@pytest.mark.parametrize("lack", ["colours", "coordinates"])
def test_textures_of_the_property_that_cannot_be_drawn_are_warned_of(mapper_class, lack):
    """They are material, not colour: a pixel has room for colours or for their coordinates."""

    def material(scene, texture=None):
        scene.actor.GetProperty().SetInterpolationToPBR()
        scene.actor.GetProperty().SetBaseColorTexture(texture)
        if lack == "colours":
            use_scalars(scene)

    texture = checkers()
    texture.UseSRGBColorSpaceOn()
    scene = Scene(mapper_class, torus_cloud())
    if lack == "colours":
        textured(scene)
        scene.actor.SetTexture(None)
    material(scene, texture)
    warnings = []
    scene.mapper.AddObserver("WarningEvent", lambda *_: warnings.append(1))
    picture = scene.color()
    assert len(warnings) == 1
    plain = Scene(mapper_class, torus_cloud())
    material(plain)
    assert difference(picture, plain.color()) < 0.1


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_opacity_of_colours(mapper_class, backend):
    """An alpha in the colours blends a cloud with what is behind it."""

    def half(scene):
        direct(4, np.uint8)(scene)
        vtk_to_numpy(data_of(scene).GetScalars())[:, 3] = 128
        scene.actor.GetProperty().BackfaceCullingOn()
        scene.renderer.UseDepthPeelingOn()

    cloud, mesh = cloud_and_mesh(mapper_class, half)
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    opaque = cloud_and_mesh(mapper_class, direct(4, np.uint8))[0]
    inside = opaque.color(), opaque.depth() < 1
    background = np.array([0.1, 0.2, 0.3])
    blended = 0.5 * inside[0] + 0.5 * background
    assert difference(cloud.color(), blended, inside[1]) < 3
