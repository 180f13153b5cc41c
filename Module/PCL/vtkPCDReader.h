// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPCDReader
 * @brief   reads .pcd files of the Point Cloud Library
 *
 * By pcl::PCDReader: ascii, binary and binary_compressed data, fields of every type and count. What
 * becomes of the fields, the cloud's width and height and the sensor's viewpoint is told by
 * vtkPCLConversion: points, `Normals`, `RGB` or `RGBA`, else an array of the field's name; field
 * data `organised_dims` and `viewpoint`.
 *
 * The header, and the values of ascii data, are checked first. A file that is broken, cut short, or
 * has another size than its header says gives one error that says what is wrong, and an empty
 * output; so does one with no fields x, y and z, or with more than 4 GiB of data.
 *
 * Progress is reported while ascii data are read, where AbortExecute is honoured too, and between
 * the steps for binary data. The output of an aborted reader is empty.
 *
 * @sa
 * vtkPCLConversion
 */

#ifndef vtkPCDReader_h
#define vtkPCDReader_h

#include "vtkPointSurfacePCLModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

class VTKPOINTSURFACEPCL_EXPORT vtkPCDReader : public vtkPolyDataAlgorithm
{
public:
  static vtkPCDReader* New();
  vtkTypeMacro(vtkPCDReader, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to read. Default: none, which is an error when the reader is updated.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * Leave out points with a NaN or infinite coordinate, which sensors give where they saw nothing.
   * If there are any, the cloud is no grid any more: `organised_dims` are then the number of points
   * left, and 1. Default: off, all points stay where they are.
   */
  vtkSetMacro(RemoveInvalidPoints, bool);
  vtkGetMacro(RemoveInvalidPoints, bool);
  vtkBooleanMacro(RemoveInvalidPoints, bool);
  ///@}

protected:
  vtkPCDReader();
  ~vtkPCDReader() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPCDReader(const vtkPCDReader&) = delete;
  void operator=(const vtkPCDReader&) = delete;

  char* FileName = nullptr;
  bool RemoveInvalidPoints = false;
};

#endif
