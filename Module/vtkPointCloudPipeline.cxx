// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointCloudPipeline.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkPointCloudPipeline);
