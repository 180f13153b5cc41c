// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPCLLocalCloud
 * @brief   the positions of a point set as PCL's filters bear them
 *
 * PCL computes in single precision and wants finite coordinates: this is a cloud of the finite
 * points alone, about their middle and of a size of one. Not wrapped, not installed: it serves
 * PCL's filters.
 */
#ifndef vtkPCLLocalCloud_h
#define vtkPCLLocalCloud_h

#include "vtkType.h"

#include <pcl/memory.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/types.h>

#include <functional>
#include <vector>

class vtkAlgorithm;
class vtkPointSet;

class vtkPCLLocalCloud
{
public:
  using Indices = pcl::shared_ptr<pcl::Indices>;

  explicit vtkPCLLocalCloud(vtkPointSet* input);

  pcl::PointCloud<pcl::PointXYZ>::ConstPtr GetCloud() const { return this->Cloud; }

  /**
   * The input's id of a point of the cloud.
   */
  vtkIdType GetId(std::size_t index) const { return this->Ids[index]; }
  std::size_t GetNumberOfPoints() const { return this->Ids.size(); }

  /**
   * A length of the cloud times this is one of the input.
   */
  double GetScale() const { return this->Scale; }
  pcl::PointXYZ ToLocal(const double x[3]) const;
  void ToInput(const pcl::PointXYZ& local, double x[3]) const;

  /**
   * Calls the function with indices of the cloud, batch by batch, between which the filter reports
   * its progress, rising from `from` to `to`, and listens to AbortExecute. Returns false when
   * aborted.
   */
  bool ForBatches(vtkAlgorithm* filter, double from, double to,
    const std::function<void(const Indices& indices)>& function) const;

private:
  pcl::PointCloud<pcl::PointXYZ>::Ptr Cloud;
  std::vector<vtkIdType> Ids;
  double Center[3] = { 0.0, 0.0, 0.0 };
  double Scale = 1.0;
};

#endif
