// SPDX-License-Identifier: BSD-3-Clause
#include "vtkIsosurfacePoints.h"

#include "vtkArrayListTemplate.h" // For processing attribute data
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSurfaceVectorize.h"
#include "vtkPolyData.h"
#include "vtkProgressFor.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <atomic>
#include <bitset>
#include <cfloat>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <vector>

#ifdef _MSC_VER
#include <intrin.h>
#endif

vtkStandardNewMacro(vtkIsosurfacePoints);

namespace
{
//------------------------------------------------------------------------------
// One bit a voxel: whether an edge of the grid is crossed is asked for 64 voxels at a time.
using Word = std::uint64_t;
constexpr int WordBits = 64;

int CountBits(Word word)
{
  return static_cast<int>(std::bitset<WordBits>(word).count());
}

int LowestBit(Word word)
{
#ifdef _MSC_VER
  unsigned long bit;
  _BitScanForward64(&bit, word);
  return static_cast<int>(bit);
#else
  return __builtin_ctzll(word);
#endif
}

// The bits of word `w` of a row that stand for voxels before `end`.
Word BitsBefore(int end, int w)
{
  const int count = end - w * WordBits;
  return count >= WordBits ? ~Word(0) : count <= 0 ? Word(0) : (Word(1) << count) - 1;
}

// A word moved by one voxel, so that bit i tells of voxel i + 1.
Word NextVoxels(Word word, Word nextWord)
{
  return (word >> 1) | (nextWord << (WordBits - 1));
}

// Packs 64 bytes of 0 or 1: the product moves bit 0 of byte i to bit i of the highest byte.
Word Pack(const unsigned char bytes[WordBits])
{
  Word word = 0;
  for (int octet = 0; octet < 8; ++octet)
  {
    Word eight = 0;
    for (int i = 0; i < 8; ++i)
    {
      eight |= static_cast<Word>(bytes[8 * octet + i]) << (8 * i);
    }
    word |= ((eight * 0x0102040810204080u) >> 56) << (8 * octet);
  }
  return word;
}

// Which of 64 values are at least `least`, a byte each; on all lanes for the types that volumes
// mostly are of.
template <typename T, typename Comparable>
VTK_POINT_SURFACE_INLINE void CompareWord(const T* values, Comparable least, unsigned char* bytes)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < WordBits; ++i)
  {
    bytes[i] = static_cast<Comparable>(values[i]) >= least ? 1 : 0;
  }
}

template <typename T, typename Comparable>
void Compare(const T* values, Comparable least, unsigned char* bytes)
{
  CompareWord(values, least, bytes);
}

VTK_POINT_SURFACE_CLONES
void Compare(const unsigned char* values, unsigned char least, unsigned char* bytes)
{
  CompareWord(values, least, bytes);
}

VTK_POINT_SURFACE_CLONES
void Compare(const short* values, short least, unsigned char* bytes)
{
  CompareWord(values, least, bytes);
}

VTK_POINT_SURFACE_CLONES
void Compare(const unsigned short* values, unsigned short least, unsigned char* bytes)
{
  CompareWord(values, least, bytes);
}

VTK_POINT_SURFACE_CLONES
void Compare(const float* values, float least, unsigned char* bytes)
{
  CompareWord(values, least, bytes);
}

VTK_POINT_SURFACE_CLONES
void Compare(const double* values, double least, unsigned char* bytes)
{
  CompareWord(values, least, bytes);
}

//------------------------------------------------------------------------------
// The image as a grid of voxels counted from 0.
struct Grid
{
  int Dims[3];
  vtkIdType Step[3]; // from a voxel to the next along an axis, in the array
  double Corner[3];  // the first voxel, physical
  double Axes[3][3]; // one step along each axis, physical
  double Scale;      // the longest axis; lengths below are relative to it
  double RelativeAxes[3][3];
  double RelativeInverse[3][3]; // [axis][coordinate]: gradients from a step to physical
  double LargestCoordinate;
  double SmallestSpacing;

  // False when the axes do not span space.
  bool Initialize(vtkImageData* image)
  {
    const int* extent = image->GetExtent();
    vtkMatrix4x4* toPhysical = image->GetIndexToPhysicalMatrix();
    const double first[4] = { double(extent[0]), double(extent[2]), double(extent[4]), 1.0 };
    double corner[4];
    toPhysical->MultiplyPoint(first, corner);
    for (int c = 0; c < 3; ++c)
    {
      this->Dims[c] = extent[2 * c + 1] - extent[2 * c] + 1;
      this->Corner[c] = corner[c];
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Axes[axis][c] = toPhysical->GetElement(c, axis);
      }
    }
    this->Step[0] = 1;
    this->Step[1] = this->Dims[0];
    this->Step[2] = this->Step[1] * this->Dims[1];
    const double lengths[3] = { vtkMath::Norm(this->Axes[0]), vtkMath::Norm(this->Axes[1]),
      vtkMath::Norm(this->Axes[2]) };
    this->SmallestSpacing = *std::min_element(lengths, lengths + 3);
    this->Scale = *std::max_element(lengths, lengths + 3);
    double bounds[6];
    image->GetBounds(bounds);
    this->LargestCoordinate = 0.0;
    for (double bound : bounds)
    {
      this->LargestCoordinate = std::max(this->LargestCoordinate, std::abs(bound));
    }
    if (!(this->SmallestSpacing > 0.0) || !std::isfinite(this->Scale))
    {
      return false;
    }
    double matrix[3][3];
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int c = 0; c < 3; ++c)
      {
        this->RelativeAxes[axis][c] = matrix[c][axis] = this->Axes[axis][c] / this->Scale;
      }
    }
    if (vtkMath::Determinant3x3(matrix) == 0.0)
    {
      return false;
    }
    vtkMath::Invert3x3(matrix, this->RelativeInverse);
    return true;
  }

  vtkIdType Voxel(const int ijk[3]) const
  {
    return ijk[0] + ijk[1] * this->Step[1] + ijk[2] * this->Step[2];
  }

  vtkIdType NumberOfRows() const { return vtkIdType(this->Dims[1]) * this->Dims[2]; }
};

//------------------------------------------------------------------------------
// A crossing: where the surface meets the edge from a voxel to the next along an axis.
struct Crossing
{
  int Voxel[3];
  int Axis;
  double T; // along the edge, from 0 to 1

  bool SameEdge(const Crossing& other) const
  {
    return this->Axis == other.Axis && std::equal(this->Voxel, this->Voxel + 3, other.Voxel);
  }
};

// Where the points of all isosurfaces go.
struct Output
{
  vtkPoints* Points;
  vtkFloatArray* Normals;
  vtkFloatArray* Radii;
  vtkDoubleArray* Scalars; // or null
  ArrayList* Attributes;   // or null

