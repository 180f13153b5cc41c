// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPCLConversion
 * @brief   clouds of the Point Cloud Library to and from vtkPolyData
 *
 * Both ways by the names of PCL's fields, for any point type that is registered with PCL:
 *
 * - x, y, z: the points, float or double
 * - normal_x, normal_y, normal_z: `Normals`, the active normals
 * - rgb: `RGB`, 3 unsigned chars, the active scalars
 * - rgba: `RGBA`, 4 unsigned chars, the active scalars (*)
 * - any other (intensity, curvature, radius, label...): an array of its name, type and count
 * - "_": left out, as it is padding
 *
 * (*) `RGB` where no point has an opacity, as writers leave it that know none.
 *
 * The cloud's width and height become the field data `organised_dims` (2 ints, one a tuple), the
 * sensor's position and orientation the field data `viewpoint` (7 doubles: x y z qw qx qy qz). The
 * polydata has no cells, which mappers of PointSurface do not need.
 *
 * This header needs PCL's: find_package(PCL COMPONENTS common) in the project that includes it. It
 * is not wrapped for Python.
 *
 * @sa
 * vtkPCDReader
 */

#ifndef vtkPCLConversion_h
#define vtkPCLConversion_h

#include "vtkPointSurfacePCLModule.h" // For export macro

#include <pcl/PCLPointCloud2.h>
#include <pcl/common/io.h>
#include <pcl/point_cloud.h>

#include <string>
#include <vector>

class vtkPolyData;

class VTKPOINTSURFACEPCL_EXPORT vtkPCLConversion
{
public:
  /**
   * A cloud of any point type with x, y and z. Throws std::invalid_argument, with a text for the
   * user, where there is none of these. With removeInvalidPoints points with a NaN or infinite
   * coordinate are left out; if there were any, the cloud is no grid any more, and its
   * organised_dims are the number of points, and 1. Without, they stay where they are.
   */
  template <typename PointT>
  static void ToPolyData(
    const pcl::PointCloud<PointT>& cloud, vtkPolyData* output, bool removeInvalidPoints = false)
  {
    Layout layout;
    layout.Fields = pcl::getFields<PointT>();
    layout.Step = sizeof(PointT);
    layout.Width = cloud.width;
    layout.Height = cloud.height;
    Read(layout, reinterpret_cast<const unsigned char*>(cloud.points.data()), output,
      removeInvalidPoints);
    WriteViewpoint(cloud.sensor_origin_, cloud.sensor_orientation_, output);
  }

  /**
   * A cloud whose fields are known when the program runs, as pcl::PCDReader reads it. Throws
   * std::invalid_argument where it has no x, y, z, or fewer data than its size asks for.
   */
  static void ToPolyData(const pcl::PCLPointCloud2& cloud, const Eigen::Vector4f& origin,
    const Eigen::Quaternionf& orientation, vtkPolyData* output, bool removeInvalidPoints = false);

  /**
   * The same with the points in `size` bytes elsewhere, as in a file that is mapped, and not in the
   * cloud's own data.
   */
  static void ToPolyData(const pcl::PCLPointCloud2& cloud, const unsigned char* data,
    std::size_t size, const Eigen::Vector4f& origin, const Eigen::Quaternionf& orientation,
    vtkPolyData* output, bool removeInvalidPoints = false);

  /**
   * The points and arrays of a polydata as a cloud of a point type, values cast to the types of its
   * fields (out of their range: the nearest that there is). Returns the names of the fields that
   * the polydata has no array for, or one that is too short: these keep the point type's defaults.
   * Colours (`rgb`, `rgba`) come from an array RGB or RGBA, else from active scalars, of 3 or 4
   * unsigned chars. Arrays that the point type has no field for are left out, cells too.
   */
  template <typename PointT>
  static std::vector<std::string> FromPolyData(vtkPolyData* input, pcl::PointCloud<PointT>& cloud)
  {
    Layout layout;
    layout.Fields = pcl::getFields<PointT>();
    layout.Step = sizeof(PointT);
    ReadSize(input, layout);
    cloud.points.clear();
    cloud.points.resize(static_cast<std::size_t>(layout.Width) * layout.Height);
    cloud.width = layout.Width;
    cloud.height = layout.Height;
    ReadViewpoint(input, cloud.sensor_origin_, cloud.sensor_orientation_);
    bool dense = true;
    auto* bytes = reinterpret_cast<unsigned char*>(cloud.points.data());
    std::vector<std::string> missing = Write(input, layout, bytes, dense);
    cloud.is_dense = dense;
    return missing;
  }

private:
  // How points lie in memory.
  struct Layout
  {
    std::vector<pcl::PCLPointField> Fields;
    std::size_t Step = 0; // bytes from a point to the next
    unsigned int Width = 0;
    unsigned int Height = 0;
  };

  static void Read(
    const Layout& layout, const unsigned char* data, vtkPolyData* output, bool removeInvalidPoints);
  static std::vector<std::string> Write(
    vtkPolyData* input, const Layout& layout, unsigned char* data, bool& dense);
  static void ReadSize(vtkPolyData* input, Layout& layout);
  static void ReadViewpoint(
    vtkPolyData* input, Eigen::Vector4f& origin, Eigen::Quaternionf& orientation);
  static void WriteViewpoint(
    const Eigen::Vector4f& origin, const Eigen::Quaternionf& orientation, vtkPolyData* output);
};

#endif
