// SPDX-License-Identifier: BSD-3-Clause
#include "vtkJointSurface.h"

#include "vtkPointSurfaceMapper.h"
#include "vtkSurfaceBuffer.h"

#include "vtkActor.h"
#include "vtkMath.h"
#include "vtkProperty.h"
#include "vtkShaderProperty.h"
#include "vtkUniforms.h"

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

/// All numbers of a property that shading may depend on.
std::vector<double> GetMaterial(vtkProperty* p)
{
  std::vector<double> values = { p->GetLighting() ? 1.0 : 0.0, 1.0 * p->GetInterpolation(),
    p->GetAmbient(), p->GetDiffuse(), p->GetSpecular(), p->GetSpecularPower(), p->GetMetallic(),
    p->GetRoughness(), p->GetAnisotropy(), p->GetAnisotropyRotation(), p->GetBaseIOR(),
    p->GetCoatIOR(), p->GetCoatStrength(), p->GetCoatRoughness(), p->GetCoatNormalScale(),
    p->GetNormalScale(), p->GetOcclusionStrength() };
  for (const double* color : { p->GetAmbientColor(), p->GetDiffuseColor(), p->GetSpecularColor(),
         p->GetCoatColor(), p->GetEdgeTint(), p->GetEmissiveFactor() })
  {
    values.insert(values.end(), color, color + 3);
  }
  return values;
}

/// Whether an actor has nothing but its property's numbers that a shader could depend on.
bool IsPlain(vtkActor* actor)
{
  vtkShaderProperty* shader = actor->GetShaderProperty();
  return actor->GetProperty()->GetOpacity() >= 1.0 && !actor->GetBackfaceProperty() &&
    !actor->GetTexture() && actor->GetProperty()->GetAllTextures().empty() &&
    !actor->GetPropertyKeys() && shader->GetNumberOfShaderReplacements() == 0 &&
    !shader->HasFragmentShaderCode() &&
    shader->GetFragmentCustomUniforms()->GetNumberOfUniforms() == 0;
}

bool LookAlike(const vtkJointSurface::Member& a, const vtkJointSurface::Member& b)
{
  return a.HasColors == b.HasColors && !a.HasDuplicates && !b.HasDuplicates && IsPlain(a.Actor) &&
    IsPlain(b.Actor) && GetMaterial(a.Actor->GetProperty()) == GetMaterial(b.Actor->GetProperty());
}

std::array<int, 4> Unite(const std::array<int, 4>& a, const std::array<int, 4>& b)
{
  std::array<int, 4> both;
  for (int k = 0; k < 2; ++k)
  {
    both[k] = std::min(a[k], b[k]);
    both[2 + k] = std::max(a[k] + a[2 + k], b[k] + b[2 + k]) - both[k];
  }
  return both;
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
  if (this->Members.size() > 1)
  {
    this->AssignShading();
  }
  return this->Members.size() > 1 && !(this->Buffer->Valid && this->Members == this->LastMembers);
}

void vtkJointSurface::AssignShading()
{
  // A point fills gaps up to a few of the largest discs away.
  constexpr double Reach = 4.0;
  const vtkPointSurfaceView joint = this->GetView();
  Member* first = nullptr;
  for (Member& member : this->Members)
  {
    vtkPointSurfaceView view = member.GetView(joint);
    const int shift = joint.Supersampling * (joint.Rim - member.View.Rim);
    for (int k = 0; k < 2; ++k)
    {
      const double margin = std::ceil(Reach * joint.LargestDisc[k]);
      const double begin = member.View.Rectangle[k] + shift - margin;
      const double end = member.View.Rectangle[k] + member.View.Rectangle[2 + k] + shift + margin;
      view.Rectangle[k] = static_cast<int>(std::max(begin, 0.0));
      view.Rectangle[2 + k] =
        static_cast<int>(std::min<double>(end, joint.Size[k])) - view.Rectangle[k];
    }
    const std::array<int, 4> rectangle = view.GetViewportRectangle();
    if (first && LookAlike(*first, member))
    {
      first->ShadedIds += member.NumberOfPoints;
      first->ShadedRectangle = Unite(first->ShadedRectangle, rectangle);
      continue;
    }
    first = &member;
    member.ShadedIds = member.NumberOfPoints;
    member.ShadedRectangle = rectangle;
  }
}

const vtkJointSurface::Member* vtkJointSurface::Find(
  vtkPointSurfaceMapper* mapper, const vtkPointSurfaceView& view) const
{
  const auto member = std::find_if(this->Members.begin(), this->Members.end(),
    [&](const Member& m) { return m.Mapper == mapper && m.View == view; });
  return this->Members.size() > 1 && member != this->Members.end() ? &*member : nullptr;
}

/// The widest that two of the spheres around the clouds' boxes are together.
void vtkJointSurface::SetExtent(vtkPointSurfaceView& joint) const
{
  for (const Member& a : this->Members)
  {
    for (const Member& b : this->Members)
    {
      double between[3];
      vtkMath::Subtract(b.View.Center.data(), a.View.Center.data(), between);
      const double distance = vtkMath::Norm(between);
      const double diagonal = distance + 0.5 * (a.View.Diagonal + b.View.Diagonal);
      if (diagonal > joint.Diagonal)
      {
        joint.Diagonal = diagonal;
        for (int k = 0; k < 3; ++k)
        {
          joint.Center[k] = 0.5 * (a.View.Center[k] + b.View.Center[k]);
        }
      }
    }
  }
}

vtkPointSurfaceView vtkJointSurface::GetView() const
{
  const auto widest = std::max_element(this->Members.begin(), this->Members.end(),
    [](const Member& a, const Member& b) { return a.View.Rim < b.View.Rim; });
  vtkPointSurfaceView joint = this->Members.front().View;
  joint.Size = widest->View.Size;
  joint.VCDC = widest->View.VCDC;
  joint.Rim = widest->View.Rim;
  joint.Ranges.clear(); // to be counted: of each cloud's own places
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
    for (int k = 0; k < 2; ++k)
    {
      joint.LargestDisc[k] = std::max(joint.LargestDisc[k], view.LargestDisc[k]);
    }
    joint.Ranges.insert(joint.Ranges.end(), view.Ranges.begin(), view.Ranges.end());
    const auto count = static_cast<double>(view.GetNumberOfPoints());
    points += count;
    radii += count * view.MeanRadius;
    typicalRadii += count * view.TypicalRadius;
  }
  joint.Rectangle = { begin[0], begin[1], end[0] - begin[0], end[1] - begin[1] };
  this->SetExtent(joint);
  joint.MeanRadius = radii / points;
  joint.TypicalRadius = typicalRadii / points;
  return joint;
}
