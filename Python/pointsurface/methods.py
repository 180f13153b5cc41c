# SPDX-License-Identifier: BSD-3-Clause
"""The mappers by the names that a user types."""

from . import (
    vtkAlgebraicSplatMapper,
    vtkAlgebraicSplats,
    vtkDirectPointMapper,
    vtkImageSpacePointMapper,
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


def needs_splats(method, cloud):
    """Whether the mapper draws splats, and the vtkPolyData `cloud` has none: the output of splat_filter() is to be drawn."""
    is_for_splats = issubclass(METHODS[method], vtkAlgebraicSplatMapper)
    return is_for_splats and not cloud.GetPointData().HasArray("SplatCoefficients")


def splat_filter(cloud):
    """A vtkAlgebraicSplats of the cloud, to be updated."""
    splats = vtkAlgebraicSplats()
    splats.SetInputData(cloud)
    return splats
