// SPDX-License-Identifier: BSD-3-Clause
#include "vtkJointSurface.h"

#include "vtkPointSurfaceMapper.h"
#include "vtkSurfaceBuffer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace
{
/// Whether two views are of the same viewport, each with the rim that its cloud needs.
bool ShareViewport(const vtkPointSurfaceView& a, const vtkPointSurfaceView& b)
{
  bool same = a.Supersampling == b.Supersampling;
  for (int k = 0; k < 2; ++k)
  {
    same = same && a.Size[k] - b.Size[k] == 2 * a.Supersampling * (a.Rim - b.Rim);
    for (int row = 0; row < 4; ++row)
    {
      // in samples, so that they differ by rounding alone
      const double difference = a.Size[k] * a.VCDC[4 * row + k] - b.Size[k] * b.VCDC[4 * row + k];
      same = same && std::abs(difference) <= 1e-12 * std::abs(a.Size[k] * a.VCDC[4 * row + k]);
      same = same && a.VCDC[4 * row + 2 + k] == b.VCDC[4 * row + 2 + k];
    }
  }
  return same;
}
}

vtkJointSurface::vtkJointSurface()
  : Buffer(new vtkSurfaceBuffer)
{
}

vtkJointSurface::~vtkJointSurface() = default;

void vtkJointSurface::Begin()
{
  this->Collecting = true;
  this->LastMembers.swap(this->Members);
  this->Members.clear();
}

void vtkJointSurface::Add(Member member)
{
  if (!this->Members.empty())
  {
    const Member& last = this->Members.back();
    member.FirstId = last.FirstId + last.NumberOfPoints;
  }
  if (this->Fits(member))
  {
    this->Members.push_back(member);
  }
}

bool vtkJointSurface::Fits(const Member& member) const
{
  // an id and one more has to fit in an int of the shaders
  if (member.FirstId + member.NumberOfPoints >= std::numeric_limits<int>::max())
  {
    return false;
  }
  if (this->Members.empty())
  {
    return true;
  }
  const Member& first = this->Members.front();
  const vtkPointSurfaceView& a = first.View;
  const vtkPointSurfaceView& b = member.View;
  return std::strcmp(first.Mapper->GetClassName(), member.Mapper->GetClassName()) == 0 &&
    first.Mapper->GetLastFrameBackend() == member.Mapper->GetLastFrameBackend() &&
    ShareViewport(a, b) && a.NumberOfClippingPlanes == b.NumberOfClippingPlanes &&
    a.ClippingPlanes == b.ClippingPlanes;
}

bool vtkJointSurface::End()
{
  this->Collecting = false;
  return this->Members.size() > 1 && !(this->Buffer->Valid && this->Members == this->LastMembers);
}

const vtkJointSurface::Member* vtkJointSurface::Find(
  vtkPointSurfaceMapper* mapper, const vtkPointSurfaceView& view) const
{
  const auto member = std::find_if(this->Members.begin(), this->Members.end(),
    [&](const Member& m) { return m.Mapper == mapper && m.View == view; });
  return this->Members.size() > 1 && member != this->Members.end() ? &*member : nullptr;
}

vtkPointSurfaceView vtkJointSurface::GetView() const
{
  const auto widest = std::max_element(this->Members.begin(), this->Members.end(),
    [](const Member& a, const Member& b) { return a.View.Rim < b.View.Rim; });
  vtkPointSurfaceView joint = this->Members.front().View;
  joint.Size = widest->View.Size;
  joint.VCDC = widest->View.VCDC;
  joint.Rim = widest->View.Rim;
  int begin[2] = { joint.Size[0], joint.Size[1] };
  int end[2] = { 0, 0 };
  double points = 0.0;
  double radii = 0.0;
  double typicalRadii = 0.0;
  for (const Member& member : this->Members)
  {
    const vtkPointSurfaceView& view = member.View;
    const int shift = joint.Supersampling * (joint.Rim - view.Rim);
    for (int k = 0; k < 2; ++k)
    {
      begin[k] = std::min(begin[k], view.Rectangle[k] + shift);
      end[k] = std::max(end[k], view.Rectangle[k] + view.Rectangle[2 + k] + shift);
    }
    joint.DepthRange = { std::min(joint.DepthRange[0], view.DepthRange[0]),
      std::max(joint.DepthRange[1], view.DepthRange[1]) };
    joint.LargestRadius = std::max(joint.LargestRadius, view.LargestRadius);
    const auto count = static_cast<double>(view.GetNumberOfPoints());
    points += count;
    radii += count * view.MeanRadius;
    typicalRadii += count * view.TypicalRadius;
  }
  joint.Rectangle = { begin[0], begin[1], end[0] - begin[0], end[1] - begin[1] };
  joint.MeanRadius = radii / points;
  joint.TypicalRadius = typicalRadii / points;
  return joint;
}
