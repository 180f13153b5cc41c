# SPDX-License-Identifier: BSD-3-Clause
"""Render passes and translucency do to a cloud what they do to a mesh, and the surface buffer is made once for them all."""

import functools

import numpy as np
import pytest
from scenes import (
    ACCURACY,
    BACKENDS,
    MAPPERS,
    assert_baseline,
    cloud_and_mesh,
    covered_by_both,
    difference,
    grow,
    still,
    torus_cloud,
    torus_mesh,
    variants,
)
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkHardwareSelector, vtkLight, vtkPolyDataMapper
from vtkmodules.vtkRenderingOpenGL2 import (
    vtkCameraPass,
    vtkDepthPeelingPass,
    vtkDualDepthPeelingPass,
    vtkEDLShading,
    vtkLightsPass,
    vtkOpaquePass,
    vtkOpenGLFXAAPass,
    vtkRenderPassCollection,
    vtkRenderStepsPass,
    vtkSequencePass,
    vtkShadowMapBakerPass,
    vtkShadowMapPass,
    vtkSSAAPass,
    vtkSSAOPass,
    vtkToneMappingPass,
    vtkTranslucentPass,
)

from pointsurface import vtkImageSpacePointMapper

def post_process(pass_class, **settings):
    def prepare(scene):
        scene.steps = vtkRenderStepsPass()
        scene.post = pass_class()
        for name, value in settings.items():
            getattr(scene.post, f"Set{name}")(value)
        scene.post.SetDelegatePass(scene.steps)
        scene.renderer.SetPass(scene.post)

    return prepare


def sequence(*passes):
    collection = vtkRenderPassCollection()
    for each in passes:
        collection.AddItem(each)
    result = vtkSequencePass()
    result.SetPasses(collection)
    return result


def by_sequence(scene):
    camera = vtkCameraPass()
    camera.SetDelegatePass(sequence(vtkLightsPass(), vtkOpaquePass(), vtkTranslucentPass()))
    scene.renderer.SetPass(camera)


def dense_cloud():
    return torus_cloud(100000)


def add_floor(scene):
    scene.add_floor()
    scene.camera.Zoom(0.7)
    scene.renderer.ResetCameraClippingRange()


def shadows(scene):
    """A spot light above: the ring throws its shadow onto a floor, and onto itself."""
    add_floor(scene)
    scene.renderer.AutomaticLightCreationOff()
    light = vtkLight()
    light.SetPosition(1.5, -1, 5)
    light.SetFocalPoint(0, 0, 0)
    light.PositionalOn()
    light.SetConeAngle(40)
    scene.renderer.AddLight(light)
    baker, shadow = vtkShadowMapBakerPass(), vtkShadowMapPass()
    baker.SetResolution(512)
    shadow.SetShadowMapBakerPass(baker)
    camera = vtkCameraPass()
    camera.SetDelegatePass(sequence(baker, shadow))
    scene.renderer.SetPass(camera)


PASSES = {
    "steps": lambda s: s.renderer.SetPass(vtkRenderStepsPass()),
    "sequence": by_sequence,
    "SSAO": post_process(vtkSSAOPass, Radius=0.4, Bias=0.02, KernelSize=64, Blur=True),
    "EDL": post_process(vtkEDLShading),
    "SSAA": post_process(vtkSSAAPass),
    "FXAA pass": post_process(vtkOpenGLFXAAPass),
    "FXAA": lambda s: s.renderer.UseFXAAOn(),
    "tone mapping": post_process(vtkToneMappingPass, ToneMappingType=vtkToneMappingPass.Reinhard),
    "shadows": shadows,
}


def inner_difference(cloud, mesh):
    pictures = cloud.color(), mesh.color()
    inside = ~grow(~(covered_by_both(cloud, mesh)), 2)
    return pictures, difference(*pictures, inside if inside.any() else None)


@pytest.mark.parametrize("mapper_class, backend, name", variants(PASSES))
def test_as_the_mesh(mapper_class, backend, name):
    # over pixels in such numbers gaps are wider than some fill
    dense = mapper_class is vtkImageSpacePointMapper and name == "SSAA"
    cloud, mesh = cloud_and_mesh(mapper_class, PASSES[name], (dense_cloud if dense else torus_cloud, torus_mesh))
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    pictures, measured = inner_difference(cloud, mesh)
    print(f"{name}: {measured:.3f}")
    # EDL draws each step of depth; those between points that give a pixel its depth are many
    steps = mapper_class is vtkImageSpacePointMapper and name == "EDL"
    assert measured < (24 if steps else 4 * ACCURACY[mapper_class].factor)
    assert pictures[0].std() > 0.1
    if name not in ("steps", "sequence", "FXAA", "FXAA pass", "SSAA"):
        plain = (still(mapper_class, add_floor) if name == "shadows" else still(mapper_class)).color()
        assert difference(pictures[0], plain) > 2, "the pass does nothing"
    cloud.color()
    assert cloud.mapper.GetLastFrameReconstructions() == 0, "a still frame makes nothing, whoever draws it"


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_shadow_picture(mapper_class):
    cloud, mesh = cloud_and_mesh(mapper_class, shadows)
    assert difference(cloud.color(), mesh.color()) < 4 * ACCURACY[mapper_class].factor
    assert_baseline(cloud.window, f"Shadows-{mapper_class.__name__}")


