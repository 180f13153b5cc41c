// SPDX-License-Identifier: BSD-3-Clause
// Whatever a file holds, vtkPCDReader gives a cloud of the size that it tells of, or one error and
// an empty output.
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPCDReader.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <cstdint>
#include <cstdlib>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

namespace
{
struct Counter
{
  int Errors = 0;
  void Count(vtkObject*, unsigned long, void*) { ++this->Errors; }
};

void Require(bool holds)
{
  if (!holds)
  {
    std::abort();
  }
}
} // anonymous namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const int file = memfd_create("cloud.pcd", 0);
  static const std::string name = "/proc/self/fd/" + std::to_string(file);
  Require(ftruncate(file, 0) == 0 && pwrite(file, data, size, 0) == static_cast<ssize_t>(size));

  vtkNew<vtkPCDReader> reader;
  Counter counter;
  reader->AddObserver(vtkCommand::ErrorEvent, &counter, &Counter::Count);
  reader->SetFileName(name.c_str());
  reader->SetRemoveInvalidPoints(size % 2 == 0);
  reader->Update();
  vtkPolyData* cloud = reader->GetOutput();
  if (counter.Errors > 0)
  {
    Require(counter.Errors == 1 && cloud->GetNumberOfPoints() == 0);
    return 0;
  }
  vtkDataArray* dims = cloud->GetFieldData()->GetArray("organised_dims");
  Require(dims && cloud->GetNumberOfPoints() == dims->GetTuple1(0) * dims->GetTuple1(1));
  for (int i = 0; i < cloud->GetPointData()->GetNumberOfArrays(); ++i)
  {
    Require(cloud->GetPointData()->GetArray(i)->GetNumberOfTuples() == cloud->GetNumberOfPoints());
  }
  return 0;
}
