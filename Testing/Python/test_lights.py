# SPDX-License-Identifier: BSD-3-Clause
"""Whatever lights and material a mesh may have, a cloud of the same surface is lit alike."""

import functools

import numpy as np
import pytest
from scenes import (
    BACKENDS,
    MAPPERS,
    Scene,
    array,
    as_it_is,
    assert_baseline,
    cloud_and_mesh,
    covered_by_both,
    difference,
    still,
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


def inner_difference(mapper_class, backend, prepare=as_it_is, make_cloud=torus_cloud):
    """The mean over all channels, in grey levels, of what both cover."""
    cloud, mesh = cloud_and_mesh(mapper_class, prepare, (make_cloud, torus_mesh))
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    pictures = cloud.color(), mesh.color()
    mask = covered_by_both(cloud, mesh)
    assert np.count_nonzero(mask) > 8000
    assert pictures[0][mask].std() > 0.02 or not cloud.actor.GetProperty().GetLighting(), "nothing is lit"
    return 255 * np.abs(pictures[0] - pictures[1])[mask].mean()


@functools.lru_cache(maxsize=None)
def headlight(mapper_class, backend):
    return inner_difference(mapper_class, backend)


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("mapper_class", MAPPERS)
@pytest.mark.parametrize("name", [*LIGHTS, *MATERIALS])
def test_lit_as_the_mesh(name, mapper_class, backend):
    """The mean difference is at most 1.1 times that of the headlight with the default material."""
    measured = inner_difference(mapper_class, backend, {**LIGHTS, **MATERIALS}[name])
    print(f"{name}: {measured:.3f}, headlight: {headlight(mapper_class, backend):.3f}")
    assert measured <= 1.1 * headlight(mapper_class, backend)


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

    turned = inner_difference(mapper_class, "CPU", several, turned_cloud)
    assert turned <= 1.1 * inner_difference(mapper_class, "CPU", make_cloud=turned_cloud)
    # along outlines the far side's discs are in front in the sense of their normals
    assert turned == pytest.approx(inner_difference(mapper_class, "CPU", several), abs=0.6)


def test_the_lights_differ():
    """Set-ups that all look alike would prove nothing."""
    pictures = {"headlight": still(MAPPERS[0]).color()}
    for name, prepare in {**LIGHTS, **MATERIALS}.items():
        if name not in ("Gouraud", "Phong"):
            pictures[name] = still(MAPPERS[0], prepare).color()
    names = list(pictures)
    for i, a in enumerate(names):
        for b in names[:i]:
            assert difference(pictures[a], pictures[b]) > 2, f"{a} looks as {b}"


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_picture(mapper_class):
    scene, _ = cloud_and_mesh(mapper_class, lambda s: (several(s), specular(s.actor.GetProperty())))
    scene.color()
    assert_baseline(scene.window, f"Lights-{mapper_class.__name__}")
