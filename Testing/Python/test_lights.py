# SPDX-License-Identifier: BSD-3-Clause
"""Whatever lights and material a mesh may have, a cloud of the same surface is lit alike."""

import numpy as np
import pytest
from scenes import (
    MAPPERS,
    TUBE,
    Scene,
    array,
    assert_baseline,
    cloud_and_mesh,
    covered_by_both,
    difference,
    torus_cloud,
    torus_mesh,
)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import vtkLight, vtkLightKit, vtkTexture


def add_light(scene, position, kind="SceneLight", **settings):
    scene.renderer.AutomaticLightCreationOff()
    light = vtkLight()
    getattr(light, f"SetLightTypeTo{kind}")()
    light.SetPosition(*position)
    light.SetFocalPoint(0, 0, 0)
    for name, value in settings.items():
        getattr(light, f"Set{name}")(*(value if isinstance(value, tuple) else (value,)))
    scene.renderer.AddLight(light)


def several(scene):
    """Together no brighter than the headlight, or errors would be larger for that alone."""
    add_light(scene, (3, -2, 4), Color=(0.7, 0.4, 0.2))
    add_light(scene, (-4, -1, 1), Color=(0.1, 0.3, 0.7))
    add_light(scene, (0, -3, 1.5), Positional=True, AttenuationValues=(0.5, 0, 0.2), Color=(0.2, 0.4, 0.2))


def light_kit(scene):
    scene.renderer.AutomaticLightCreationOff()
    scene.kit = vtkLightKit()
    scene.kit.AddLightsToRenderer(scene.renderer)


LIGHTS = {
    "camera light": lambda s: add_light(s, (1, 1, 1), "CameraLight"),
    "scene light": lambda s: add_light(s, (3, -2, 4)),
    "coloured": lambda s: add_light(s, (3, -2, 4), Color=(0.9, 0.5, 0.2), Intensity=0.8),
    "positional, attenuated": lambda s: add_light(s, (1, -3, 2), Positional=True, AttenuationValues=(0.1, 0.1, 0.1)),
    "positional, cone": lambda s: add_light(
        s, (0.5, -2, 2.5), Positional=True, ConeAngle=20, Exponent=2, AttenuationValues=(1, 0, 0)
    ),
    "several": several,
    "light kit": light_kit,
}


def environment_texture():
    """A sky that is bright and blue above, brown below, with a warm side."""
    up, around = np.meshgrid(np.linspace(-1, 1, 16), np.linspace(0, 2 * np.pi, 32), indexing="ij")
    color = np.stack([0.5 + 0.3 * np.cos(around), 0.45 + 0.25 * up, 0.4 + 0.4 * up], axis=-1)
    image = vtkImageData()
    image.SetDimensions(32, 16, 1)
    image.GetPointData().SetScalars(array(np.clip(color, 0, 1).reshape(-1, 3)))
    texture = vtkTexture()
    texture.SetInputData(image)
    texture.SetColorModeToDirectScalars()
    texture.MipmapOn()
    texture.InterpolateOn()
    return texture


def use_environment(scene):
    scene.renderer.UseImageBasedLightingOn()
    scene.renderer.SetEnvironmentTexture(environment_texture())
    scene.renderer.SetEnvironmentUp(0, 0, 1)
    scene.renderer.SetEnvironmentRight(1, 0, 0)
    # small, since software renderers take seconds for the default
    scene.renderer.GetEnvMapLookupTable().SetLUTSize(128)
    scene.renderer.GetEnvMapLookupTable().SetLUTSamples(64)
    scene.renderer.GetEnvMapPrefiltered().SetPrefilterMaxSamples(64)


def specular(prop):
    prop.SetSpecular(0.3)
    prop.SetSpecularPower(10)
    prop.SetSpecularColor(1, 0.8, 0.8)
    prop.SetAmbient(0.2)
    prop.SetAmbientColor(0.3, 0.4, 0.9)
    prop.SetDiffuse(0.7)


def pbr(prop):
    prop.SetInterpolationToPBR()
    prop.SetMetallic(0.4)
    prop.SetRoughness(0.5)
    prop.SetColor(0.9, 0.8, 0.6)


