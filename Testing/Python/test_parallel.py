# SPDX-License-Identifier: BSD-3-Clause
"""vtkGhostPointsGenerator: what ranks give each other, and that their pictures, put together by depth, are that of the
whole cloud. Run as a program, with a folder for its output, this file is one rank of an MPI run over loopback."""

import os
import shutil
import subprocess
import sys

import numpy as np
import pytest
from scenes import BACKENDS, MAPPERS, Scene, array, input_of, torus_cloud
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataSetAttributes, vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkRenderingCore import vtkActor
from vtkmodules.vtkRenderingOpenGL2 import vtkRenderStepsPass

from pointsurface import (
    vtkDirectPointMapper,
    vtkGhostPointsGenerator,
    vtkImageSpacePointMapper,
    vtkPointSurfacePass,
    vtkPullPushMapper,
    vtkSurfaceSplatMapper,
)

RANKS = 3
EMPTY = RANKS  # one rank more has no points
BORDERS = [-np.inf, -0.35, 0.6, np.inf]  # in x: regions of unlike sizes
REACH = 3.0
LARGE = 0.1  # a radius, and two ways to tell it
TOLD = ("RadiusArray", "size"), ("Radius", LARGE)
QUANTILES = (-1.0, 0.0, 0.5, 0.98)
DISTANT = 0, 1000, 10**6  # points beyond the reach that are asked for
TURNS = 3  # views of balls
PLACES = {"tiny": (1e-12, 0), "huge": (1e12, 0), "far": (1, (1e7, -2e7, 3e7))}  # scale, and where the middle is


def rank_of(points):
    return np.searchsorted(BORDERS, points[:, 0]) - 1


def whole_of(mapper_class):
    """What a mapper draws, its points numbered; radii vary by half. Of Direct's more than are asked for their spacing."""
    cloud = torus_cloud(30000 if mapper_class is vtkDirectPointMapper else 8000)
    radii = vtk_to_numpy(cloud.GetPointData().GetArray("radius"))
    radii *= 1 + 0.5 * (np.arange(len(radii)) % 2)
    data = input_of(mapper_class, cloud)
    data.GetPointData().AddArray(numpy_to_vtk(np.arange(data.GetNumberOfPoints()), deep=True))
    data.GetPointData().GetArray(data.GetPointData().GetNumberOfArrays() - 1).SetName("number")
    return data


def placed(cloud, scale, middle):
    """The cloud, whose ranks are known by its places before, in double precision."""
    cloud.GetPoints().SetData(array(scale * positions(cloud).astype(float) + middle, kind=float))
    numpy_of(cloud, "radius")[:] *= scale
    return cloud


def positions_only(points, radii):
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(array(points))
    data.GetPointData().AddArray(array(radii, "radius"))
    return data


def balls():
    """Positions on balls at random places: many an outline of a far one comes out behind that of a near one."""
    count, each, size = 60, 200, 0.15
    i = np.arange(each) + 0.5
    z, angle = 1 - 2 * i / each, np.pi * (1 + 5**0.5) * i
    r = np.sqrt(1 - z * z)
    ball = size * np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=-1)
    places = np.random.default_rng(3).uniform(-1, 1, (count, 1, 3))
    return positions_only((places + ball).reshape(-1, 3), np.full(count * each, 1.5 * size * np.sqrt(4 * np.pi / each)))


def pictures_of_balls(scene, backend):
    """Colours and depths from TURNS sides."""
    scene.mapper.SetBackend(getattr(vtkDirectPointMapper, backend))
    scene.camera.SetPosition(1.2, -3.0, 2.4)
    scene.camera.SetViewAngle(30)
    scene.renderer.ResetCamera(balls().GetBounds())
    scene.camera.Zoom(1.6)
    pictures = []
    for _ in range(TURNS):
        scene.camera.Azimuth(50)
        scene.renderer.ResetCameraClippingRange(balls().GetBounds())
        pictures.append((scene.color(), scene.depth()))
    return [np.stack(layers) for layers in zip(*pictures)]