  // The arrays' memory, in turn; of the first two, one is null.
  float* FloatPoint = nullptr;
  double* DoublePoint = nullptr;
  float* Normal = nullptr;
  float* Radius = nullptr;
  double* Scalar = nullptr;

  bool SinglePrecision() const { return this->Points->GetDataType() == VTK_FLOAT; }

  void SetNumberOfPoints(vtkIdType count)
  {
    // Resize() keeps what earlier isovalues have written.
    for (vtkDataArray* array : { this->Points->GetData(), static_cast<vtkDataArray*>(this->Normals),
           static_cast<vtkDataArray*>(this->Radii), static_cast<vtkDataArray*>(this->Scalars) })
    {
      if (array)
      {
        array->Resize(count);
        array->SetNumberOfTuples(count);
      }
    }
    if (this->Attributes)
    {
      this->Attributes->Realloc(count);
    }
    void* points = this->Points->GetVoidPointer(0);
    this->FloatPoint = this->SinglePrecision() ? static_cast<float*>(points) : nullptr;
    this->DoublePoint = this->SinglePrecision() ? nullptr : static_cast<double*>(points);
    this->Normal = this->Normals->GetPointer(0);
    this->Radius = this->Radii->GetPointer(0);
    this->Scalar = this->Scalars ? this->Scalars->GetPointer(0) : nullptr;
  }
};

//------------------------------------------------------------------------------
// Cells, worked on together, a lane each. Bit a of a corner: the upper one along axis a.
constexpr int Lanes = 16;

template <typename Real>
struct Cells
{
  Real Corner[8][Lanes]; // values less the isovalue
  float Centre[3][Lanes];
  float* Target[Lanes]; // where the centre goes
  int Count = 0;
};

// The mean of the crossings of each cell, from the cell's first voxel. Any point will do for radii
// that cover the surface, so rounding and values that are not finite may shift it.
template <typename Real>
VTK_POINT_SURFACE_INLINE void FindMeans(Cells<Real>& cells, const float (&axes)[3][3])
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < Lanes; ++i)
  {
    Real sum[3] = { 0, 0, 0 }; // in steps along the axes
    Real count = 0;
    VTK_POINT_SURFACE_UNROLL
    for (int axis = 0; axis < 3; ++axis)
    {
      const int next = 1 << ((axis + 1) % 3);
      const int last = 1 << ((axis + 2) % 3);
      VTK_POINT_SURFACE_UNROLL
      for (int edge = 0; edge < 4; ++edge)
      {
        const int corner = (edge & 1 ? next : 0) + (edge & 2 ? last : 0);
        const Real a = cells.Corner[corner][i];
        const Real b = cells.Corner[corner + (1 << axis)][i];
        const Real ratio = a / (a - b);
        const Real positive = ratio > 0 ? ratio : 0; // what is undefined too
        const Real t = positive < 1 ? positive : 1;
        const Real outside = a >= 0 ? Real(0) : Real(1);
        const Real outsideNext = b >= 0 ? Real(0) : Real(1);
        const Real crossed = std::abs(outside - outsideNext);
        sum[axis] += crossed * t;
        sum[(axis + 1) % 3] += edge & 1 ? crossed : Real(0);
        sum[(axis + 2) % 3] += edge & 2 ? crossed : Real(0);
        count += crossed;
      }
    }
    const Real scale = Real(1) / (count > 1 ? count : Real(1));
    const float step[3] = { static_cast<float>(scale * sum[0]), static_cast<float>(scale * sum[1]),
      static_cast<float>(scale * sum[2]) };
    for (int c = 0; c < 3; ++c)
    {
      cells.Centre[c][i] = step[0] * axes[0][c] + step[1] * axes[1][c] + step[2] * axes[2][c];
    }
  }
}

VTK_POINT_SURFACE_CLONES
void FindCentres(Cells<float>& cells, const float (&axes)[3][3])
{
  FindMeans(cells, axes);
}

VTK_POINT_SURFACE_CLONES
void FindCentres(Cells<double>& cells, const float (&axes)[3][3])
{
  FindMeans(cells, axes);
}

//------------------------------------------------------------------------------
// What a step along an edge is in the output.
template <typename Real>
struct EdgeFrame
{
  float Along[3];              // the edge, in relative lengths
  float SideOffset[4][3];      // to the four cells that share the edge
  Real GradientToNormal[3][3]; // from differences a step
};

// Crossings along one axis, worked on together, a lane each.
template <typename Real>
struct Edges
{
  float T[Lanes];
  Real Gradient[2][3][Lanes]; // at the ends of the edge, in differences a step
  float Centre[4][3][Lanes];  // of the cells that share the edge
  float Normal[3][Lanes];
  bool HasNormal[Lanes]; // or is the gradient's square out of bounds?
  float Radius[Lanes];   // relative
  int Count = 0;
};

// Squares beyond these bounds have overflowed or lost digits.
template <typename Real>
VTK_POINT_SURFACE_INLINE bool IsSafeSquare(Real square)
{
  constexpr Real tiny = std::numeric_limits<Real>::min() / std::numeric_limits<Real>::epsilon();
  return (square > tiny) & (square < Real(1) / tiny);
}

template <typename Real>
VTK_POINT_SURFACE_INLINE void FindNormals(Edges<Real>& edges, const EdgeFrame<Real>& frame)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < Lanes; ++i)
  {
    Real g[3], n[3];
    VTK_POINT_SURFACE_UNROLL
    for (int axis = 0; axis < 3; ++axis)
    {
      const Real first = edges.Gradient[0][axis][i];
      g[axis] = first + edges.T[i] * (edges.Gradient[1][axis][i] - first);
    }
    Real square = 0;
    VTK_POINT_SURFACE_UNROLL
    for (int c = 0; c < 3; ++c)
    {
      n[c] = g[0] * frame.GradientToNormal[0][c] + g[1] * frame.GradientToNormal[1][c] +
        g[2] * frame.GradientToNormal[2][c];
      square += n[c] * n[c];
    }
    edges.HasNormal[i] = IsSafeSquare(square);
    const Real scale = Real(1) / std::sqrt(square);
    VTK_POINT_SURFACE_UNROLL
    for (int c = 0; c < 3; ++c)
    {
      edges.Normal[c][i] = static_cast<float>(scale * n[c]);
    }
  }
}

