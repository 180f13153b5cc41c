// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkDrawableSplats
 * @brief   a set of splats as the mapper draws it: checked, about an origin, grouped by order
 *
 * Takes the arrays that vtkAlgebraicSplats documents. Splats that cannot be drawn are left out.
 * Not wrapped, not installed: it serves vtkAlgebraicSplatMapper.
 */
#ifndef vtkDrawableSplats_h
#define vtkDrawableSplats_h

#include "vtkAlgebraicSplat.h"
#include "vtkType.h"

#include <array>
#include <string>
#include <vector>

class vtkDataArray;
class vtkPolyData;

class vtkDrawableSplats
{
public:
  /// Positions in a list, from the first to the one past the last.
  using Range = std::array<vtkIdType, 2>;

  struct Splat
  {
    std::array<float, 3> Center; ///< about GetOrigin()
    float Radius;
    std::array<float, 3> U, V, Normal; ///< unit
    std::array<float, 2> Heights;      ///< between which g lies over the disc, in units of Radius
    unsigned int Id;                   ///< of its point
    vtkIdType Position;                ///< in the list of points to be drawn
    std::array<float, vtkAlgebraicSplat::MaximumNumberOfCoefficients> Coefficients;
  };

  /**
   * Reads `cloud`, of which the points `ids` (if empty, all) are to be drawn, within `bounds`, with
   * the `normals` of its points; `diagonal` is that of the whole cloud, by which radii are judged
   * (0: they are not). Returns what has to be said of the data, a line each; empty if there is
   * nothing. Where an array is missing or of a wrong form, nothing is drawn.
   */
  std::vector<std::string> Build(vtkPolyData* cloud, vtkDataArray* normals,
    const std::vector<unsigned int>& ids, const double bounds[6], double diagonal);

  /**
   * The splats of an order, 1 to 4.
   */
  const std::vector<Splat>& GetSplats(int order) const { return this->Groups[order - 1]; }
  vtkIdType GetNumberOfSplats() const;

  /**
   * Where in GetSplats(order) those lie that are of points in ranges of the list to be drawn.
   */
  std::vector<Range> GetRanges(int order, const std::vector<Range>& ofPoints) const;

  const std::array<double, 3>& GetOrigin() const { return this->Origin; }

  /**
   * The largest distance of a point of a splat from its centre.
   */
  double GetReach() const { return this->Reach; }
  double GetMeanRadius() const { return this->MeanRadius; }

private:
  std::array<std::vector<Splat>, vtkAlgebraicSplat::MaximumOrder> Groups;
  std::array<double, 3> Origin{};
  double Reach = 0.0;
  double MeanRadius = 0.0;
};

#endif
