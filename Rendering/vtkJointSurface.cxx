// SPDX-License-Identifier: BSD-3-Clause
#include "vtkJointSurface.h"

#include "vtkPointSurfaceMapper.h"
#include "vtkSurfaceBuffer.h"

#include <algorithm>
#include <cstring>
#include <limits>

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
    a.VCDC == b.VCDC && a.Size == b.Size && a.Rim == b.Rim && a.Supersampling == b.Supersampling &&
    a.NumberOfClippingPlanes == b.NumberOfClippingPlanes && a.ClippingPlanes == b.ClippingPlanes;
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
  vtkPointSurfaceView joint = this->Members.front().View;
  double points = 0.0;
  double radii = 0.0;
  double typicalRadii = 0.0;
  for (const Member& member : this->Members)
  {
    const vtkPointSurfaceView& view = member.View;
    for (int k = 0; k < 2; ++k)
    {
      const int end = std::max(
        joint.Rectangle[k] + joint.Rectangle[2 + k], view.Rectangle[k] + view.Rectangle[2 + k]);
      joint.Rectangle[k] = std::min(joint.Rectangle[k], view.Rectangle[k]);
      joint.Rectangle[2 + k] = end - joint.Rectangle[k];
    }
    joint.DepthRange = { std::min(joint.DepthRange[0], view.DepthRange[0]),
      std::max(joint.DepthRange[1], view.DepthRange[1]) };
    joint.LargestRadius = std::max(joint.LargestRadius, view.LargestRadius);
    const auto count = static_cast<double>(view.GetNumberOfPoints());
    points += count;
    radii += count * view.MeanRadius;
    typicalRadii += count * view.TypicalRadius;
  }
  joint.MeanRadius = radii / points;
  joint.TypicalRadius = typicalRadii / points;
  return joint;
}