// A radius is the largest distance from a crossing to the centres of the cells that share its edge.
template <typename Real>
VTK_POINT_SURFACE_INLINE void FindRadii(Edges<Real>& edges, const EdgeFrame<Real>& frame)
{
  VTK_POINT_SURFACE_INDEPENDENT
  for (int i = 0; i < Lanes; ++i)
  {
    float largest = 0.0f;
    VTK_POINT_SURFACE_UNROLL
    for (int side = 0; side < 4; ++side)
    {
      float distance2 = 0.0f;
      VTK_POINT_SURFACE_UNROLL
      for (int c = 0; c < 3; ++c)
      {
        const float d =
          edges.T[i] * frame.Along[c] + frame.SideOffset[side][c] - edges.Centre[side][c][i];
        distance2 += d * d;
      }
      largest = distance2 > largest ? distance2 : largest;
    }
    edges.Radius[i] = std::sqrt(largest);
  }
}

VTK_POINT_SURFACE_CLONES
void FindPoints(Edges<float>& edges, const EdgeFrame<float>& frame)
{
  FindNormals(edges, frame);
  FindRadii(edges, frame);
}

VTK_POINT_SURFACE_CLONES
void FindPoints(Edges<double>& edges, const EdgeFrame<double>& frame)
{
  FindNormals(edges, frame);
  FindRadii(edges, frame);
}

//------------------------------------------------------------------------------
// Samples isosurfaces of one array, one isovalue after the other, in three threaded passes over
// slices: mark the voxels inside, count the points of each row, write them. Threads share nothing
// that they write, and what a row gives depends on the data alone.
template <typename T>
class Sampler
{
public:
  Sampler(const Grid& grid, const T* values, Output& output, bool flipNormals)
    : G(grid)
    , Values(values)
    , Out(output)
    , FlipNormals(flipNormals)
    , RowWords((grid.Dims[0] + WordBits - 1) / WordBits)
    , Inside((this->RowWords + 1) * grid.NumberOfRows())
    , RowStart(grid.NumberOfRows() + 1)
    , SinglePrecision(output.SinglePrecision())
  {
    const double resolution =
      (output.SinglePrecision() ? FLT_EPSILON : DBL_EPSILON) * grid.LargestCoordinate;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Near[axis] = std::min(0.25, 4.0 * resolution / vtkMath::Norm(grid.Axes[axis]));
      for (int c = 0; c < 3; ++c)
      {
        this->RelativeAxes[axis][c] = static_cast<float>(grid.RelativeAxes[axis][c]);
        EdgeFrame<Real>& frame = this->Frames[axis];
        frame.Along[c] = this->RelativeAxes[axis][c];
        for (int side = 0; side < 4; ++side)
        {
          frame.SideOffset[side][c] =
            static_cast<float>((side & 1) * grid.RelativeAxes[(axis + 1) % 3][c] +
              (side >> 1) * grid.RelativeAxes[(axis + 2) % 3][c]);
        }
        for (int from = 0; from < 3; ++from)
        {
          frame.GradientToNormal[from][c] =
            static_cast<Real>((flipNormals ? 1.0 : -1.0) * grid.RelativeInverse[from][c]);
        }
      }
    }
  }

  // Adds the points of an isosurface to the output. False when aborted.
  bool Sample(vtkAlgorithm* filter, double isovalue, double progress, double progressEnd);

  // How many voxels are NaN or infinite; 0 if none of the isosurfaces so far has met one.
  vtkIdType GetNumberOfNotFinite() const { return this->NumberOfNotFinite; }

private:
  // Single precision holds values of these types without loss.
  using Real =
    typename std::conditional<sizeof(T) <= 2 || std::is_same<T, float>::value, float, double>::type;

  struct Crossings
  {
    Word Axis[3];
  };

  // Points that wait until their lanes are full.
  struct PendingEdges : Edges<Real>
  {
    Crossing Of[Lanes];
    const T* Value[Lanes]; // of the edge's first voxel
    vtkIdType Id[Lanes];
  };

  // The centres of the cells below and above a slice of voxels.
  struct CellSlices
  {
    const float* Below;
    const float* Above;
  };

  const Grid& G;
  const T* Values;
  Output& Out;
  bool FlipNormals;
  float RelativeAxes[3][3];
  EdgeFrame<Real> Frames[3]; // of the edges along each axis
  int RowWords;
  std::vector<Word> Inside; // rows of RowWords words and one empty one
  std::vector<Word> Finite; // likewise; empty until a crossing meets one that is not
  std::atomic<bool> MeetsNotFinite{ false };
  vtkIdType NumberOfNotFinite = 0;
  std::vector<vtkIdType> RowStart;
  vtkSMPThreadLocal<std::vector<float>> CentreSlices; // two, kept for the next slices
  bool SinglePrecision;
  double Near[3]; // crossings this close to a voxel may be equal once rounded
  double Isovalue = 0.0;

  vtkIdType Row(int j, int k) const { return j + vtkIdType(k) * this->G.Dims[1]; }
  const Word* InsideRow(int j, int k) const
  {
    return this->Inside.data() + (this->RowWords + 1) * this->Row(j, k);
  }
  Word FiniteWord(int j, int k, int w) const
  {
    return this->Finite.empty() ? BitsBefore(this->G.Dims[0], w)
                                : this->Finite[(this->RowWords + 1) * this->Row(j, k) + w];
  }
  vtkIdType SlicesPerBatch() const
  {
    const vtkIdType batchVoxels = vtkIdType(1) << 24;
    const vtkIdType threads = vtkSMPTools::GetEstimatedNumberOfThreads();
    return threads * std::max<vtkIdType>(1, batchVoxels / this->G.Step[2]);
  }

  // markWord(values, bytes) tells of 64 values, a byte of 0 or 1 each.
  template <typename MarkWord>
  void MarkRow(const T* values, Word* row, const MarkWord& markWord) const;
  void MarkInside(int k);
  void MarkFinite();
  void CountRows(int k);
  void WriteSlices(int begin, int end);
  void WriteRow(int j, int k, const CellSlices& centres, PendingEdges (&edges)[3]) const;
  template <int Axis>
  void TakePoint(vtkIdType& id, Crossing& crossing, const T* value, bool isInner,
    const CellSlices& centres, PendingEdges& edges) const;
  template <int Axis>
  void DeferPoint(vtkIdType id, const Crossing& crossing, const T* value, const CellSlices& centres,
    PendingEdges& edges) const;
  void FlushEdges(PendingEdges& edges) const;
  void WritePoint(vtkIdType id, const Crossing& crossing, const T* value, double radius) const;

  Crossings RowCrossings(int j, int k, int w) const;
  bool IsCrossed(const int voxel[3], int axis) const;
  bool HasFiniteEnds(const Crossing& crossing) const;
  double Interpolate(const T* value, int axis) const;
  void Position(const Crossing& crossing, double x[3]) const;
  bool IsNearVoxel(const Crossing& crossing) const;
  int FindCoincident(const Crossing& crossing, Crossing* coincident, int limit) const;
  bool IsWritten(const Crossing& crossing) const;
  Real Difference(const T* value, int index, int axis) const;
  void Normal(const Crossing& crossing, const T* value, float normal[3]) const;
  void CellCentres(int k, float* centres) const;
  void FlushCells(Cells<Real>& cells) const;
  template <int Axis>
  double Radius(const Crossing& crossing, int k, const CellSlices& centres) const;
  double CoincidentRadius(const Crossing& crossing, const CellSlices& centres) const;
};

