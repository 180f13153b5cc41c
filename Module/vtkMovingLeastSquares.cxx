// SPDX-License-Identifier: BSD-3-Clause
#include "vtkMovingLeastSquares.h"

#include "vtk_eigen.h"

#include VTK_EIGEN(Dense)

#include <algorithm>
#include <cmath>

namespace
{
using Eigen::Vector3d;

constexpr int MaximumPlaneIterations = 30;
constexpr double PlaneTolerance = 1e-10; // of the change of a unit normal
/// Of pivots, for columns of size 1. The plane is that of least squares, which in double precision
/// do not tell lesser deviations from a line.
constexpr double LeastRankThreshold = 1e-6;

Vector3d ToEigen(const vtkMovingLeastSquares::Vector& v)
{
  return { v[0], v[1], v[2] };
}

vtkMovingLeastSquares::Vector FromEigen(const Vector3d& v)
{
  return { v[0], v[1], v[2] };
}

/// The direction in which points vary least about their weighted mean, which is set.
template <typename Weight>
Vector3d GetLeastDirection(
  const std::vector<vtkMovingLeastSquares::Vector>& points, const Weight& weight, Vector3d& mean)
{
  double total = 0.0;
  mean.setZero();
  for (const auto& p : points)
  {
    const double w = weight(ToEigen(p));
    mean += w * ToEigen(p);
    total += w;
  }
  mean /= total;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& p : points)
  {
    const Vector3d d = ToEigen(p) - mean;
    covariance += (weight(ToEigen(p)) / total) * d * d.transpose();
  }
  const double size = covariance.trace();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(
    size > 0.0 ? Eigen::Matrix3d(covariance / size) : covariance);
  return solver.eigenvectors().col(0);
}

using Decomposition = Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;

/// The terms of a polynomial, from 1 on, times `factor`.
template <typename Row>
void SetTerms(Row&& row, int order, double u, double v, double factor)
{
  row[0] = factor;
  for (int degree = 1; degree <= order; ++degree)
  {
    row[vtkAlgebraicSplat::Index(degree, 0)] = row[vtkAlgebraicSplat::Index(degree - 1, 0)] * u;
    for (int b = 1; b <= degree; ++b)
    {
      row[vtkAlgebraicSplat::Index(degree - b, b)] =
        row[vtkAlgebraicSplat::Index(degree - b, b - 1)] * v;
    }
  }
}

/// The largest factor, on a circle around the centre, from an error of the heights to one of the
/// fit.
double GetAmplification(
  const Decomposition& qr, const Eigen::VectorXd& sizes, int order, double radius)
{
  constexpr int Directions = 16;
  const Eigen::Index count = sizes.size();
  const auto upper =
    qr.matrixR().topLeftCorner(count, count).template triangularView<Eigen::Upper>();
  double largest = 0.0;
  Eigen::VectorXd terms(count);
  for (int i = 0; i < Directions; ++i)
  {
    const double angle = 2.0 * EIGEN_PI * i / Directions;
    SetTerms(terms, order, radius * std::cos(angle), radius * std::sin(angle), 1.0);
    const Eigen::VectorXd scaled = qr.colsPermutation().transpose() * terms.cwiseQuotient(sizes);
    largest = std::max(largest, upper.transpose().solve(scaled).norm());
  }
  return largest;
}

/// A unit vector across `normal`, the same for the same normal.
Vector3d GetAxisAcross(const Vector3d& normal)
{
  int least = 0;
  normal.cwiseAbs().minCoeff(&least);
  return Vector3d::Unit(least).cross(normal).normalized();
}
}

vtkAlgebraicSplat vtkMovingLeastSquares::Fit(
  const Vector& center, const Vector& hint, double featureSize, double radiusFactor)
{
  vtkAlgebraicSplat splat;
  this->FitPlane(hint, featureSize, splat);
  for (int k = 0; k < 3; ++k)
  {
    splat.Origin[k] = center[k] + this->Offset * splat.Normal[k];
  }
  splat.Radius = radiusFactor * splat.FeatureSize;
  if (splat.Radius > 0.0)
  {
    this->FitPolynomial(splat);
  }
  return splat;
}

