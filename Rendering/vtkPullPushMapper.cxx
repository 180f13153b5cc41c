// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPullPushMapper.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPullPushMapper);