//------------------------------------------------------------------------------
template <typename T>
template <typename MarkWord>
void Sampler<T>::MarkRow(const T* values, Word* row, const MarkWord& markWord) const
{
  unsigned char bytes[WordBits];
  const int fullWords = this->G.Dims[0] / WordBits;
  for (int w = 0; w < fullWords; ++w, values += WordBits)
  {
    markWord(values, bytes);
    row[w] = Pack(bytes);
  }
  if (fullWords < this->RowWords)
  {
    T rest[WordBits] = {};
    std::copy_n(values, this->G.Dims[0] % WordBits, rest);
    markWord(rest, bytes);
    row[fullWords] = Pack(bytes) & BitsBefore(this->G.Dims[0], fullWords);
  }
}

//------------------------------------------------------------------------------
// The least value of a type that is inside: comparing values with it, in their own type, takes the
// same decisions as comparing doubles, but narrow vectors. False when no value is inside.
template <typename T>
bool LeastInside(double isovalue, T& least)
{
  const double greatest = static_cast<double>(std::numeric_limits<T>::max());
  const double lowest = static_cast<double>(std::numeric_limits<T>::lowest());
  if (isovalue > greatest)
  {
    return false;
  }
  least = static_cast<T>(std::max(isovalue, lowest));
  if (static_cast<double>(least) < isovalue)
  {
    least = std::is_integral<T>::value
      ? static_cast<T>(least + 1)
      : static_cast<T>(std::nextafter(least, std::numeric_limits<T>::max()));
  }
  return true;
}

//------------------------------------------------------------------------------
template <typename T>
void Sampler<T>::MarkInside(int k)
{
  // Doubles do not tell the greatest 64-bit integers apart.
  using Comparable =
    typename std::conditional<std::is_integral<T>::value && sizeof(T) == 8, double, T>::type;
  Comparable least = 0;
  if (!LeastInside(this->Isovalue, least))
  {
    Word* first = this->Inside.data() + (this->RowWords + 1) * this->Row(0, k);
    std::fill_n(first, (this->RowWords + 1) * this->G.Dims[1], Word(0));
    return;
  }
  for (int j = 0; j < this->G.Dims[1]; ++j)
  {
    const vtkIdType row = this->Row(j, k);
    const T* values = this->Values + row * this->G.Step[1];
    this->MarkRow(values, this->Inside.data() + (this->RowWords + 1) * row,
      [least](const T* word, unsigned char* bytes) { Compare(word, least, bytes); });
  }
}

//------------------------------------------------------------------------------
template <typename T>
void Sampler<T>::MarkFinite()
{
  this->Finite.resize(this->Inside.size());
  std::atomic<vtkIdType> finite(0);
  vtkSMPTools::For(0, this->G.NumberOfRows(),
    [&](vtkIdType begin, vtkIdType end)
    {
      vtkIdType count = 0;
      for (vtkIdType row = begin; row < end; ++row)
      {
        Word* words = this->Finite.data() + (this->RowWords + 1) * row;
        this->MarkRow(this->Values + row * this->G.Step[1], words,
          [](const T* word, unsigned char* bytes) {
            std::transform(
              word, word + WordBits, bytes, [](T value) { return value - value == 0; });
          });
        for (int w = 0; w < this->RowWords; ++w)
        {
          count += CountBits(words[w]);
        }
      }
      finite += count;
    });
  this->NumberOfNotFinite = this->G.Step[2] * this->G.Dims[2] - finite;
}

//------------------------------------------------------------------------------
// The edges from the voxels of a word to their next along each axis that are crossed.
template <typename T>
typename Sampler<T>::Crossings Sampler<T>::RowCrossings(int j, int k, int w) const
{
  const Word* row = this->InsideRow(j, k);
  const Word inside = row[w];
  const Word finite = this->FiniteWord(j, k, w);
  Crossings crossings = { { (inside ^ NextVoxels(inside, row[w + 1])) & finite &
      NextVoxels(finite, this->FiniteWord(j, k, w + 1)),
    0, 0 } };
  if (j + 1 < this->G.Dims[1])
  {
    crossings.Axis[1] =
      (inside ^ this->InsideRow(j + 1, k)[w]) & finite & this->FiniteWord(j + 1, k, w);
  }
  if (k + 1 < this->G.Dims[2])
  {
    crossings.Axis[2] =
      (inside ^ this->InsideRow(j, k + 1)[w]) & finite & this->FiniteWord(j, k + 1, w);
  }
  return crossings;
}

//------------------------------------------------------------------------------
template <typename T>
void Sampler<T>::CountRows(int k)
{
  for (int j = 0; j < this->G.Dims[1]; ++j)
  {
    vtkIdType count = 0;
    for (int w = 0; w < this->RowWords; ++w)
    {
      const Crossings crossings = this->RowCrossings(j, k, w);
      for (int axis = 0; axis < 3; ++axis)
      {
        for (Word bits = crossings.Axis[axis]; bits; bits &= bits - 1)
        {
          Crossing crossing = { { w * WordBits + LowestBit(bits), j, k }, axis, 0.0 };
          crossing.T = this->Interpolate(this->Values + this->G.Voxel(crossing.Voxel), axis);
          if (!this->IsNearVoxel(crossing))
          {
            ++count;
            continue;
          }
          count += this->IsWritten(crossing);
          if (!this->HasFiniteEnds(crossing)) // where T is 0
          {
            this->MeetsNotFinite = true;
          }
        }
      }
    }
    this->RowStart[this->Row(j, k) + 1] = count;
  }
}

//------------------------------------------------------------------------------
template <typename T>
double Sampler<T>::Interpolate(const T* value, int axis) const
{
  const double a = static_cast<double>(*value) - this->Isovalue;
  const double b = static_cast<double>(value[this->G.Step[axis]]) - this->Isovalue;
  // The order of the arguments turns an undefined quotient of overflowed differences into 0.
  return std::min(1.0, std::max(0.0, a / (a - b)));
}

//------------------------------------------------------------------------------
template <typename T>
bool Sampler<T>::HasFiniteEnds(const Crossing& crossing) const
{
  const T* value = this->Values + this->G.Voxel(crossing.Voxel);
  return !std::is_floating_point<T>::value ||
    (std::isfinite(static_cast<double>(*value)) &&
      std::isfinite(static_cast<double>(value[this->G.Step[crossing.Axis]])));
}

