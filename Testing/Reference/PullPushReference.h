// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   PullPushReference
 * @brief   the published pull-push reconstruction, slow, plain and in double precision
 *
 * Marroquim, Kraus and Cavalcanti, "Efficient Point-Based Rendering Using Image Reconstruction"
 * (2007), sections 3.2 and 3.3, from the image of one-pixel projections to the reconstructed
 * image. It is what the mappers are compared with, so it shares no code with them and nothing in
 * it is fast.
 *
 * What the text leaves open is settled so:
 * - Level 0 is the viewport, of any size; level l+1 has half the width and height, rounded up. The
 *   children of (x, y) are (2x, 2y), (2x+1, 2y), (2x, 2y+1), (2x+1, 2y+1); those outside are
 *   invalid. The centre of pixel (x, y) of level l is ((x + 1/2) 2^l, (y + 1/2) 2^l) in pixels of
 *   level 0.
 * - Averages in the pull phase have no weights. An average of normals shorter than 1e-6 gives way
 * to the front child's normal (pull) or that of the contributor of greatest weight (push).
 * - A pixel's source is that of its front child (pull) or of the contributor of greatest weight
 *   (push); the first in order among equals.
 * - A pixel's ellipse is measured in eye units at its minimum depth, and its squeeze is bounded:
 *   the minor axis is at least 1/1000 of the major axis.
 * - An occluded pixel to which no coarser pixel contributes keeps its own values.
 *
 * @sa SurfaceBufferComparison
 */
#ifndef PullPushReference_h
#define PullPushReference_h

#include <array>
#include <cstddef>
#include <vector>

class PullPushReference
{
public:
  struct Pixel
  {
    bool Valid = false;
    std::array<double, 3> Normal{}; ///< eye space, unit length
    double Radius = 0.0;            ///< eye units, over 0
    double MinimumDepth = 0.0;      ///< along the view direction, eye units
    double MaximumDepth = 0.0;
    std::array<double, 2> Displacement{}; ///< pixel's centre to ellipse's centre, level-0 pixels
    std::array<double, 4> Color{};
    int Source = -1; ///< id of the point that decided the pixel

    /**
     * A comparison that made this pixel what it is, or one that it is computed from, was so close
     * (1e-5) that rounding may turn it.
     */
    bool NearDecision = false;
    /**
     * The push phase recomputed the pixel.
     */
    bool Recomputed = false;
  };

  class Image
  {
  public:
    Image(int width, int height);
    int GetWidth() const { return this->Width; }
    int GetHeight() const { return this->Height; }
    bool Contains(int x, int y) const;
    Pixel& At(int x, int y) { return this->Pixels[this->Index(x, y)]; }
    const Pixel& At(int x, int y) const { return this->Pixels[this->Index(x, y)]; }

  private:
    size_t Index(int x, int y) const { return static_cast<size_t>(y) * this->Width + x; }
    int Width;
    int Height;
    std::vector<Pixel> Pixels;
  };

  /**
   * The matrix from eye to clip coordinates, row-major: clip = P eye.
   */
  using Matrix = std::array<double, 16>;

  /**
   * A pixel as the projection of one point leaves it (section 3.1): the depth interval is
   * [depth, depth + radius] and the ellipse lies at the pixel's centre.
   */
  static Pixel MakePoint(
    const std::array<double, 3>& normal, double radius, double depth, int source);

  /**
   * Number of levels above the first until there is one pixel left.
   */
  static int FullLevels(int width, int height);

  /**
   * The reconstruction of `projected` with a pyramid of `levels` levels above it; 0 or more.
   */
  PullPushReference(const Image& projected, const Matrix& projection, int levels);

  /**
   * Level 0 is the reconstructed image; coarser levels are as the push phase left them.
   */
  const Image& GetLevel(int level) const { return this->Levels[level]; }
  const Image& GetResult() const { return this->Levels[0]; }

  /**
   * Whether `center` (level-0 pixels) lies in the ellipse of a pixel whose own centre is
   * `pixelCenter`. Sets `nearDecision`, and never clears it, when it is a close call.
   */
  bool EllipseContains(const Pixel& pixel, const std::array<double, 2>& pixelCenter,
    const std::array<double, 2>& center, bool& nearDecision) const;

private:
  struct Contributor
  {
    const Pixel* Source;
    double Weight;
    std::array<double, 2> Center;
  };

  void Pull(int fineLevel);
  void Push(int fineLevel);
  Pixel PullPixel(int fineLevel, int x, int y) const;
  Pixel PushPixel(int fineLevel, int x, int y) const;
  std::vector<Contributor> FindContributors(int fineLevel, int x, int y, bool& nearDecision) const;
  static Pixel Average(const std::vector<Contributor>& contributors, const Contributor& fallback,
    const std::array<double, 2>& center);

  std::vector<Image> Levels;
  Matrix Projection;
};

#endif
