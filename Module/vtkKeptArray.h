// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkKeptArray
 * @brief   an array that stays the same object for as long as its values do
 *
 * VTK makes colours anew whenever a mapper, a property or a table is modified, and uploads what is
 * new. This tells values that have changed from objects that have.
 */
#ifndef vtkKeptArray_h
#define vtkKeptArray_h

#include "vtkDataArray.h"
#include "vtkSmartPointer.h"

#include <cstring>

class vtkKeptArray
{
public:
  /**
   * Returns the array of the last call if it has the same values as `array`, else `array`.
   */
  vtkDataArray* Keep(vtkDataArray* array)
  {
    if (!HaveSameValues(this->Array, array))
    {
      this->Array = array;
    }
    return this->Array;
  }

private:
  static bool HaveSameValues(vtkDataArray* a, vtkDataArray* b)
  {
    return a && b && a != b && a->GetDataType() == b->GetDataType() &&
      a->GetNumberOfComponents() == b->GetNumberOfComponents() &&
      a->GetNumberOfTuples() == b->GetNumberOfTuples() && a->HasStandardMemoryLayout() &&
      b->HasStandardMemoryLayout() &&
      std::memcmp(a->GetVoidPointer(0), b->GetVoidPointer(0),
        static_cast<size_t>(a->GetNumberOfValues()) * a->GetDataTypeSize()) == 0;
  }

  vtkSmartPointer<vtkDataArray> Array;
};

#endif