//------------------------------------------------------------------------------
template <typename T>
void Sampler<T>::Position(const Crossing& crossing, double x[3]) const
{
  // Summing the index first makes crossings at a voxel equal whichever side they come from.
  double index[3] = { double(crossing.Voxel[0]), double(crossing.Voxel[1]),
    double(crossing.Voxel[2]) };
  index[crossing.Axis] += crossing.T;
  for (int c = 0; c < 3; ++c)
  {
    x[c] = this->G.Corner[c] + index[0] * this->G.Axes[0][c] + index[1] * this->G.Axes[1][c] +
      index[2] * this->G.Axes[2][c];
    if (this->SinglePrecision)
    {
      x[c] = static_cast<float>(x[c]);
    }
  }
}

//------------------------------------------------------------------------------
template <typename T>
bool Sampler<T>::IsNearVoxel(const Crossing& crossing) const
{
  const double near = this->Near[crossing.Axis];
  return crossing.T <= near || crossing.T >= 1.0 - near;
}

//------------------------------------------------------------------------------
template <typename T>
bool Sampler<T>::IsCrossed(const int voxel[3], int axis) const
{
  if (voxel[axis] < 0 || voxel[axis] + 1 >= this->G.Dims[axis])
  {
    return false;
  }
  const vtkIdType first = this->G.Voxel(voxel);
  const double a = static_cast<double>(this->Values[first]);
  const double b = static_cast<double>(this->Values[first + this->G.Step[axis]]);
  return std::isfinite(a) && std::isfinite(b) && (a >= this->Isovalue) != (b >= this->Isovalue);
}

//------------------------------------------------------------------------------
// The crossings about the voxel that this one is near to and that have the same position in the
// output, itself among them, up to a number of them. Edges along z come last and the upper one
// before the lower: so the first crossing is found with all cells about the voxel at hand in
// WriteSlices().
template <typename T>
int Sampler<T>::FindCoincident(const Crossing& crossing, Crossing* coincident, int limit) const
{
  double x[3];
  this->Position(crossing, x);
  int corner[3] = { crossing.Voxel[0], crossing.Voxel[1], crossing.Voxel[2] };
  corner[crossing.Axis] += crossing.T > 0.5;
  int count = 0;
  const bool isAtCorner = crossing.T == 0.0 || crossing.T == 1.0;
  for (int edge = 0; edge < 6 && count < limit; ++edge)
  {
    const int axis = edge / 2;
    Crossing other = { { corner[0], corner[1], corner[2] }, axis, 0.0 };
    other.Voxel[axis] -= edge % 2;
    if (!this->IsCrossed(other.Voxel, axis))
    {
      continue;
    }
    other.T = this->Interpolate(this->Values + this->G.Voxel(other.Voxel), axis);
    bool isEqual = isAtCorner && other.T == edge % 2;
    if (!isEqual)
    {
      double y[3];
      this->Position(other, y);
      isEqual = std::equal(x, x + 3, y);
    }
    if (isEqual)
    {
      coincident[count++] = other;
    }
  }
  return count;
}

//------------------------------------------------------------------------------
template <typename T>
bool Sampler<T>::IsWritten(const Crossing& crossing) const
{
  if (!this->IsNearVoxel(crossing))
  {
    return true;
  }
  Crossing first;
  this->FindCoincident(crossing, &first, 1);
  return first.SameEdge(crossing);
}

//------------------------------------------------------------------------------
// A gradient's component, in differences a step of the grid. Central where both neighbours are
// there and finite.
template <typename T>
typename Sampler<T>::Real Sampler<T>::Difference(const T* value, int index, int axis) const
{
  const vtkIdType step = this->G.Step[axis];
  const Real here = static_cast<Real>(*value);
  const Real lower = index > 0 ? static_cast<Real>(value[-step]) : here;
  const Real upper = index + 1 < this->G.Dims[axis] ? static_cast<Real>(value[step]) : here;
  const bool central = index > 0 && index + 1 < this->G.Dims[axis];
  const Real difference = (central ? Real(0.5) : Real(1)) * (upper - lower);
  if (std::is_floating_point<T>::value && !std::isfinite(difference))
  {
    return std::isfinite(upper) ? upper - here : std::isfinite(lower) ? here - lower : Real(0);
  }
  return difference;
}

//------------------------------------------------------------------------------
template <typename T>
void Sampler<T>::FlushCells(Cells<Real>& cells) const
{
  FindCentres(cells, this->RelativeAxes);
  for (int i = 0; i < cells.Count; ++i)
  {
    for (int c = 0; c < 3; ++c)
    {
      cells.Target[i][c] = cells.Centre[c][i];
    }
  }
  cells.Count = 0;
}

//------------------------------------------------------------------------------
// Of the cells between slices k and k + 1, in relative lengths; those that the surface does not
// cross are left alone.
template <typename T>
void Sampler<T>::CellCentres(int k, float* centres) const
{
  const int cells = this->G.Dims[0] - 1;
  const Real isovalue = static_cast<Real>(this->Isovalue);
  Cells<Real> batch;
  std::fill_n(&batch.Corner[0][0], 8 * Lanes, Real(0));
  for (int j = 0; j + 1 < this->G.Dims[1]; ++j, centres += 3 * cells)
  {
    const Word* rows[4] = { this->InsideRow(j, k), this->InsideRow(j + 1, k),
      this->InsideRow(j, k + 1), this->InsideRow(j + 1, k + 1) };
    const T* values = this->Values + this->Row(j, k) * this->G.Step[1];
    for (int w = 0; w < this->RowWords; ++w)
    {
      const Word any = rows[0][w] | rows[1][w] | rows[2][w] | rows[3][w];
      const Word all = rows[0][w] & rows[1][w] & rows[2][w] & rows[3][w];
      const Word anyNext = rows[0][w + 1] | rows[1][w + 1] | rows[2][w + 1] | rows[3][w + 1];
      const Word allNext = rows[0][w + 1] & rows[1][w + 1] & rows[2][w + 1] & rows[3][w + 1];
      const Word crossed = (any | NextVoxels(any, anyNext)) & ~(all & NextVoxels(all, allNext));
      for (Word bits = crossed & BitsBefore(cells, w); bits; bits &= bits - 1)
      {
        const int i = w * WordBits + LowestBit(bits);
        for (int c = 0; c < 8; ++c)
        {
          const vtkIdType offset =
            (c & 1) + ((c & 2) ? this->G.Step[1] : 0) + ((c & 4) ? this->G.Step[2] : 0);
          batch.Corner[c][batch.Count] = static_cast<Real>(values[i + offset]) - isovalue;
        }
        batch.Target[batch.Count] = centres + 3 * i;
        if (++batch.Count == Lanes)
        {
          this->FlushCells(batch);
        }
      }
    }
  }
  this->FlushCells(batch);
}

