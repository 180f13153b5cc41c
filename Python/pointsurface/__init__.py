# SPDX-License-Identifier: BSD-3-Clause
"""Point clouds drawn as the closed, lit surfaces that they stand for, with no mesh.

Importing the package gives every class of the C++ module: ``from pointsurface import vtkPullPushMapper``.
"""

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  registers the factories that the mappers' superclasses need

from .vtkPointSurface import *  # noqa: F401,F403