PEELING = {"single": vtkDepthPeelingPass, "dual": vtkDualDepthPeelingPass}
TRANSLUCENT = [(opacity, peeling) for opacity in (0.3, 0.6, 0.9) for peeling in ("none", "renderer's", *PEELING)]


@functools.lru_cache(maxsize=None)
def translucent(opacity, peeling):
    def prepare(scene):
        scene.actor.GetProperty().SetOpacity(opacity)
        scene.actor.GetProperty().BackfaceCullingOn()
        scene.actor.GetProperty().SetColor(0.9, 0.5, 0.2)
        ball = vtkSphereSource()
        ball.SetRadius(0.45)
        ball.SetThetaResolution(60)
        ball.SetPhiResolution(60)
        mapper = vtkPolyDataMapper()
        mapper.SetInputConnection(ball.GetOutputPort())
        actor = vtkActor()
        actor.SetMapper(mapper)
        actor.SetPosition(0.3, 0.9, -0.2)
        actor.GetProperty().SetColor(0.2, 0.4, 0.9)
        scene.renderer.AddActor(actor)
        scene.renderer.SetUseDepthPeeling(peeling == "renderer's")
        if peeling in PEELING:
            steps = vtkRenderStepsPass()
            peel = PEELING[peeling]()
            peel.SetTranslucentPass(steps.GetTranslucentPass())
            peel.SetMaximumNumberOfPeels(4)
            steps.SetTranslucentPass(peel)
            scene.renderer.SetPass(steps)

    return prepare


@pytest.mark.parametrize("mapper_class, backend, case", variants(TRANSLUCENT))
def test_translucent(mapper_class, backend, case):
    """A translucent cloud shows its front layer, blended with what is behind: as a mesh without a back, where the mesh
    has one layer only."""
    opacity, peeling = case
    cloud, mesh = cloud_and_mesh(mapper_class, translucent(opacity, peeling))
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    pictures = cloud.color(), mesh.color()
    single = covered_by_both(still(mapper_class), still(vtkPolyDataMapper, make_data=torus_mesh))
    inside = ~grow(~single, 2)
    # where the ring lies before itself the mesh has two layers
    inside &= np.indices(inside.shape)[0] < 100
    measured = difference(*pictures, inside)
    print(f"opacity {opacity}, {peeling}: {measured:.3f}")
    assert measured < 3 * ACCURACY[mapper_class].factor
    opaque = still(mapper_class, translucent(1.0, "none"))
    assert difference(pictures[0], opaque.color(), inside) > 5 * (1 - opacity)
    assert cloud.mapper.GetLastFrameReconstructions() <= 1


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_translucent_picture(mapper_class):
    cloud, _ = cloud_and_mesh(mapper_class, translucent(0.6, "renderer's"))
    cloud.color()
    assert_baseline(cloud.window, f"Translucent-{mapper_class.__name__}")


@pytest.mark.parametrize("backend", BACKENDS)
@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_a_buffer_for_each_view(mapper_class, backend):
    """Peels, selections and a second frame reuse it; the light's view and a new camera have one of their own."""
    made = []
    cloud, _ = cloud_and_mesh(mapper_class, translucent(0.5, "dual"))
    getattr(cloud.mapper, f"SetBackendTo{backend}")()
    cloud.mapper.AddObserver("EndEvent", lambda *_: made.append(cloud.mapper.GetLastFrameReconstructions()))

    def count(draw):
        del made[:]
        draw()
        return sum(made[1:]) + cloud.mapper.GetLastFrameReconstructions()

    assert count(cloud.window.Render) == 1, "one for all peels"
    calls = len(made)
    assert calls > 1, "there are several peels"
    assert count(cloud.window.Render) == 0
    cloud.actor.GetProperty().SetColor(0.1, 0.9, 0.4)
    assert count(cloud.window.Render) == 0, "a colour makes none"
    cloud.camera.Azimuth(20)
    assert count(cloud.window.Render) == 1

    cloud.renderer.SetPass(None)  # VTK gives numbers to props that a selector draws, not to those of a pass
    selector = vtkHardwareSelector()
    selector.SetRenderer(cloud.renderer)
    selector.SetArea(0, 0, 199, 199)
    selector.SetFieldAssociation(vtkDataObject.FIELD_ASSOCIATION_POINTS)
    assert count(selector.Select) <= 1, "ids are added once, and then kept"
    assert count(selector.Select) == 0
    assert count(cloud.window.Render) == 0

    shaded, _ = cloud_and_mesh(mapper_class, shadows)
    getattr(shaded.mapper, f"SetBackendTo{backend}")()
    made_in_a_frame = []
    shaded.mapper.AddObserver("EndEvent", lambda *_: made_in_a_frame.append(shaded.mapper.GetLastFrameReconstructions()))
    shaded.window.Render()
    assert sum(made_in_a_frame[1:]) + shaded.mapper.GetLastFrameReconstructions() == 2, "the camera's and the light's"
