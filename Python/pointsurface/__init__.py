# SPDX-License-Identifier: BSD-3-Clause
"""Point clouds drawn as the closed, lit surfaces that they stand for, with no mesh.

Importing the package gives every class of the C++ module: ``from pointsurface import vtkPullPushMapper``.
"""

import os
import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  registers the factories that the mappers' superclasses need

from .vtkPointSurface import *  # noqa: F401,F403

if sys.platform.startswith("linux") and not os.environ.get("DISPLAY"):
    # With no display VTK from 9.4 on tries X all the same, and warns, before it takes EGL, unless it is told.
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")