def numpy_of(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def positions(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def part_of(data, chosen):
    ids = vtkIdList()
    for i in np.nonzero(chosen)[0]:
        ids.InsertNextId(i)
    part = vtkPolyData()
    part.SetPoints(vtkPoints())
    part.GetPoints().SetDataType(data.GetPoints().GetDataType())
    data.GetPoints().GetPoints(ids, part.GetPoints())
    places = vtkIdList()
    for i in range(ids.GetNumberOfIds()):
        places.InsertNextId(i)
    part.GetPointData().CopyAllOn()
    part.GetPointData().CopyAllocate(data.GetPointData(), ids.GetNumberOfIds())
    part.GetPointData().CopyData(data.GetPointData(), ids, places)
    return part


def two_points(cloud):
    """Two of a cloud's, at x = 1 and far closer to each other than their radius of 0.4."""
    part = part_of(cloud, np.arange(cloud.GetNumberOfPoints()) < 2)
    positions(part)[:] = (1, 0, 0), (1, 0, 1e-6)
    numpy_of(part, "radius")[:] = 0.4
    return part


def with_ghosts(data, errors=None, reach=REACH, **properties):
    generator = vtkGhostPointsGenerator()
    generator.SetInputData(data)
    generator.SetReach(reach)
    for name, value in properties.items():
        getattr(generator, f"Set{name}")(value)
    if errors is not None:
        for event in ("ErrorEvent", "WarningEvent"):
            generator.AddObserver(event, lambda *_: errors.append(1))
    generator.Update()
    return generator.GetOutputDataObject(0), generator.GetNumberOfGhostPoints()


# ------------------------------------------------------------------------------
# one rank


def run_rank(folder):
    from mpi4py import MPI  # noqa: F401, starts MPI, which vtkMPIController expects here
    from vtkmodules.vtkParallelCore import vtkMultiProcessController
    from vtkmodules.vtkParallelMPI import vtkMPIController

    controller = vtkMPIController()
    controller.Initialize()
    vtkMultiProcessController.SetGlobalController(controller)
    rank = controller.GetLocalProcessId()
    results = {}

    def keep(name, data):
        results[name + "/count"] = data.GetNumberOfPoints()
        if data.GetNumberOfPoints():
            results[name + "/points"] = positions(data)
            results[name + "/normals"] = vtk_to_numpy(data.GetPointData().GetNormals())
            for array_name in ("number", "radius", "vtkGhostType", "vtkProcessId"):
                results[f"{name}/{array_name}"] = numpy_of(data, array_name)

    for mapper_class in MAPPERS:
        whole = whole_of(mapper_class)
        own = part_of(whole, rank_of(positions(whole)) == rank)
        output, ghosts = with_ghosts(own)
        if mapper_class is MAPPERS[0]:
            keep("cloud", output)
            results["ghosts"] = ghosts
        usual, _ = with_ghosts(own, reach=vtkGhostPointsGenerator().GetReach())
        scene = Scene(mapper_class, whole)
        for name, data in (("with", usual), ("without", own)):
            scene.mapper.SetInputData(data)
            results[f"{mapper_class.__name__}/{name}/color"] = scene.color()
            results[f"{mapper_class.__name__}/{name}/depth"] = scene.depth()

    # Scales, and far from the origin.
    owner = rank_of(positions(whole_of(MAPPERS[0])))
    for name, place in PLACES.items():
        output, _ = with_ghosts(part_of(placed(whole_of(MAPPERS[0]), *place), owner == rank))
        keep(name, output)

    # Points beyond the reach.
    whole = whole_of(MAPPERS[0])
    own = part_of(whole, rank_of(positions(whole)) == rank)
    for limit in DISTANT:
        output, ghosts = with_ghosts(own, DistantPoints=limit)
        keep(f"distant{limit}", output)
        results[f"distant{limit}/ghosts"] = ghosts
    whole = balls()
    own = part_of(whole, rank_of(positions(whole)) == rank)
    for limit in (0, DISTANT[-1]):
        output, _ = with_ghosts(own, reach=vtkGhostPointsGenerator().GetReach(), DistantPoints=limit)
        scene = Scene(vtkDirectPointMapper, output, bounds=whole.GetBounds())
        for backend in BACKENDS:
            key = f"balls{limit}/{backend}"
            results[key + "/color"], results[key + "/depth"] = pictures_of_balls(scene, backend)

    # Trees: the upper half of the torus is a block, the lower one another; rank 1 has no upper one.
    whole = whole_of(MAPPERS[0])
    upper = positions(whole)[:, 2] > 0
    tree = vtkMultiBlockDataSet()
    tree.SetNumberOfBlocks(2)
    ours = rank_of(positions(whole)) == rank
    if rank != 1:
        tree.SetBlock(0, part_of(whole, ours & upper))
    tree.SetBlock(1, part_of(whole, ours & ~upper))
    output, _ = with_ghosts(tree)
    for block in range(2):
        if output.GetBlock(block):
            keep(f"block{block}", output.GetBlock(block))
    output, _ = with_ghosts(tree, DistantPoints=DISTANT[-1])
    for block in range(2):
        if output.GetBlock(block):
            keep(f"distant-block{block}", output.GetBlock(block))

    # A radius that is larger than the cloud.
    cloud = torus_cloud(8000)
    numpy_of(cloud, "radius")[0] = 1e30
    output, _ = with_ghosts(part_of(cloud, rank_of(positions(cloud)) == rank))
    if output.GetNumberOfPoints():
        results["whole"] = vtk_to_numpy(output.GetFieldData().GetArray("vtkWholeCloud"))

    # Radii that are told.
    for name, value in TOLD:
        cloud = torus_cloud(8000)
        cloud.GetPointData().AddArray(array(np.full(8000, LARGE), "size"))
        _, results["told/" + name] = with_ghosts(part_of(cloud, rank_of(positions(cloud)) == rank), **{name: value})

    # Two points, far closer to each other than their radii are.
    cloud = torus_cloud(8000)
    if rank == 1:
        output, ghosts = with_ghosts(two_points(cloud))
    else:
        output, ghosts = with_ghosts(part_of(cloud, (positions(cloud)[:, 0] < 0) & (rank == 0)))
    results["few"] = ghosts

    # Sampling distances.
    for quantile in QUANTILES:
        generator = vtkGhostPointsGenerator()
        generator.SetInputData(part_of(torus_cloud(8000), rank_of(positions(torus_cloud(8000))) == rank))
        generator.SetSamplingQuantile(quantile)
        generator.Update()
        if rank != EMPTY:
            told = generator.GetOutput().GetFieldData().GetArray("vtkWholeCloud")
            results[f"sampling/{quantile}"] = told.GetValue(8)

    # Radii that the mappers repair or replace.
    for name in ("faulty", "mean", "short", "none"):
        part = part_of(torus_cloud(8000), rank_of(positions(torus_cloud(8000))) == rank)
        if part.GetNumberOfPoints():
            radii = numpy_of(part, "radius")
            if name == "faulty":
                radii[::3], radii[1::3] = np.nan, 0
            elif name == "short":
                part.GetPointData().AddArray(array(radii[:-1].copy(), "radius"))
            elif name == "none":
                part.GetPointData().RemoveArray("radius")
        warnings = []
        output, ghosts = with_ghosts(part, warnings)
        results[f"radii/{name}"] = ghosts, len(warnings), output.GetNumberOfPoints() - part.GetNumberOfPoints()

    # Trees that differ.
    if rank == 0:
        tree.SetNumberOfBlocks(3)
    errors = []
    output, ghosts = with_ghosts(tree, errors)
    results["differing"] = len(errors), ghosts, output.GetNumberOfPoints() - tree.GetNumberOfPoints()

    np.savez(os.path.join(folder, f"rank{rank}.npz"), **results)
    controller.Finalize()


if __name__ == "__main__":
    run_rank(sys.argv[1])
    sys.exit()


# ------------------------------------------------------------------------------
# the tests


@pytest.fixture(scope="module")
def ranks(tmp_path_factory):
    """The output of each rank."""
    pytest.importorskip("vtkmodules.vtkParallelMPI", reason="this VTK is built without MPI")
    pytest.importorskip("mpi4py")
    mpiexec = shutil.which("mpiexec")
    if not mpiexec:
        pytest.skip("there is no mpiexec")
    folder = tmp_path_factory.mktemp("ranks")
    environment = dict(
        os.environ,
        OMPI_ALLOW_RUN_AS_ROOT="1",
        OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
        OMPI_MCA_rmaps_base_oversubscribe="1",
        OMPI_MCA_btl="self,tcp",
        OMPI_MCA_btl_tcp_if_include="lo",
    )
    command = [mpiexec, "-n", str(RANKS + 1), sys.executable, os.path.abspath(__file__), str(folder)]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=300)
    assert run.returncode == 0, run.stdout + run.stderr
    return [np.load(folder / f"rank{rank}.npz") for rank in range(RANKS + 1)]


def needed(points, owner, radii, rank):
    """The numbers of the points that a rank needs of others: those within reach of its box."""
    own = points[owner == rank]
    outside = np.maximum(np.maximum(own.min(axis=0) - points, points - own.max(axis=0)), 0)
    near = np.linalg.norm(outside, axis=1) <= REACH * radii
    return np.nonzero(near & (owner != rank))[0]


def check_ghosts(result, name, whole, own, ghosts):
    """That a rank has its own points, as they were and first, and the ghosts."""
    number = result[name + "/number"]
    count = len(own)
    assert (number[:count] == own).all()
    assert len(number) == len(set(number))
    assert set(number[count:]) == set(ghosts)
    assert (result[name + "/vtkGhostType"] == np.where(np.arange(len(number)) < count, 0,
                                                       vtkDataSetAttributes.DUPLICATEPOINT)).all()
    assert (result[name + "/vtkProcessId"] == rank_of(positions(whole_of(MAPPERS[0])))[number]).all()
    assert result[name + "/vtkProcessId"].dtype == np.uint32
    assert (result[name + "/points"] == positions(whole)[number]).all()
    assert (result[name + "/normals"] == vtk_to_numpy(whole.GetPointData().GetNormals())[number]).all()
    assert (result[name + "/radius"] == numpy_of(whole, "radius")[number]).all()


def test_ranks_get_the_points_near_them(ranks):
    whole = whole_of(MAPPERS[0])
    points, radii = positions(whole), numpy_of(whole, "radius")
    owner = rank_of(points)
    for rank in range(RANKS):
        ghosts = needed(points, owner, radii, rank)
        assert 100 < len(ghosts) < 0.3 * len(points)
        check_ghosts(ranks[rank], "cloud", whole, np.nonzero(owner == rank)[0], ghosts)
        assert ranks[rank]["ghosts"] == len(ghosts)
    assert ranks[EMPTY]["cloud/count"] == ranks[EMPTY]["ghosts"] == 0


@pytest.mark.parametrize("name", PLACES)
def test_ranks_get_the_points_near_them_at_any_scale(ranks, name):
    owner = rank_of(positions(whole_of(MAPPERS[0])))
    whole = placed(whole_of(MAPPERS[0]), *PLACES[name])
    for rank in range(RANKS):
        ghosts = needed(positions(whole), owner, numpy_of(whole, "radius").astype(float), rank)
        assert 100 < len(ghosts) < 0.3 * len(owner)
        check_ghosts(ranks[rank], name, whole, np.nonzero(owner == rank)[0], ghosts)


def test_blocks_of_a_tree(ranks):
    """Blocks fill each other's gaps, so that what is near counts wherever in the tree it is; it stays in its block."""
    whole = whole_of(MAPPERS[0])
    points, radii = positions(whole), numpy_of(whole, "radius")
    owner = rank_of(points)
    upper = points[:, 2] > 0
    owner[upper & (owner == 1)] = -1  # that block was left out
    for rank in range(RANKS):
        ghosts = needed(points, owner, radii, rank)
        ghosts = ghosts[owner[ghosts] >= 0]
        for block, chosen in enumerate((upper, ~upper)):
            own = np.nonzero((owner == rank) & chosen)[0]
            check_ghosts(ranks[rank], f"block{block}", whole, own, ghosts[chosen[ghosts]])


def beyond(points, owner, radii, rank):
    """The numbers of the points of others that a rank does not need for its surface."""
    return np.setdiff1d(np.nonzero((owner != rank) & (owner >= 0))[0], needed(points, owner, radii, rank))


def test_ranks_get_distant_points(ranks):
    """All of them, or about as many by chance as are asked for, from all places, after those that are near."""
    whole = whole_of(MAPPERS[0])
    points, radii = positions(whole), numpy_of(whole, "radius")
    owner = rank_of(points)
    for rank in range(RANKS):
        near, far = needed(points, owner, radii, rank), beyond(points, owner, radii, rank)
        assert len(far) > 3 * DISTANT[1]
        for limit, count in ((0, 0), (DISTANT[1], DISTANT[1]), (DISTANT[-1], len(far))):
            result, name = ranks[rank], f"distant{limit}"
            ghosts = result[name + "/number"][np.count_nonzero(owner == rank) :]
            chosen = ghosts[len(near) :]
            check_ghosts(result, name, whole, np.nonzero(owner == rank)[0], ghosts)
            assert set(ghosts[: len(near)]) == set(near) and set(chosen) <= set(far)
            assert result[name + "/ghosts"] == len(ghosts)
            assert abs(len(chosen) - count) <= (0.1 * count if count < len(far) else 0)
            for other in set(range(RANKS)) - {rank} if count else ():
                share = np.count_nonzero(owner[chosen] == other) / np.count_nonzero(owner[far] == other)
                assert share == pytest.approx(len(chosen) / len(far), rel=0.2)
    assert ranks[EMPTY][f"distant{DISTANT[-1]}/ghosts"] == 0


def test_distant_points_stay_in_their_blocks(ranks):
    whole = whole_of(MAPPERS[0])
    points = positions(whole)
    owner = rank_of(points)
    upper = points[:, 2] > 0
    owner[upper & (owner == 1)] = -1  # that block was left out
    for rank in range(RANKS):
        for block, chosen in enumerate((upper, ~upper)):
            own = np.nonzero((owner == rank) & chosen)[0]
            others = np.nonzero((owner != rank) & (owner >= 0) & chosen)[0]
            check_ghosts(ranks[rank], f"distant-block{block}", whole, own, others)


def test_trees_that_differ_are_an_error(ranks):
    for result in ranks:
        assert tuple(result["differing"]) == (1, 0, 0)


def test_what_is_told_of_the_whole(ranks):
    """Its bounds; and no radius that is larger than it is, which shaders could not take."""
    cloud = torus_cloud(8000)
    radius = numpy_of(cloud, "radius")[1]
    for rank in range(RANKS):
        assert ranks[rank]["whole"][:6] == pytest.approx(cloud.GetBounds())
        mean, largest = ranks[rank]["whole"][6:8]
        assert radius < mean < 1.1 * radius < largest <= cloud.GetLength()


def test_sampling_distance_is_that_of_the_whole(ranks):
    """A quantile of the distances between nearest neighbours, on whichever rank they are; 0 where none is wanted."""
    points = positions(torus_cloud(8000)).astype(float)
    nearest = np.array([np.partition(np.linalg.norm(points - x, axis=1), 1)[1] for x in points])
    assert vtkGhostPointsGenerator().GetSamplingQuantile() == vtkDirectPointMapper().GetSamplingQuantile()
    for quantile in QUANTILES:
        expected = np.quantile(nearest, quantile, method="nearest") if quantile >= 0 else 0
        for rank in range(RANKS):
            assert ranks[rank][f"sampling/{quantile}"] == pytest.approx(expected, rel=1e-5)


def test_radii_are_those_of_the_mappers(ranks):
    """Those that are no radii become the mean of the others; where there is not one for each point, all are estimated."""
    for rank in range(RANKS):
        counts = {name: tuple(ranks[rank][f"radii/{name}"]) for name in ("faulty", "mean", "short", "none")}
        assert counts["faulty"] == counts["mean"] and counts["mean"][:2] == (counts["mean"][2], 0)
        assert counts["mean"][0] > 100
        assert counts["short"] == (counts["none"][0], 1, counts["none"][2])
        assert counts["none"][0] > 100


def test_radii_that_are_told_count(ranks):
    points = positions(torus_cloud(8000))
    owner = rank_of(points)
    for rank in range(RANKS):
        expected = len(needed(points, owner, np.full(8000, LARGE), rank))
        assert [int(ranks[rank]["told/" + name]) for name, _ in TOLD] == [expected, expected]


def test_radii_of_few_points_are_those_of_the_whole(ranks):
    """What lies within three radii of 0.4, here at a distance of 1, is sent."""
    assert int(ranks[0]["few"]) == 2


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_radii_are_judged_by_the_whole(mapper_class):
    """Of few points, which lie close to each other on one rank, they are no fault."""
    cloud = input_of(mapper_class, torus_cloud(8000))
    part = two_points(cloud)
    part.GetFieldData().AddArray(array([*cloud.GetBounds(), 0.4, 0.4, 0.4], "vtkWholeCloud", np.float64))
    scene = Scene(mapper_class, part, bounds=cloud.GetBounds())
    said = []
    for event in ("ErrorEvent", "WarningEvent"):
        scene.mapper.AddObserver(event, lambda *_: said.append(1))
    scene.color()
    covered = np.count_nonzero(scene.depth() < 1)
    print(covered, "pixels")
    assert not said
    assert covered > (0 if mapper_class is vtkImageSpacePointMapper else 100)  # which fills between points alone


def composite(ranks, name):
    """Of each pixel what the nearest rank drew."""
    colors = np.stack([result[name + "/color"] for result in ranks])
    depths = np.stack([result[name + "/depth"] for result in ranks])
    nearest = depths.argmin(axis=0)
    return np.take_along_axis(colors, nearest[None, ..., None], axis=0)[0], depths.min(axis=0)


def compare(parallel, serial, name):
    """The mean difference in grey levels over what either covers, pixels that are left out, and pixels that are more."""
    (parallel_color, parallel_depth), (color, depth) = parallel, serial
    difference = 255 * np.abs(parallel_color - color)[(depth < 1) | (parallel_depth < 1)].mean()
    unfilled = int(((depth < 1) & (parallel_depth == 1)).sum())
    more = int(((depth == 1) & (parallel_depth < 1)).sum())
    print(f"{name}: {difference:.4f} grey levels, {unfilled} unfilled, {more} more, of {(depth < 1).sum()} pixels")
    return difference, unfilled, more


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_pictures_are_that_of_the_whole(ranks, mapper_class):
    scene = Scene(mapper_class, whole_of(mapper_class))
    serial = scene.color(), scene.depth()
    measured = {}
    for name in ("with", "without"):
        key = f"{mapper_class.__name__}/{name}"
        measured[name] = compare(composite(ranks, key), serial, key)
    assert measured["with"][0] < 1 and measured["with"][1] == 0
    assert measured["with"][0] < measured["without"][0]


@pytest.mark.parametrize("backend", BACKENDS)
def test_distant_points_make_the_pictures_the_same(ranks, backend):
    """What a plane is fitted to, and so how far a splat of it reaches, depends on what is hidden by what is anywhere before
    it: with no points beyond the reach some pixels are left out at outlines that come out behind others, and some more."""
    serial = pictures_of_balls(Scene(vtkDirectPointMapper, balls()), backend)
    near, distant = (
        compare(composite(ranks, f"balls{limit}/{backend}"), serial, f"balls, {limit} distant points")
        for limit in (0, DISTANT[-1])
    )
    assert near[1] > 10  # or this tells nothing
    assert distant[1] == distant[2] == 0
    assert distant[0] < 0.01


def parts_of(points, radii, distance):
    """The parts of a cloud for Direct that two ranks have, each a half in x, as vtkGhostPointsGenerator makes them."""
    upper = points[:, 0] > np.median(points[:, 0])
    whole = positions_only(points, radii)
    told = [*whole.GetBounds(), radii.mean(), radii.max(), distance]
    for own in (upper, ~upper):
        outside = np.maximum(np.maximum(points[own].min(axis=0) - points, points - points[own].max(axis=0)), 0)
        near = np.linalg.norm(outside, axis=1) <= vtkGhostPointsGenerator().GetReach() * radii
        ids = np.concatenate([np.flatnonzero(own), np.flatnonzero(near & ~own)])
        part = positions_only(points[ids], radii[ids])
        ghosts = np.where(own[ids], 0, vtkDataSetAttributes.DUPLICATEPOINT)
        part.GetPointData().AddArray(array(ghosts, vtkDataSetAttributes.GhostArrayName(), np.uint8))
        part.GetFieldData().AddArray(array(told, "vtkWholeCloud", np.float64))
        yield part


@pytest.mark.parametrize("backend", BACKENDS)
def test_copies_cover_nothing_that_the_whole_does_not(backend):
    """Where the copies end their cells have neighbours on one side alone, as few as where points are sparse: no coarse splats
    may be seen there past the outline."""
    cloud = torus_cloud(30000)
    points, radii = positions(cloud), numpy_of(cloud, "radius")
    distance = 0.7 * float(radii[0])
    clouds = [cloud, *parts_of(points, radii, distance)]
    scenes = [Scene(vtkDirectPointMapper, data, bounds=cloud.GetBounds()) for data in clouds]
    scenes[0].mapper.SetRadius(distance)
    for scene in scenes:
        scene.mapper.SetBackend(getattr(vtkDirectPointMapper, backend))
    more = 0
    for turn in range(4 if backend == "CPU" else 2):
        for scene in scenes:
            scene.camera.Azimuth(turn * 40)
            scene.camera.OrthogonalizeViewUp()
        color, *colors = np.stack([scene.color() for scene in scenes])
        depth, *depths = np.stack([scene.depth() for scene in scenes])
        composited = np.where((depths[0] <= depths[1])[..., None], *colors)
        covers, covered = np.minimum(*depths) < 1, depth < 1
        more += np.count_nonzero(covers & ~covered)
        change = 255 * np.abs(composited - color)[covered].mean()
        print(f"{covered.sum()} pixels, {more} more so far, {change:.4f} grey levels")
        assert covered.sum() > 5000
        assert not (covered & ~covers).any()
        assert change < 0.1
    assert more == 0


def test_one_process_changes_nothing():
    cloud = torus_cloud(1000)
    output, ghosts = with_ghosts(cloud)
    assert ghosts == 0 and output.GetPoints() is cloud.GetPoints()
    assert not output.GetPointData().HasArray("vtkGhostType")


@pytest.mark.parametrize("mapper_class", [vtkPullPushMapper, vtkSurfaceSplatMapper])
def test_parts_are_not_thinned(mapper_class):
    """Each process would choose other points than its neighbours and the serial run."""
    cloud = torus_cloud(100_000)
    scene = Scene(mapper_class, cloud, size=(50, 50))
    scene.color()
    assert scene.mapper.GetLastFramePointsDrawn() < cloud.GetNumberOfPoints()
    part = vtkPolyData()
    part.ShallowCopy(cloud)
    radius = numpy_of(cloud, "radius")[0]
    part.GetFieldData().AddArray(array([*cloud.GetBounds(), radius, radius, 0], "vtkWholeCloud", np.float64))
    scene.mapper.SetInputData(part)
    scene.color()
    assert scene.mapper.GetLastFramePointsDrawn() == cloud.GetNumberOfPoints()


@pytest.mark.parametrize("mapper_class", MAPPERS)
def test_bounds_of_a_part_hold_all_that_it_draws(mapper_class):
    """By them ParaView tells what of the picture a rank draws."""
    part = torus_cloud(2000)
    radius = numpy_of(part, "radius")[0]
    part.GetFieldData().AddArray(array([*part.GetBounds(), radius, radius, radius / 1.5], "vtkWholeCloud", np.float64))
    scene = Scene(mapper_class, part)
    scene.camera.SetPosition(0, 0, 5)
    scene.camera.SetViewUp(0, 1, 0)
    scene.camera.ParallelProjectionOn()
    scene.camera.SetParallelScale(2)
    scene.color()
    rows, columns = np.nonzero(scene.depth() < 1)
    pixel = 2 * 2 / 200
    drawn = [c * pixel - 2 for c in (columns.min(), columns.max() + 1, rows.min(), rows.max() + 1)]
    bounds = scene.mapper.GetBounds()[:4]
    print("bounds", np.round(bounds, 3), "drawn", np.round(drawn, 3), "points", np.round(part.GetBounds()[:4], 3))
    assert (drawn[1] - drawn[0]) > 2.5
    assert all(bounds[i] <= drawn[i] and drawn[i + 1] <= bounds[i + 1] for i in (0, 2))


def test_copies_lie_behind_where_clouds_join():
    """Clouds that look alike are shaded together, but one with copies by itself, which knows them."""
    cloud = torus_cloud(8000)
    left = positions(cloud)[:, 0] < 0
    depths = []
    for ghost_type in (0, vtkDataSetAttributes.DUPLICATEPOINT):
        scene = Scene(MAPPERS[0], cloud)
        scene.mapper.SetInputData(part_of(cloud, left))
        other = part_of(cloud, ~left)
        ghosts = numpy_to_vtk(np.full(other.GetNumberOfPoints(), ghost_type, np.uint8), deep=True)
        ghosts.SetName(vtkDataSetAttributes.GhostArrayName())
        other.GetPointData().AddArray(ghosts)
        mapper, actor, steps = MAPPERS[0](), vtkActor(), vtkRenderStepsPass()
        mapper.SetInputData(other)
        actor.SetMapper(mapper)
        scene.renderer.AddActor(actor)
        scene.renderer.ResetCameraClippingRange(cloud.GetBounds())
        steps.SetOpaquePass(vtkPointSurfacePass())
        scene.renderer.SetPass(steps)
        scene.color()
        depths.append(scene.depth())
    behind, covered = depths[1] > depths[0] + 1e-3, depths[0] < 1
    print(np.count_nonzero(behind), "pixels behind, of", np.count_nonzero(covered))
    assert 0.3 < np.count_nonzero(behind) / np.count_nonzero(covered) < 0.7
    assert np.array_equal(depths[0][~behind], depths[1][~behind])


def test_translucent_surfaces_are_drawn_once():
    """Of a surface that is blended each pixel is drawn by the process that has its points alone: two of them, one over the
    other, give what one gives of all."""
    cloud = torus_cloud(8000)
    left = positions(cloud)[:, 0] < 0
    scene = Scene(MAPPERS[0], cloud)
    scene.actor.GetProperty().SetOpacity(0.5)
    scene.actor.GetProperty().BackfaceCullingOn()
    whole = scene.color()
    background = whole[0, 0]
    parts = []
    for own in (left, ~left):
        part = vtkPolyData()
        part.ShallowCopy(cloud)
        ghosts = np.where(own, 0, vtkDataSetAttributes.DUPLICATEPOINT)
        part.GetPointData().AddArray(array(ghosts, vtkDataSetAttributes.GhostArrayName(), np.uint8))
        scene.mapper.SetInputData(part)
        parts.append(scene.color())
    drawn = [(part != background).any(axis=-1) for part in parts]
    print([np.count_nonzero(d) for d in drawn], "pixels of", np.count_nonzero((whole != background).any(axis=-1)))
    assert not (drawn[0] & drawn[1]).any() and drawn[0].sum() > 1000 and drawn[1].sum() > 1000
    assert np.array_equal(np.where(drawn[0][..., None], *parts), whole)
