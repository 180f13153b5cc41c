// SPDX-License-Identifier: BSD-3-Clause
#include "vtkBackgroundFillPass.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkBackgroundFillPass);
