# SPDX-License-Identifier: BSD-3-Clause
"""The mappers by the names that a user types."""

from . import (
    vtkAlgebraicSplatMapper,
    vtkAlgebraicSplats,
    vtkDirectPointMapper,
    vtkImageSpacePointMapper,
    vtkPointSurfaceMapperFactory,
    vtkPullPushMapper,
    vtkSurfaceSplatMapper,
)

METHODS = {
    "pull-push": vtkPullPushMapper,
    "surface-splats": vtkSurfaceSplatMapper,
    "image-space": vtkImageSpacePointMapper,
    "direct": vtkDirectPointMapper,
    "algebraic-splats": vtkAlgebraicSplatMapper,
}


AUTO = "auto"


def chosen(method, cloud):
    """A key of METHODS: `method`, or if that is AUTO what vtkPointSurfaceMapperFactory picks for a vtkDataObject."""
    if method != AUTO:
        return method
    mapper = vtkPointSurfaceMapperFactory.NewMapper(cloud)
    return next(name for name, mapper_class in METHODS.items() if isinstance(mapper, mapper_class))


def needs_splats(method, cloud):
    """Whether the mapper draws splats, and the vtkPolyData `cloud` has none: the output of splat_filter() is to be drawn."""
    is_for_splats = issubclass(METHODS[method], vtkAlgebraicSplatMapper)
    return is_for_splats and not cloud.GetPointData().HasArray("SplatCoefficients")


def splat_filter(cloud):
    """A vtkAlgebraicSplats of the cloud, to be updated."""
    splats = vtkAlgebraicSplats()
    splats.SetInputData(cloud)
    return splats
