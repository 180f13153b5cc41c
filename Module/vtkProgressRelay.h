// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkProgressRelay_h
#define vtkProgressRelay_h

#include "vtkAlgorithm.h"
#include "vtkCommand.h"

/**
 * Observes the progress of a filter that another one runs inside: passes it on as a part of the
 * outer one's progress, and the wish to abort back.
 */
class vtkProgressRelay : public vtkCommand
{
public:
  static vtkProgressRelay* New() { return new vtkProgressRelay; }
  vtkTypeMacro(vtkProgressRelay, vtkCommand);

  void Set(vtkAlgorithm* to, double begin, double end)
  {
    this->To = to;
    this->Begin = begin;
    this->End = end;
  }

  void Execute(vtkObject* from, unsigned long, void*) override
  {
    auto* filter = static_cast<vtkAlgorithm*>(from);
    this->To->UpdateProgress(this->Begin + (this->End - this->Begin) * filter->GetProgress());
    filter->SetAbortExecute(this->To->GetAbortExecute());
  }

private:
  vtkAlgorithm* To = nullptr;
  double Begin = 0.0;
  double End = 1.0;
};

#endif
