// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointCloudPipeline
 * @brief   lets VTK's code for polydata render an input that is none
 *
 * vtkOpenGLPolyDataMapper renders what GetInput() returns, which no subclass can change. While a
 * stand-in is set here, that is what it gets. Not wrapped, not installed: it serves
 * vtkPointSurfaceMapper.
 */
#ifndef vtkPointCloudPipeline_h
#define vtkPointCloudPipeline_h

#include "vtkCompositeDataPipeline.h"

class vtkPointCloudPipeline : public vtkCompositeDataPipeline
{
public:
  static vtkPointCloudPipeline* New();
  vtkTypeMacro(vtkPointCloudPipeline, vtkCompositeDataPipeline);

  /**
   * What GetInputData() returns in place of the input; nullptr (the default) for the input itself.
   * Not owned.
   */
  void SetStandIn(vtkDataObject* standIn) { this->StandIn = standIn; }

  using vtkCompositeDataPipeline::GetInputData;
  vtkDataObject* GetInputData(int port, int connection) override
  {
    return this->StandIn ? this->StandIn : this->Superclass::GetInputData(port, connection);
  }

protected:
  vtkPointCloudPipeline() = default;
  ~vtkPointCloudPipeline() override = default;

private:
  vtkPointCloudPipeline(const vtkPointCloudPipeline&) = delete;
  void operator=(const vtkPointCloudPipeline&) = delete;

  vtkDataObject* StandIn = nullptr;
};

#endif