//------------------------------------------------------------------------------
// The largest distance from a crossing to the centres of the cells that share its edge.
template <typename T>
template <int Axis>
double Sampler<T>::Radius(const Crossing& crossing, int k, const CellSlices& centres) const
{
  constexpr int B = (Axis + 1) % 3;
  constexpr int C = (Axis + 2) % 3;
  const EdgeFrame<Real>& frame = this->Frames[Axis];
  const float t = static_cast<float>(crossing.T);
  float largest = 0.0f;
  for (int side = 0; side < 4; ++side)
  {
    int cell[3] = { crossing.Voxel[0], crossing.Voxel[1], crossing.Voxel[2] };
    cell[B] -= side & 1;
    cell[C] -= side >> 1;
    if (cell[B] < 0 || cell[C] < 0 || cell[B] + 1 >= this->G.Dims[B] ||
      cell[C] + 1 >= this->G.Dims[C])
    {
      continue;
    }
    const float* centre = (cell[2] < k ? centres.Below : centres.Above) +
      3 * (cell[0] + cell[1] * static_cast<vtkIdType>(this->G.Dims[0] - 1));
    float distance2 = 0.0f;
    for (int c = 0; c < 3; ++c)
    {
      const float d = t * frame.Along[c] + frame.SideOffset[side][c] - centre[c];
      distance2 += d * d;
    }
    largest = std::max(largest, distance2);
  }
  return this->G.Scale * std::sqrt(largest);
}

//------------------------------------------------------------------------------
// The radius that covers what the radii of all the crossings at one position would.
template <typename T>
double Sampler<T>::CoincidentRadius(const Crossing& crossing, const CellSlices& centres) const
{
  Crossing coincident[6];
  const int count = this->FindCoincident(crossing, coincident, 6);
  const int k = crossing.Voxel[2];
  double radius = 0.0;
  for (const Crossing* c = coincident; c < coincident + count; ++c)
  {
    radius = std::max(radius,
      c->Axis == 0     ? this->Radius<0>(*c, k, centres)
        : c->Axis == 1 ? this->Radius<1>(*c, k, centres)
                       : this->Radius<2>(*c, k, centres));
  }
  return std::max(radius, 0.01 * this->G.SmallestSpacing);
}

//------------------------------------------------------------------------------
// Scales to a length of 1; false when that is not possible.
template <typename Real>
bool Normalize(Real v[3])
{
  Real length2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  if (!IsSafeSquare(length2))
  {
    const Real largest = std::max({ std::abs(v[0]), std::abs(v[1]), std::abs(v[2]) });
    if (!(largest > 0) || !std::isfinite(largest))
    {
      return false;
    }
    for (int c = 0; c < 3; ++c)
    {
      v[c] /= largest;
    }
    length2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  }
  const Real scale = Real(1) / std::sqrt(length2);
  for (int c = 0; c < 3; ++c)
  {
    v[c] *= scale;
  }
  return true;
}

//------------------------------------------------------------------------------
template <typename T>
void Sampler<T>::Normal(const Crossing& crossing, const T* value, float normal[3]) const
{
  const EdgeFrame<Real>& frame = this->Frames[crossing.Axis];
  int next[3] = { crossing.Voxel[0], crossing.Voxel[1], crossing.Voxel[2] };
  ++next[crossing.Axis];
  const T* nextValue = value + this->G.Step[crossing.Axis];
  const Real t = static_cast<Real>(crossing.T);
  Real g[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const Real first = this->Difference(value, crossing.Voxel[axis], axis);
    g[axis] = first + t * (this->Difference(nextValue, next[axis], axis) - first);
  }
  Real n[3];
  for (int c = 0; c < 3; ++c)
  {
    n[c] = g[0] * frame.GradientToNormal[0][c] + g[1] * frame.GradientToNormal[1][c] +
      g[2] * frame.GradientToNormal[2][c];
  }
  if (!Normalize(n))
  {
    const bool insideFirst = static_cast<double>(*value) >= this->Isovalue;
    for (int c = 0; c < 3; ++c)
    {
      n[c] = (insideFirst == this->FlipNormals ? -1 : 1) * frame.Along[c];
    }
    Normalize(n);
  }
  std::copy_n(n, 3, normal);
}

//------------------------------------------------------------------------------
// What a lane does not compute of a point.
template <typename T>
void Sampler<T>::WritePoint(
  vtkIdType id, const Crossing& crossing, const T* value, double radius) const
{
  double x[3];
  this->Position(crossing, x);
  for (int c = 0; c < 3; ++c)
  {
    if (this->Out.FloatPoint)
    {
      this->Out.FloatPoint[3 * id + c] = static_cast<float>(x[c]);
    }
    else
    {
      this->Out.DoublePoint[3 * id + c] = x[c];
    }
  }
  this->Out.Radius[id] = static_cast<float>(radius);
  if (this->Out.Scalar)
  {
    this->Out.Scalar[id] = this->Isovalue;
  }
  if (this->Out.Attributes)
  {
    const vtkIdType voxel = value - this->Values;
    this->Out.Attributes->InterpolateEdge(
      voxel, voxel + this->G.Step[crossing.Axis], crossing.T, id);
  }
}

//------------------------------------------------------------------------------
template <typename T>
void Sampler<T>::FlushEdges(PendingEdges& edges) const
{
  if (edges.Count == 0)
  {
    return;
  }
  FindPoints(edges, this->Frames[edges.Of[0].Axis]);
  for (int i = 0; i < edges.Count; ++i)
  {
    float* normal = this->Out.Normal + 3 * edges.Id[i];
    if (edges.HasNormal[i])
    {
      for (int c = 0; c < 3; ++c)
      {
        normal[c] = edges.Normal[c][i];
      }
    }
    else
    {
      this->Normal(edges.Of[i], edges.Value[i], normal);
    }
    this->WritePoint(edges.Id[i], edges.Of[i], edges.Value[i], this->G.Scale * edges.Radius[i]);
  }
  edges.Count = 0;
}

