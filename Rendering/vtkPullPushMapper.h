// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkPullPushMapper_h
#define vtkPullPushMapper_h

#include "vtkPointSurfaceMapper.h"

class VTKPOINTSURFACE_EXPORT vtkPullPushMapper : public vtkPointSurfaceMapper
{
public:
  static vtkPullPushMapper* New();
  vtkTypeMacro(vtkPullPushMapper, vtkPointSurfaceMapper);

protected:
  vtkPullPushMapper() = default;
  ~vtkPullPushMapper() override = default;

private:
  vtkPullPushMapper(const vtkPullPushMapper&) = delete;
  void operator=(const vtkPullPushMapper&) = delete;
};

#endif
