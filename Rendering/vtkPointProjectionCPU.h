// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointProjectionCPU
 * @brief   the step from points to an image with at most one pixel a point, by the processor
 *
 * The same as vtkPointProjectionOpenGL, for contexts whose OpenGL is run by the processor too: the
 * image is made tile by tile, each from the blocks of points that may fall into it, so that what is
 * worked with stays in a cache and threads share nothing. Points go through a minimum of depth and
 * place for each pixel, and only those that stay visible, or are averaged with these, have their
 * normals, radii and colours fetched. Coordinates are taken about the cloud's centre, so that those
 * of 1e7 keep their detail. The result does not depend on the number of threads.
 */
#ifndef vtkPointProjectionCPU_h
#define vtkPointProjectionCPU_h

#include "vtkPointSurfaceView.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSmartPointer.h"
#include "vtkThinnedPoints.h"
#include "vtkType.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <vector>

class vtkDataArray;
class vtkDrawablePoints;
class vtkSurfaceImage;
struct vtkPointProjectionOptions;

class vtkPointProjectionCPU
{
public:
  vtkPointProjectionCPU();
  ~vtkPointProjectionCPU();

  /**
   * What is drawn: `points`, which have to outlive the use here, and what the layer Color carries
   * of them, a tuple for each point of their cloud: colours as unsigned chars, or texture
   * coordinates as any other type; nullptr for none.
   */
  void SetPoints(const vtkDrawablePoints* points, vtkDataArray* colors);

  /**
   * When what the layer Color carries was last changed.
   */
  vtkMTimeType GetColorsTime() const { return this->ColorsTime; }

  /**
   * What the layer Color carries of a point of the cloud; there is something.
   */
  std::array<float, 4> GetColor(size_t place) const { return this->Values.GetColor(place); }

  using Ranges = std::vector<std::array<vtkIdType, 2>>;

  /**
   * Makes what is drawn of the points in groups of a size, see vtkPointThinning: the ranges of that
   * which are ranges of points. What is drawn of each size is kept.
   */
  Ranges Thin(int size, const Ranges& ranges);

  /**
   * A cloud to draw: its projection, and a view whose MCVC is of the points' own coordinates; what
   * the ids of its points begin with; its colour where the layer Color is wanted and it has none.
   * Thinned, the view's ranges are those of Thin(), and its radii are those of what stands for
   * groups, see vtkPointThinning.
   */
  struct Cloud
  {
    const vtkPointProjectionCPU* Projection = nullptr;
    vtkPointSurfaceView View;
    int Thinning = 1;
    vtkIdType FirstId = 0;
    std::array<float, 4> Color{ 1.0f, 1.0f, 1.0f, 1.0f };
  };

  /**
   * Draws the points of the views' ranges of clouds, in the order of space, into `image`, which
   * is allocated for a rectangle that all views have. With `nearest`, the result of such a run with
   * centre depths, a pixel gets the farthest point within the options' depth tolerance behind its
   * nearest one.
   */
  void Draw(const std::vector<Cloud>& clouds, const vtkPointProjectionOptions& options,
    vtkSurfaceImage& image, vtkSurfaceImage* nearest = nullptr);

  struct Transform;  ///< the view in single precision, for the points about the origin
  struct Footprints; ///< what points leave in their pixels

  /**
   * Points in eye coordinates: normals of unit length, those that are not known facing the viewer;
   * radii in eye units; places among the points of all clouds, or the copies of them, and ids.
   */
  struct EyePoints
  {
    static constexpr int Capacity = 256;
    int Count = 0;
    alignas(64) float X[Capacity], Y[Capacity], Z[Capacity];
    alignas(64) float NormalX[Capacity], NormalY[Capacity], NormalZ[Capacity];
    alignas(64) float Radius[Capacity];
    unsigned int Place[Capacity];
    unsigned int Id[Capacity];
  };
  class EyeBlocks;

private:
  vtkPointProjectionCPU(const vtkPointProjectionCPU&) = delete;
  void operator=(const vtkPointProjectionCPU&) = delete;