//------------------------------------------------------------------------------
void vtkMovingLeastSquares::FitPlane(
  const Vector& hint, double featureSize, vtkAlgebraicSplat& splat)
{
  Vector3d mean;
  Vector3d normal = GetLeastDirection(
    this->Neighbors, [](const Vector3d&) { return 1.0; }, mean);
  const double h =
    featureSize > 0.0 ? featureSize : this->GetMeanDistanceInPlane(FromEigen(normal));
  double offset = normal.dot(mean);
  for (int i = 0; i < MaximumPlaneIterations && h > 0.0; ++i)
  {
    const Vector3d origin = offset * normal;
    const Vector3d next = GetLeastDirection(
      this->Neighbors,
      [&](const Vector3d& p) { return std::exp(-(p - origin).squaredNorm() / (h * h)); }, mean);
    const double change = 1.0 - std::abs(next.dot(normal));
    const double nextOffset = next.dot(mean);
    const double moved = (nextOffset * next - origin).norm();
    normal = next;
    offset = nextOffset;
    if (change <= PlaneTolerance * PlaneTolerance && moved <= PlaneTolerance * h)
    {
      break;
    }
  }
  if (normal.dot(ToEigen(hint)) < 0.0)
  {
    normal = -normal;
    offset = -offset;
  }
  const Vector3d u = GetAxisAcross(normal);
  splat.Normal = FromEigen(normal);
  splat.U = FromEigen(u);
  splat.V = FromEigen(normal.cross(u));
  splat.FeatureSize = featureSize > 0.0 ? featureSize : this->GetMeanDistanceInPlane(splat.Normal);
  this->Offset = offset;
}

double vtkMovingLeastSquares::GetMeanDistanceInPlane(const Vector& normal) const
{
  double sum = 0.0;
  for (const Vector& p : this->Neighbors)
  {
    const Vector3d inPlane = ToEigen(p) - ToEigen(normal).dot(ToEigen(p)) * ToEigen(normal);
    sum += inPlane.norm();
  }
  return this->Neighbors.empty() ? 0.0 : sum / this->Neighbors.size();
}

//------------------------------------------------------------------------------
void vtkMovingLeastSquares::FitPolynomial(vtkAlgebraicSplat& splat) const
{
  const auto rows = static_cast<Eigen::Index>(this->Neighbors.size());
  const int columns = vtkAlgebraicSplat::GetNumberOfCoefficients(this->Order);
  Eigen::MatrixXd terms(rows, columns); // in units of the radius, times the root of the weight
  Eigen::VectorXd heights(rows);
  double weights = 0.0;
  for (Eigen::Index row = 0; row < rows; ++row)
  {
    const Vector3d p = ToEigen(this->Neighbors[row]);
    const double u = p.dot(ToEigen(splat.U)) / splat.Radius;
    const double v = p.dot(ToEigen(splat.V)) / splat.Radius;
    const double height = (p.dot(ToEigen(splat.Normal)) - this->Offset) / splat.Radius;
    const double d = p.norm() / splat.FeatureSize;
    const double root = std::exp(-0.5 * d * d);
    weights += root * root;
    heights[row] = root * height;
    SetTerms(terms.row(row), this->Order, u, v, root);
  }

  const double threshold = std::max(LeastRankThreshold, this->Rounding / splat.Radius);
  splat.RankDeficient = true;
  for (int order = this->Tolerance > 0.0 ? 1 : this->Order; order <= this->Order; ++order)
  {
    // the highest order, up to this one, that the neighbours determine
    for (int lower = order; lower > 0; --lower)
    {
      const int count = vtkAlgebraicSplat::GetNumberOfCoefficients(lower);
      if (rows < count)
      {
        continue;
      }
      const Eigen::VectorXd sizes = terms.leftCols(count).colwise().norm();
      if (!(sizes.minCoeff() > threshold * sizes[0]))
      {
        continue;
      }
      Decomposition qr;
      qr.setThreshold(threshold);
      qr.compute(terms.leftCols(count) * sizes.cwiseInverse().asDiagonal());
      if (qr.rank() < count)
      {
        continue;
      }
      splat.RankDeficient = splat.RankDeficient && lower < order;
      if (this->ExtrapolationLimit > 0.0 && lower > 1 &&
        GetAmplification(qr, sizes, lower, this->LimitedShare) > this->ExtrapolationLimit)
      {
        splat.RankDeficient = false;
        splat.Extrapolates = true;
        continue;
      }
      const Eigen::VectorXd solution = qr.solve(heights).cwiseQuotient(sizes);
      const double squares = (terms.leftCols(count) * solution - heights).squaredNorm();
      splat.Order = lower;
      splat.Coefficients.fill(0.0);
      std::copy_n(solution.data(), count, splat.Coefficients.begin());
      splat.Residual = splat.Radius * std::sqrt(squares / weights);
      break;
    }
    if (splat.Order < order || splat.Residual <= this->Tolerance)
    {
      return;
    }
  }
}