//------------------------------------------------------------------------------
// Leaves a point to the next lane of its axis. All neighbours of the edge's voxels are in the grid.
template <typename T>
template <int Axis>
void Sampler<T>::DeferPoint(vtkIdType id, const Crossing& crossing, const T* value,
  const CellSlices& centres, PendingEdges& edges) const
{
  const int i = edges.Count;
  edges.Of[i] = crossing;
  edges.Value[i] = value;
  edges.Id[i] = id;
  edges.T[i] = static_cast<float>(crossing.T);
  for (int end = 0; end < 2; ++end)
  {
    const T* here = value + end * this->G.Step[Axis];
    for (int axis = 0; axis < 3; ++axis)
    {
      const vtkIdType step = this->G.Step[axis];
      edges.Gradient[end][axis][i] =
        Real(0.5) * (static_cast<Real>(here[step]) - static_cast<Real>(here[-step]));
    }
  }
  const vtkIdType cellRow = this->G.Dims[0] - 1;
  const vtkIdType first = crossing.Voxel[0] + crossing.Voxel[1] * cellRow;
  constexpr int B = (Axis + 1) % 3;
  constexpr int C = (Axis + 2) % 3;
  for (int side = 0; side < 4; ++side)
  {
    const int back[3] = { (B == 0 && (side & 1)) || (C == 0 && (side >> 1)),
      (B == 1 && (side & 1)) || (C == 1 && (side >> 1)),
      (B == 2 && (side & 1)) || (C == 2 && (side >> 1)) };
    const float* centre =
      (back[2] ? centres.Below : centres.Above) + 3 * (first - back[0] - back[1] * cellRow);
    for (int c = 0; c < 3; ++c)
    {
      edges.Centre[side][c][i] = centre[c];
    }
  }
  if (++edges.Count == Lanes)
  {
    this->FlushEdges(edges);
  }
}

//------------------------------------------------------------------------------
// Takes the point on the edge from a voxel, if it is to be written, and counts it.
template <typename T>
template <int Axis>
void Sampler<T>::TakePoint(vtkIdType& id, Crossing& crossing, const T* value, bool isInner,
  const CellSlices& centres, PendingEdges& edges) const
{
  crossing.Axis = Axis;
  crossing.T = this->Interpolate(value, Axis);
  const bool isNear = this->IsNearVoxel(crossing);
  if (isInner && !isNear)
  {
    this->DeferPoint<Axis>(id, crossing, value, centres, edges);
  }
  else if (!isNear || this->IsWritten(crossing))
  {
    this->Normal(crossing, value, this->Out.Normal + 3 * id);
    this->WritePoint(id, crossing, value,
      isNear ? this->CoincidentRadius(crossing, centres)
             : this->Radius<Axis>(crossing, crossing.Voxel[2], centres));
  }
  else
  {
    return;
  }
  ++id;
}

//------------------------------------------------------------------------------
template <typename T>
void Sampler<T>::WriteRow(int j, int k, const CellSlices& centres, PendingEdges (&edges)[3]) const
{
  const vtkIdType row = this->Row(j, k);
  vtkIdType id = this->RowStart[row];
  if (id == this->RowStart[row + 1])
  {
    return;
  }
  const bool isInnerRow = j > 0 && j + 2 < this->G.Dims[1] && k > 0 && k + 2 < this->G.Dims[2];
  for (int w = 0; w < this->RowWords; ++w)
  {
    const Crossings crossings = this->RowCrossings(j, k, w);
    Word bits = crossings.Axis[0] | crossings.Axis[1] | crossings.Axis[2];
    for (; bits; bits &= bits - 1)
    {
      const int bit = LowestBit(bits);
      const int i = w * WordBits + bit;
      Crossing crossing = { { i, j, k }, 0, 0.0 };
      const T* value = this->Values + row * this->G.Step[1] + i;
      const bool isInner = isInnerRow && i > 0 && i + 2 < this->G.Dims[0];
      if ((crossings.Axis[0] >> bit) & 1)
      {
        this->TakePoint<0>(id, crossing, value, isInner, centres, edges[0]);
      }
      if ((crossings.Axis[1] >> bit) & 1)
      {
        this->TakePoint<1>(id, crossing, value, isInner, centres, edges[1]);
      }
      if ((crossings.Axis[2] >> bit) & 1)
      {
        this->TakePoint<2>(id, crossing, value, isInner, centres, edges[2]);
      }
    }
  }
}

//------------------------------------------------------------------------------
template <typename T>
void Sampler<T>::WriteSlices(int begin, int end)
{
  const vtkIdType size = 3 * vtkIdType(this->G.Dims[0] - 1) * (this->G.Dims[1] - 1);
  std::vector<float>& slices = this->CentreSlices.Local();
  slices.resize(2 * size);
  float* below = slices.data();
  float* above = below + size;
  if (begin > 0)
  {
    this->CellCentres(begin - 1, below);
  }
  PendingEdges edges[3] = {};
  for (int k = begin; k < end; ++k, std::swap(below, above))
  {
    if (k + 1 < this->G.Dims[2])
    {
      this->CellCentres(k, above);
    }
    for (int j = 0; j < this->G.Dims[1]; ++j)
    {
      this->WriteRow(j, k, CellSlices{ below, above }, edges);
    }
  }
  for (PendingEdges& axis : edges)
  {
    this->FlushEdges(axis);
  }
}

//------------------------------------------------------------------------------
template <typename T>
bool Sampler<T>::Sample(vtkAlgorithm* filter, double isovalue, double progress, double progressEnd)
{
  this->Isovalue = isovalue;
  const vtkIdType slices = this->G.Dims[2];
  const vtkIdType batch = this->SlicesPerBatch();
  const double third = (progressEnd - progress) / 3.0;
  if (!vtkProgressFor(filter, slices, batch, progress, progress + third,
        [this](vtkIdType begin, vtkIdType end)
        {
          for (; begin < end; ++begin)
          {
            this->MarkInside(static_cast<int>(begin));
          }
        }))
  {
    return false;
  }
  const auto count = [this](vtkIdType begin, vtkIdType end)
  {
    for (; begin < end; ++begin)
    {
      this->CountRows(static_cast<int>(begin));
    }
  };
  if (!vtkProgressFor(filter, slices, batch, progress + third, progress + 2.0 * third, count))
  {
    return false;
  }
  if (this->MeetsNotFinite)
  {
    this->MarkFinite();
    this->MeetsNotFinite = false;
    vtkSMPTools::For(0, slices, count);
  }
  this->RowStart[0] = this->Out.Points->GetNumberOfPoints();
  for (std::size_t row = 1; row < this->RowStart.size(); ++row)
  {
    this->RowStart[row] += this->RowStart[row - 1];
  }
  this->Out.SetNumberOfPoints(this->RowStart.back());
  return vtkProgressFor(filter, slices, batch, progress + 2.0 * third, progressEnd,
    [this](vtkIdType begin, vtkIdType end)
    { this->WriteSlices(static_cast<int>(begin), static_cast<int>(end)); });
}
} // anonymous namespace

//------------------------------------------------------------------------------
vtkIsosurfacePoints::vtkIsosurfacePoints()
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
}

//------------------------------------------------------------------------------
vtkMTimeType vtkIsosurfacePoints::GetMTime()
{
  return std::max(this->Superclass::GetMTime(), this->ContourValues->GetMTime());
}