MATERIALS = {
    "Gouraud": lambda s: s.actor.GetProperty().SetInterpolationToGouraud(),
    "Phong": lambda s: s.actor.GetProperty().SetInterpolationToPhong(),
    "specular and ambient": lambda s: specular(s.actor.GetProperty()),
    "PBR": lambda s: pbr(s.actor.GetProperty()),
    "PBR in an environment": lambda s: (pbr(s.actor.GetProperty()), use_environment(s)),
    "no lighting": lambda s: (s.actor.GetProperty().LightingOff(), s.actor.GetProperty().SetColor(0.9, 0.5, 0.2)),
    "PBR, several lights": lambda s: (pbr(s.actor.GetProperty()), several(s)),
}


def eye_depth(scene):
    near, far = scene.camera.GetClippingRange()
    return near * far / (far - scene.depth() * (far - near))


def inner_difference(mapper_class, prepare, data=(torus_cloud, torus_mesh)):
    """In grey levels, over what both cover: the mean over all channels, and the mean of each pixel's largest one.

    Where the tube's front ends before its back, a few pixels show the one in the cloud and the other in the mesh. What they
    differ by is the contrast there, which is the lights' and not the mapper's, and would be most of the mean of a mapper
    whose normals are good: they are counted instead.
    """
    cloud, mesh = cloud_and_mesh(mapper_class, prepare, data)
    pictures = cloud.color(), mesh.color()
    mask = covered_by_both(cloud, mesh)
    assert np.count_nonzero(mask) > 8000
    other_sheet = mask & (np.abs(eye_depth(cloud) - eye_depth(mesh)) > TUBE / 4)
    assert np.count_nonzero(other_sheet) <= 0.003 * np.count_nonzero(mask)
    mask &= ~other_sheet
    assert pictures[0][mask].std() > 0.02 or not cloud.actor.GetProperty().GetLighting(), "nothing is lit"
    of_channels = 255 * np.abs(pictures[0] - pictures[1])[mask]
    return float(of_channels.mean()), difference(*pictures, mask)


@pytest.fixture(scope="module", params=MAPPERS, ids=lambda m: m.__name__)
def plain(request):
    """The mapper, and its difference from the mesh with the headlight and the default material."""
    return request.param, inner_difference(request.param, lambda scene: None)


@pytest.mark.parametrize("name", [*LIGHTS, *MATERIALS])
def test_lit_as_the_mesh(plain, name):
    """The mean difference is at most 1.1 times that of the headlight, whose light is white.

    The largest channel has a floor of a grey level, and more room: with coloured lights each of a pixel's channels is rounded
    by itself, with white ones all three together, so that the largest of three is larger for the same normals.
    """
    mapper_class, headlight = plain
    other = inner_difference(mapper_class, {**LIGHTS, **MATERIALS}[name])
    print(f"{name}: {other[0]:.3f} and {other[1]:.3f}, headlight: {headlight[0]:.3f} and {headlight[1]:.3f}")
    assert other[0] <= 1.1 * headlight[0]
    assert other[1] <= max(1.15 * headlight[1], 1.0)


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_flat_interpolation_is_smooth(mapper_class):
    """A cloud has no facets to be flat."""
    scene = Scene(mapper_class, torus_cloud())
    smooth = scene.color()
    scene.actor.GetProperty().SetInterpolationToFlat()
    assert np.array_equal(scene.color(), smooth)


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_two_sided(mapper_class):
    """Normals that point inwards are lit as those that point outwards."""

    def turned_cloud():
        cloud = torus_cloud()
        cloud.GetPointData().SetNormals(array(-vtk_to_numpy(cloud.GetPointData().GetNormals()), "Normals"))
        return cloud

    assert inner_difference(mapper_class, several, (turned_cloud, torus_mesh)) == pytest.approx(
        inner_difference(mapper_class, several), rel=0.2, abs=1.0
    )


def test_the_lights_differ():
    """Set-ups that all look alike would prove nothing."""
    cloud, _ = cloud_and_mesh(MAPPERS[0])
    pictures = {"headlight": cloud.color()}
    for name, prepare in {**LIGHTS, **MATERIALS}.items():
        if name not in ("Gouraud", "Phong"):
            scene, _ = cloud_and_mesh(MAPPERS[0], prepare)
            pictures[name] = scene.color()
    names = list(pictures)
    for i, a in enumerate(names):
        for b in names[:i]:
            assert difference(pictures[a], pictures[b]) > 2, f"{a} looks as {b}"


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_picture(mapper_class):
    scene, _ = cloud_and_mesh(mapper_class, lambda s: (several(s), specular(s.actor.GetProperty())))
    scene.color()
    assert_baseline(scene.window, f"Lights-{mapper_class.__name__}")
