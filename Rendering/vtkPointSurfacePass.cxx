// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPointSurfacePass.h"

#include "vtkJointSurface.h"
#include "vtkPointSurfaceMapper.h"
#include "vtkSurfaceBuffer.h"

#include "vtkActor.h"
#include "vtkHardwareSelector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOpaquePass.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <utility>
#include <vector>

class vtkPointSurfacePass::vtkInternals
{
public:
  vtkJointSurface Joint;
  vtkNew<vtkOpaquePass> Opaque;
};

vtkStandardNewMacro(vtkPointSurfacePass);

vtkPointSurfacePass::vtkPointSurfacePass()
  : Internals(new vtkInternals)
{
}

vtkPointSurfacePass::~vtkPointSurfacePass() = default;

void vtkPointSurfacePass::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Superclass::ReleaseGraphicsResources(window);
  this->Internals->Opaque->ReleaseGraphicsResources(window);
  vtkSurfaceBuffer& buffer = *this->Internals->Joint.GetBuffer();
  buffer.Target.ReleaseGraphicsResources(window);
  buffer.Lesser.ReleaseGraphicsResources(window);
  buffer.Valid = false;
}

void vtkPointSurfacePass::Render(const vtkRenderState* state)
{
  if (vtkHardwareSelector* selector = state->GetRenderer()->GetSelector())
  {
    // as a renderer without passes does it; the clouds are then drawn by themselves
    this->NumberOfRenderedProps =
      selector->Render(state->GetRenderer(), state->GetPropArray(), state->GetPropArrayCount());
    return;
  }
  std::vector<std::pair<vtkActor*, vtkPointSurfaceMapper*>> clouds;
  for (int i = 0; i < state->GetPropArrayCount(); ++i)
  {
    auto* actor = vtkActor::SafeDownCast(state->GetPropArray()[i]);
    auto* mapper = actor ? vtkPointSurfaceMapper::SafeDownCast(actor->GetMapper()) : nullptr;
    if (mapper && actor->HasOpaqueGeometry())
    {
      clouds.emplace_back(actor, mapper);
    }
  }

  vtkJointSurface& joint = this->Internals->Joint;
  joint.Begin();
  for (const auto& cloud : clouds)
  {
    cloud.second->SetJointSurface(&joint);
    cloud.first->RenderOpaqueGeometry(state->GetRenderer());
  }
  if (joint.End())
  {
    joint.GetMembers().front().Mapper->MakeJointSurface(joint);
  }
  const auto members = static_cast<int>(joint.GetMembers().size());
  this->LastFrameJointClouds = members > 1 ? members : 0;
  this->LastFrameShadings = this->LastFrameJointClouds == 0
    ? 0
    : static_cast<int>(std::count_if(joint.GetMembers().begin(), joint.GetMembers().end(),
        [](const vtkJointSurface::Member& member) { return member.ShadedIds > 0; }));

  this->Internals->Opaque->Render(state);
  this->NumberOfRenderedProps = this->Internals->Opaque->GetNumberOfRenderedProps();
  for (const auto& cloud : clouds)
  {
    cloud.second->SetJointSurface(nullptr);
  }
}

void vtkPointSurfacePass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "LastFrameJointClouds: " << this->LastFrameJointClouds << "\n";
  os << indent << "LastFrameShadings: " << this->LastFrameShadings << "\n";
}