  struct Part; ///< a cloud that is drawn
  struct Site; ///< where a block of points falls
  struct Tile; ///< what a thread works on

  /// The values of points: of positions one of the two, about an origin.
  struct Arrays
  {
    const float* FloatPositions = nullptr;
    const double* DoublePositions = nullptr;
    std::array<double, 3> Origin{};
    const float* Normals = nullptr; // nullptr: all points face the viewer
    const float* Radii = nullptr;   // nullptr: all have the same
    const unsigned int* Ids = nullptr;
    const unsigned char* ByteColors = nullptr; // one of the two, or no colours
    const float* FloatColors = nullptr;
    int ColorComponents = 0;

    void SetColors(vtkDataArray* colors); // unsigned chars or floats
    std::array<float, 4> GetColor(size_t place) const;
  };

  vtkThinnedPoints::Frame GetFrame() const; // of thinned points
  Arrays GetArrays(int thinning) const;
  Transform GetTransform(const vtkPointSurfaceView& view) const;
  static std::vector<Part> MakeParts(const std::vector<Cloud>& clouds);
  static const Part& GetPart(const std::vector<Part>& parts, unsigned int place);
  int FindTiles(const std::vector<Part>& parts, const std::array<int, 4>& rectangle);
  void DrawTile(const std::vector<Part>& parts, const vtkPointProjectionOptions& options, int index,
    Tile& tile, vtkSurfaceImage& image, vtkSurfaceImage* nearest) const;
  void ListPoints(const std::vector<Part>& parts, int index, Tile& tile) const;
  static void FetchFootprints(const Part& part, const vtkPointProjectionOptions& options,
    const Tile& tile, const int* list, int count, Footprints& points, unsigned int* places);
  static void FetchNearest(const Part& part, const vtkPointProjectionOptions& options, int begin,
    int end, Tile& tile, vtkSurfaceImage& image);
  static void WriteFootprint(const Part& part, const vtkPointProjectionOptions& options,
    const Footprints& points, int i, unsigned int place, int pixel, Tile& tile,
    vtkSurfaceImage& image);
  static void AddCompanions(const Part& part, const vtkPointProjectionOptions& options, int begin,
    int end, Tile& tile, bool colors);
  static void Average(const vtkPointProjectionOptions& options, int planes, Tile& tile);

  const vtkDrawablePoints* Points = nullptr;
  vtkSmartPointer<vtkDataArray> Positions; // floats or doubles
  vtkSmartPointer<vtkDataArray> Colors;    // unsigned chars or floats
  Arrays Values;
  vtkMTimeType ColorsTime = 0;
  std::map<int, vtkThinnedPoints> Thinned; // by the size of groups
  vtkThinnedPoints::Source ThinnedSource;

  int TileColumns = 0;
  std::vector<Site> Sites;                        // of all blocks of points, in their order
  std::vector<unsigned int> TileSites;            // indices of those of each tile
  std::vector<size_t> SiteEnds;                   // where each tile's end
  vtkSMPThreadLocal<std::shared_ptr<Tile>> Tiles; // kept, so that no frame makes them anew
};

/**
 * The points of the views' ranges of clouds, thinned, those that are within the camera's clipping
 * range, not beyond clipping planes and not culled: block by block, in the order of space.
 */
class vtkPointProjectionCPU::EyeBlocks
{
public:
  /// Points may lie beyond clipping planes by a reach in their radii. The clouds have to outlive
  /// this.
  EyeBlocks(const std::vector<Cloud>& clouds, float clippingReach);
  ~EyeBlocks();

  size_t GetSize() const { return this->Blocks.size(); }
  void Fetch(size_t index, EyePoints& points) const;

  /// What the layer Color carries of the point at a place.
  std::array<float, 4> GetColor(unsigned int place) const;

private:
  std::vector<Part> Parts;
  std::vector<std::array<size_t, 2>> Blocks; // a part and one of its blocks each
  float ClippingReach;
};

#endif