//------------------------------------------------------------------------------
int vtkIsosurfacePoints::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

//------------------------------------------------------------------------------
namespace
{
std::string NameOf(vtkAbstractArray* array)
{
  return array->GetName() ? std::string("array '") + array->GetName() + "'" : "the unnamed array";
}

// One component of an array as a plain C array: the array itself where it is that already.
vtkSmartPointer<vtkDataArray> PlainComponent(vtkDataArray* array, int component)
{
  const bool isBit = array->GetDataType() == VTK_BIT;
  if (array->HasStandardMemoryLayout() && array->GetNumberOfComponents() == 1 && !isBit)
  {
    return array;
  }
  auto plain = vtk::TakeSmartPointer(
    vtkDataArray::CreateDataArray(isBit ? VTK_UNSIGNED_CHAR : array->GetDataType()));
  plain->SetNumberOfTuples(array->GetNumberOfTuples());
  plain->CopyComponent(0, array, component);
  return plain;
}

template <typename T>
bool SampleAll(vtkIsosurfacePoints* self, const Grid& grid, const T* values,
  const std::vector<double>& isovalues, Output& output, vtkIdType& notFinite)
{
  Sampler<T> sampler(grid, values, output, self->GetFlipNormals());
  const double share = 1.0 / isovalues.size();
  double progress = 0.0;
  bool finished = true;
  for (double isovalue : isovalues)
  {
    finished = finished && sampler.Sample(self, isovalue, progress, progress + share);
    progress += share;
  }
  notFinite = sampler.GetNumberOfNotFinite();
  return finished;
}
} // anonymous namespace

//------------------------------------------------------------------------------
int vtkIsosurfacePoints::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkPolyData* output = vtkPolyData::GetData(outputVector);

  // Each fault in the input ends in one error and an empty output.
  if (input->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  int dims[3];
  input->GetDimensions(dims);
  if (*std::min_element(dims, dims + 3) < 2)
  {
    vtkErrorMacro("The image is " << dims[0] << " x " << dims[1] << " x " << dims[2]
                                  << " voxels; an isosurface needs 2 or more in each direction. "
                                     "For contour lines of a slice use vtkFlyingEdges2D.");
    return 1;
  }
  Grid grid;
  if (!grid.Initialize(input))
  {
    vtkErrorMacro("The spacing and direction matrix of the image span no volume; give it a spacing "
                  "above 0 along each axis.");
    return 1;
  }
  vtkDataArray* array = this->GetInputArrayToProcess(0, inputVector);
  if (!array)
  {
    vtkErrorMacro("The image has no such point data array to contour; make an array its active "
                  "scalars or name one by SetInputArrayToProcess.");
    return 1;
  }
  if (array->GetNumberOfTuples() != input->GetNumberOfPoints())
  {
    vtkErrorMacro(<< NameOf(array) << " has " << array->GetNumberOfTuples() << " values for "
                  << input->GetNumberOfPoints()
                  << " voxels; give it one a voxel (cell data: see vtkCellDataToPointData).");
    return 1;
  }
  if (this->ArrayComponent < 0 || this->ArrayComponent >= array->GetNumberOfComponents())
  {
    vtkErrorMacro("ArrayComponent is " << this->ArrayComponent << ", but " << NameOf(array)
                                       << " has " << array->GetNumberOfComponents()
                                       << " components, counted from 0.");
    return 1;
  }
  std::vector<double> isovalues(this->GetValues(), this->GetValues() + this->GetNumberOfContours());
  const auto finiteEnd = std::remove_if(
    isovalues.begin(), isovalues.end(), [](double value) { return !std::isfinite(value); });
  if (finiteEnd != isovalues.end())
  {
    vtkWarningMacro(<< isovalues.end() - finiteEnd
                    << " isovalues are NaN or infinite and are skipped; set finite ones.");
    isovalues.erase(finiteEnd, isovalues.end());
  }

  vtkNew<vtkPoints> points;
  points->SetDataType(
    this->OutputPointsPrecision == vtkAlgorithm::DOUBLE_PRECISION ? VTK_DOUBLE : VTK_FLOAT);
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  normals->SetName("Normals");
  vtkNew<vtkFloatArray> radii;
  radii->SetName("radius");
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetName(array->GetName());
  ArrayList attributes;
  if (this->InterpolateAttributes)
  {
    output->GetPointData()->InterpolateAllocate(input->GetPointData());
    attributes.ExcludeArray(array);
    attributes.AddArrays(0, input->GetPointData(), output->GetPointData());
    output->GetPointData()->RemoveArray(array->GetName());
  }
  Output arrays = { points, normals, radii, this->ComputeScalars ? scalars.Get() : nullptr,
    this->InterpolateAttributes ? &attributes : nullptr };

  if (points->GetDataType() == VTK_FLOAT &&
    FLT_EPSILON * grid.LargestCoordinate > 0.01 * grid.SmallestSpacing)
  {
    vtkWarningMacro("Coordinates of "
      << grid.LargestCoordinate << " in single precision cannot tell hundredths of a voxel of "
      << grid.SmallestSpacing
      << " apart; use SetOutputPointsPrecision(DOUBLE_PRECISION) or "
         "move the origin.");
  }

  vtkSmartPointer<vtkDataArray> plain = PlainComponent(array, this->ArrayComponent);
  vtkIdType notFinite = 0;
  bool finished = false;
  switch (plain->GetDataType())
  {
    vtkTemplateMacro(
      finished = SampleAll(
        this, grid, static_cast<VTK_TT*>(plain->GetVoidPointer(0)), isovalues, arrays, notFinite));
  }
  if (notFinite > 0)
  {
    vtkWarningMacro(<< NameOf(array) << " has " << notFinite
                    << " values that are NaN or infinite; edges that end in them give no points.");
  }
  if (!finished)
  {
    output->Initialize();
    return 1;
  }
  output->SetPoints(points);
  output->GetPointData()->SetNormals(normals);
  output->GetPointData()->AddArray(radii);
  if (this->ComputeScalars)
  {
    output->GetPointData()->SetScalars(scalars);
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkIsosurfacePoints::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->ContourValues->PrintSelf(os, indent.GetNextIndent());
  os << indent << "ArrayComponent: " << this->ArrayComponent << "\n";
  os << indent << "FlipNormals: " << (this->FlipNormals ? "On\n" : "Off\n");
  os << indent << "ComputeScalars: " << (this->ComputeScalars ? "On\n" : "Off\n");
  os << indent << "InterpolateAttributes: " << (this->InterpolateAttributes ? "On\n" : "Off\n");
  os << indent << "OutputPointsPrecision: " << this->OutputPointsPrecision << "\n";
}
