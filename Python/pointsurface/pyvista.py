# SPDX-License-Identifier: BSD-3-Clause
"""Point clouds as surfaces in PyVista: what a plotter's ``add_mesh`` does, drawn by a mapper of this package.

>>> import pyvista as pv
>>> from pointsurface.pyvista import add_point_surface
>>> plotter = pv.Plotter(off_screen=True)
>>> cloud = pv.PolyData(pv.Sphere().points)
>>> actor = add_point_surface(plotter, cloud, color="tan")
>>> plotter.show()  # doctest: +SKIP

Importing this module registers the accessor ``point_surface`` of ``pyvista.PolyData`` and ``pyvista.ImageData``.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pyvista as pv

from . import vtkIsosurfacePoints, vtkPointNormals, vtkPointSpacing
from .methods import AUTO, METHODS, chosen, needs_splats, splat_filter


def add_point_surface(
    plotter: pv.BasePlotter,
    cloud: pv.DataSet | pv.MultiBlock | np.ndarray,
    method: str = "pull-push",
    *,
    radius: float | str | None = None,
    radius_scale: float = 1.0,
    supersampling: int = 1,
    **kwargs: Any,
) -> pv.Actor:
    """Add the points of a cloud to a plotter, drawn as the surface that they stand for.

    Parameters
    ----------
    plotter : pyvista.BasePlotter
        The plotter, at the subplot that is active.
    cloud : pyvista.DataSet, pyvista.MultiBlock or numpy.ndarray
        The points, or an array of their coordinates (n x 3), used without a copy where VTK allows. Normals, if
        ``cloud.point_data.active_normals`` has none, and radii are estimated once. Blocks are one surface; how each is
        displayed is told by ``actor.mapper.GetCompositeDataDisplayAttributes()``, which is indexed by block as
        PyVista's ``mapper.block_attr`` is.
    method : str, default: "pull-push"
        How the surface is made: a key of ``pointsurface.methods.METHODS``, or ``"auto"`` for the one that measures best
        for such a cloud here (``vtkPointSurfaceMapperFactory``). For ``"algebraic-splats"``, splats are fitted to
        points that are none.
    radius : float or str, optional
        The radius of all points in the units of their coordinates, or the name of a point array. Default: the array
        ``"radius"`` if there is one, else an estimate.
    radius_scale : float, default: 1.0
        Factor on all radii.
    supersampling : int, default: 1
        Samples along each side of a pixel, 1 to 4.
    **kwargs : Any
        As of ``pyvista.Plotter.add_mesh``: ``color``, ``scalars``, ``cmap``, ``clim``, ``opacity``, ``name``,
        ``scalar_bar_args``, ``pickable``, ``pbr``, ...

    Returns
    -------
    pyvista.Actor
        The actor; its mapper is the one named by ``method``.

    Notes
    -----
    ``plotter.enable_point_picking(picker="hardware")`` finds points, as of any cloud, if it looks for no faces:
    ``plotter.iren.picker.SetSnapToMeshPoint(True)``.

    Raises
    ------
    ValueError
        If there is no such method, or the cloud has no points or no array of the name ``radius``.

    Examples
    --------
    >>> import numpy as np
    >>> import pyvista as pv
    >>> from pointsurface.pyvista import add_point_surface
    >>> plotter = pv.Plotter(off_screen=True)
    >>> points = np.random.default_rng(0).normal(size=(10000, 3))
    >>> points /= np.linalg.norm(points, axis=1, keepdims=True)
    >>> actor = add_point_surface(plotter, points, scalars=points[:, 2], cmap="viridis")
    >>> actor.mapper.GetClassName()
    'vtkPullPushMapper'
    """
    if method not in (*METHODS, AUTO):
        raise ValueError(f"there is no method {method!r}; use one of {', '.join((*METHODS, AUTO))}")
    cloud = pv.wrap(cloud)
    if not any(block.n_points for block in _blocks(cloud)):
        raise ValueError("the cloud has no points")
    method = chosen(method, cloud)
    mapper = METHODS[method]()
    if isinstance(radius, str):
        for block in _blocks(cloud):
            if radius not in block.point_data:
                raise ValueError(f"the points have no array {radius!r} of radii; they have {block.point_data.keys()}")
        mapper.SetRadiusArray(radius)
    elif radius is not None:
        mapper.SetRadius(radius)
    mapper.SetRadiusScale(radius_scale)
    mapper.SetSupersampling(supersampling)

    cloud = _drawable(method, cloud)
    # All of the scalars' colours, the bar and the camera are PyVista's; then the mapper alone is another one.
    render = kwargs.pop("render", True)
    actor = plotter.add_mesh(cloud, style="points", render=False, **kwargs)
    theirs = actor.mapper
    mapper.ShallowCopy(theirs)
    mapper.SetInputConnection(theirs.GetInputConnection(0, 0))
    if isinstance(cloud, pv.MultiBlock):
        mapper.SetCompositeDataDisplayAttributes(theirs.GetCompositeDataDisplayAttributes())
    actor.SetMapper(mapper)
    actor.prop.style = "surface"
    if render:
        plotter.render()
    return actor


def _blocks(cloud):
    """The data sets of a cloud: itself, or those of its blocks that are not empty."""
    if isinstance(cloud, pv.MultiBlock):
        return [block for block in cloud.recursive_iterator(skip_none=True, skip_empty=True)]
    return [cloud]


def _drawable(method, cloud):
    """What the mapper of a method draws of a cloud, which has points."""
    if isinstance(cloud, pv.MultiBlock):
        return pv.MultiBlock({name: _drawable(method, cloud[name]) for name in cloud.keys()})
    if not needs_splats(method, cloud):
        return cloud
    return _run(splat_filter(cloud), cloud)


@pv.register_dataset_accessor("point_surface", pv.PolyData)
class PointsAccessor:
    """What makes points ready to be drawn as a surface: ``cloud.point_surface``."""

    def __init__(self, cloud: pv.PolyData) -> None:
        self._cloud = cloud

    def radii(self, neighbors: int = 12) -> pv.PolyData:
        """Return the points with an array ``"radius"`` from the distances to their neighbours.

        Parameters
        ----------
        neighbors : int, default: 12
            How many neighbours are looked at; see ``vtkPointSpacing``.

        Returns
        -------
        pyvista.PolyData
            The cloud with the array.

        Examples
        --------
        >>> import pyvista as pv
        >>> import pointsurface.pyvista
        >>> bool(pv.Sphere().point_surface.radii()["radius"].min() > 0)
        True
        """
        spacing = vtkPointSpacing()
        spacing.SetNumberOfNeighbors(neighbors)
        return _run(spacing, self._cloud)

    def normals(self, neighbors: int = 16) -> pv.PolyData:
        """Return the points with normals estimated from their neighbours and oriented alike.

        Parameters
        ----------
        neighbors : int, default: 16
            How many neighbours are looked at; see ``vtkPointNormals``.

        Returns
        -------
        pyvista.PolyData
            The cloud with its normals active.

        Examples
        --------
        >>> import pyvista as pv
        >>> import pointsurface.pyvista
        >>> pv.PolyData(pv.Sphere().points).point_surface.normals().point_data.active_normals.shape
        (842, 3)
        """
        estimate = vtkPointNormals()
        estimate.SetNumberOfNeighbors(neighbors)
        return _run(estimate, self._cloud)


    def splats(self, order: int = 3, neighbors: int = 64, tolerance: float = 0.0) -> pv.PolyData:
        """Return few polynomial splats that stand for the points, to be added with the method ``"algebraic-splats"``.

        Parameters
        ----------
        order : int, default: 3
            The highest order of the polynomials, 1 to 4.
        neighbors : int, default: 64
            How many points a splat is fitted to; see ``vtkAlgebraicSplats``.
        tolerance : float, default: 0.0
            If over 0, each splat has the lowest order whose residual is not above this.

        Returns
        -------
        pyvista.PolyData
            A point for each splat, with its normal, ``"radius"``, ``"SplatCoefficients"`` and more.

        Examples
        --------
        >>> import pyvista as pv
        >>> import pointsurface.pyvista
        >>> cloud = pv.PolyData(pv.Icosphere(nsub=5).points)
        >>> cloud.point_surface.splats(order=2)["SplatCoefficients"].shape[1]
        6
        """
        filter_ = splat_filter(self._cloud)
        filter_.SetOrder(order)
        filter_.SetNumberOfNeighbors(neighbors)
        filter_.SetTolerance(tolerance)
        return _run(filter_, self._cloud)


@pv.register_dataset_accessor("point_surface", pv.ImageData)
class VolumeAccessor:
    """What makes points from a volume: ``volume.point_surface``."""

    def __init__(self, volume: pv.ImageData) -> None:
        self._volume = volume

    def isosurface(self, isovalues: float | list[float]) -> pv.PolyData:
        """Return points on the surfaces where the active scalars have these values, with normals and radii.

        Parameters
        ----------
        isovalues : float or sequence of float
            The values; see ``vtkIsosurfacePoints``.

        Returns
        -------
        pyvista.PolyData
            One point for each edge of the grid that a surface crosses; no cells.

        Examples
        --------
        >>> import pyvista as pv
        >>> import pointsurface.pyvista
        >>> volume = pv.Wavelet()
        >>> volume.point_surface.isosurface(150.0).n_cells
        0
        """
        filter_ = vtkIsosurfacePoints()
        for i, isovalue in enumerate(np.atleast_1d(isovalues)):
            filter_.SetValue(i, float(isovalue))
        return _run(filter_, self._volume)


def _run(filter_, data):
    filter_.SetInputDataObject(data)
    filter_.Update()
    return pv.wrap(filter_.GetOutput())
