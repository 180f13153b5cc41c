// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkIsosurfacePoints
 * @brief   points on the isosurfaces of image data, with normals and radii, without triangles
 *
 * vtkIsosurfacePoints gives one point for each grid edge that an isosurface crosses: the vertices
 * of marching cubes or flying edges, so that the density of the cloud is known, at a fraction of
 * the time and memory, since no triangle is made. A voxel is inside when its value is at least the
 * isovalue. Image data of any scalar type, spacing, origin, extent and direction matrix will do; it
 * must be at least two voxels thick in each direction.
 *
 * The output holds points and no cells at all (the point surface mappers draw points without
 * cells), with these point data:
 *
 * - `Normals` (float, unit, the active normals): the gradient, by central differences (one-sided at
 *   the border and beside a voxel that is not finite), interpolated along the edge; from inside
 *   (the higher values) to outside, unless FlipNormals is on. Where the gradient vanishes, as it
 *   often does in label maps, the direction of the edge from inside to outside; so no normal is
 *   undefined.
 * - `radius` (float, in the units of the spacing): balls of these radii cover every triangulation
 *   of the points that stays within the cells, that of marching cubes among them; on smooth surfaces
 *   so do discs in the tangent planes. The radius is the distance from the point to the mean of the
 *   crossings of a cell, the largest of the up to four cells that share the edge. (Proof: take a
 *   triangle between crossings of one cell and project the cell's mean onto its plane. Each of the
 *   three triangles of that foot and one side is cut by its height into two right triangles, each
 *   within reach of the corner that it holds.)
 *
 * Where a voxel equals the isovalue, the crossings of its edges coincide; one point is given for
 * all, with the largest of their radii. The same is done where rounding to the precision of the
 * output makes crossings equal, so that no two points of an isosurface are equal. Edges with an end
 * that is NaN or infinite are skipped, with one warning that counts such voxels. Ghost arrays and
 * blanking are ignored, as in vtkFlyingEdges3D.
 *
 * The filter is threaded by vtkSMPTools. Its output is the same, bit for bit, for any backend and
 * number of threads: ordered by isovalue, then voxel, then axis of the edge.
 *
 * @sa
 * vtkFlyingEdges3D vtkContourFilter vtkPointSpacing vtkPointNormals
 */

#ifndef vtkIsosurfacePoints_h
#define vtkIsosurfacePoints_h

#include "vtkContourValues.h"      // Passes calls through
#include "vtkNew.h"                // For vtkNew
#include "vtkPointSurfaceModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

class VTKPOINTSURFACE_EXPORT vtkIsosurfacePoints : public vtkPolyDataAlgorithm
{
public:
  static vtkIsosurfacePoints* New();
  vtkTypeMacro(vtkIsosurfacePoints, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The isovalues count as properties of the filter.
   */
  vtkMTimeType GetMTime() override;

  ///@{
  /**
   * The isovalues, as in vtkContourFilter: any number of finite values, in any order; each is
   * sampled on its own. Default: one, 0.0. A value that is not finite is skipped with a warning.
   */
  void SetValue(int i, double value) { this->ContourValues->SetValue(i, value); }
  double GetValue(int i) { return this->ContourValues->GetValue(i); }
  double* GetValues() { return this->ContourValues->GetValues(); }
  void GetValues(double* contourValues) { this->ContourValues->GetValues(contourValues); }
  void SetNumberOfContours(int number) { this->ContourValues->SetNumberOfContours(number); }
  vtkIdType GetNumberOfContours() { return this->ContourValues->GetNumberOfContours(); }
  void GenerateValues(int numContours, double range[2])
  {
    this->ContourValues->GenerateValues(numContours, range);
  }
  void GenerateValues(int numContours, double rangeStart, double rangeEnd)
  {
    this->ContourValues->GenerateValues(numContours, rangeStart, rangeEnd);
  }
  ///@}

  ///@{
  /**
   * The component of the array that is contoured, from 0. Default: 0. A component that the array
   * does not have is an error. The array itself is the active point scalars, or that named by
   * SetInputArrayToProcess.
   */
  vtkSetMacro(ArrayComponent, int);
  vtkGetMacro(ArrayComponent, int);
  ///@}

  ///@{
  /**
   * Turn the normals to the inside (the higher values). Default: off.
   */
  vtkSetMacro(FlipNormals, bool);
  vtkGetMacro(FlipNormals, bool);
  vtkBooleanMacro(FlipNormals, bool);
  ///@}

  ///@{
  /**
   * Give the isovalue of each point as the active scalars, an array of doubles of the same name as
   * the input's. Default: off, other than in vtkFlyingEdges3D, since a mapper would colour by it.
   */
  vtkSetMacro(ComputeScalars, bool);
  vtkGetMacro(ComputeScalars, bool);
  vtkBooleanMacro(ComputeScalars, bool);
  ///@}

  ///@{
  /**
   * Interpolate the other point data arrays along the edges, in their own types. Default: off.
   */
  vtkSetMacro(InterpolateAttributes, bool);
  vtkGetMacro(InterpolateAttributes, bool);
  vtkBooleanMacro(InterpolateAttributes, bool);
  ///@}

  ///@{
  /**
   * Precision of the points: vtkAlgorithm::SINGLE_PRECISION, DOUBLE_PRECISION, or
   * DEFAULT_PRECISION (the default), which is single. Single precision that cannot tell hundredths
   * of a voxel apart, because the origin is far away, is warned of.
   */
  vtkSetClampMacro(OutputPointsPrecision, int, SINGLE_PRECISION, DEFAULT_PRECISION);
  vtkGetMacro(OutputPointsPrecision, int);
  ///@}

protected:
  vtkIsosurfacePoints();
  ~vtkIsosurfacePoints() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int FillInputPortInformation(int port, vtkInformation* info) override;

private:
  vtkIsosurfacePoints(const vtkIsosurfacePoints&) = delete;
  void operator=(const vtkIsosurfacePoints&) = delete;

  vtkNew<vtkContourValues> ContourValues;
  int ArrayComponent = 0;
  bool FlipNormals = false;
  bool ComputeScalars = false;
  bool InterpolateAttributes = false;
  int OutputPointsPrecision = DEFAULT_PRECISION;
};

#endif
