#include "vtkNew.h"
#include "vtkPullPushMapper.h"

int TestPullPushMapper(int, char*[])
{
  vtkNew<vtkPullPushMapper> mapper;
  return EXIT_SUCCESS;
}
