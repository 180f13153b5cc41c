# SPDX-License-Identifier: BSD-3-Clause
"""The mappers by the names that a user types."""

from . import vtkDirectPointMapper, vtkImageSpacePointMapper, vtkPullPushMapper

METHODS = {
    "pull-push": vtkPullPushMapper,
    "image-space": vtkImageSpacePointMapper,
    "direct": vtkDirectPointMapper,
}
