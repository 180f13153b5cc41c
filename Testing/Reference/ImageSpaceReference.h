// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   ImageSpaceReference
 * @brief   the published steps of image-space point rendering, slow, plain and in double precision
 *
 * Rosenthal and Linsen, "Image-space Point Cloud Rendering" (2008), sections 4 to 7, on an image of
 * one-pixel projections. It is what the mappers and passes are compared with, so it shares no code
 * with them and nothing in it is fast.
 *
 * What the text leaves open is settled so:
 * - What is outside of the image is background, and background is behind every surface.
 * - Of neighbours of equal depth the first counts, from the right one on, counter-clockwise.
 * - A weighted sum is divided by the sum of the weights that it has; sums of normals are brought to
 *   unit length, and one shorter than 1e-6 of the weights gives way to the pixel's own normal.
 */
#ifndef ImageSpaceReference_h
#define ImageSpaceReference_h

#include <array>
#include <cstddef>
#include <limits>
#include <vector>

class ImageSpaceReference
{
public:
  struct Pixel
  {
    double Depth = 0.0; ///< along the view direction; 0 is background
    std::array<double, 3> Normal{};
    std::array<double, 4> Color{};
    int Source = -1; ///< id of the point that it came from
    // Of a projected point, for FillWithinDiscs():
    double Radius = 0.0;                  ///< in world units
    std::array<double, 2> Displacement{}; ///< from the pixel's centre to the point, in pixels
    /**
     * A comparison that made this pixel what it is, or one that it depends on, was so close
     * (some units in the last place of a float) that rounding may turn it.
     */
    bool NearDecision = false;
  };

  ImageSpaceReference(int width, int height);

  int GetWidth() const { return this->Width; }
  int GetHeight() const { return this->Height; }
  Pixel& At(int x, int y) { return this->Pixels[static_cast<size_t>(y) * this->Width + x]; }

  /**
   * A background pixel for what is outside.
   */
  const Pixel& Get(int x, int y) const;

  /**
   * Where eye coordinates fall: pixel = center + focal (x, y) / depth, without the division in a
   * parallel projection; depth is -z.
   */
  struct Camera
  {
    double Focal = 1.0;
    std::array<double, 2> Center{};
    bool Parallel = false;
  };

  /**
   * Not in the paper, see vtkDiscFillOptions: pixels that are empty, or behind by more than
   * `layerDistance`, take the values of a point at most `reach` pixels off in whose disc they lie.
   * The disc is projected by how its two axes are, not by a formula for its second moment.
   */
  void FillWithinDiscs(const Camera& camera, int reach, double layerDistance);

  /**
   * Section 4: fills background pixels, at most `maximum` times; returns how often any was filled.
   * With a `reach` over 0, not in the paper, only those from which the surface in front is seen
   * within so many pixels in some of any three neighbouring directions of the eight.
   */
  int FillBackground(int maximum, int reach = 0);

  /**
   * Section 5, the same for pixels behind others by more than `layerDistance`.
   */
  int FillOccluded(int maximum, double layerDistance, int reach = 0);

  /**
   * Section 6: weights of the pixel, a neighbour along a side, one over a corner. Neighbours that
   * are farther off in depth than `layerDistance` do not count; in the paper all do. With
   * `twoSided`, normals are turned to the side of the pixel's own.
   */
  void Smooth(const std::array<double, 3>& weights,
    double layerDistance = std::numeric_limits<double>::infinity(), bool twoSided = false);

  /**
   * Section 7: the Laplace filter of table 2; infinite at the border of background and surface.
   */
  double Laplace(int x, int y) const;

  /**
   * Section 7: the mean of colours with the Gaussian kernel of table 1.
   */
  std::array<double, 4> Blend(int x, int y) const;

private:
  enum CloseCalls
  {
    AsTheyAre,
    InFront,
    Beyond
  };

  /**
   * Whether a mask of figure 4 fits around (x, y), where `limit` is the depth beyond which a pixel
   * is white.
   */
  bool MaskFits(int x, int y, double limit, CloseCalls closeCalls) const;
  bool IsOpen(int x, int y, double limit, int reach, CloseCalls closeCalls) const;
  bool FillPixel(const ImageSpaceReference& before, int x, int y, double limit, int reach);
  double GetDiscDistance(const Camera& camera, int x, int y, int u, int v) const;
  bool IsInFront(const Pixel& pixel, double limit, CloseCalls closeCalls) const;

  int Width;
  int Height;
  std::vector<Pixel> Pixels;
};

#endif
