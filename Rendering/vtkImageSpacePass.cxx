// SPDX-License-Identifier: BSD-3-Clause
#include "vtkImageSpacePass.h"

#include "vtkContextNeeds.h"
#include "vtkDepthStep.h"
#include "vtkEyeFrame.h"
#include "vtkImageSpaceDepth.h"
#include "vtkImageSpaceReadFS.h"
#include "vtkImageSpaceWriteFS.h"
#include "vtkPointSurfaceCompat.h"
#include "vtkScreenPass.h"
#include "vtkSurfaceTarget.h"

#include "vtkInformation.h"
#include "vtkInformationObjectBaseVectorKey.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkOpenGLCamera.h"
#include "vtkOpenGLFXAAFilter.h"
#include "vtkOpenGLFXAAPass.h"
#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLRenderTimer.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLRenderer.h"
#include "vtkOpenGLState.h"
#include "vtkPolyDataMapper.h"
#include "vtkProp.h"
#include "vtkRenderState.h"
#include "vtkRenderer.h"
#include "vtkSSAOPass.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"
#include "vtkWeakPointer.h"

#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace
{
/// What is drawn to takes, besides colour and depth.
enum Outputs
{
  ColorAlone,
  WithNormal,           // another pass of this kind
  WithPositionAndNormal // vtkSSAOPass
};

std::string GetWriteShader(int outputs)
{
  return "//VTK::System::Dec\n//VTK::Output::Dec\n#define OUTPUTS " + std::to_string(outputs) +
    "\n" + vtkImageSpaceDepth + vtkImageSpaceWriteFS;
}

/// The innermost of the passes that draw a prop.
vtkObjectBase* GetInnermostPass(vtkProp* prop)
{
  vtkInformation* keys = prop ? prop->GetPropertyKeys() : nullptr;
  const int count = keys && keys->Has(vtkOpenGLRenderPass::RenderPasses())
    ? keys->Length(vtkOpenGLRenderPass::RenderPasses())
    : 0;
  return count > 0 ? keys->Get(vtkOpenGLRenderPass::RenderPasses(), count - 1) : nullptr;
}

/// Keeps vtkSSAOPass from the shaders of what is drawn here and not for it, while it lives.
class WithoutSSAO
{
public:
  explicit WithoutSSAO(const vtkRenderState* s)
  {
    for (int i = 0; i < s->GetPropArrayCount(); ++i)
    {
      vtkInformation* keys = s->GetPropArray()[i]->GetPropertyKeys();
      this->Set(keys, this->GetOthers(keys));
    }
  }

  ~WithoutSSAO()
  {
    for (auto& saved : this->Saved)
    {
      this->Set(saved.first, saved.second);
    }
  }

private:
  using PassList = std::vector<vtkObjectBase*>;

  PassList GetOthers(vtkInformation* keys)
  {
    PassList all;
    PassList others;
    for (int i = 0; i < vtkOpenGLRenderPass::RenderPasses()->Length(keys); ++i)
    {
      all.push_back(keys->Get(vtkOpenGLRenderPass::RenderPasses(), i));
      if (!vtkSSAOPass::SafeDownCast(all.back()))
      {
        others.push_back(all.back());
      }
    }
    this->Saved.emplace_back(keys, all);
    return others;
  }

  static void Set(vtkInformation* keys, const PassList& passes)
  {
    keys->Remove(vtkOpenGLRenderPass::RenderPasses());
    for (vtkObjectBase* pass : passes) // they are held by those who render
    {
      keys->Append(vtkOpenGLRenderPass::RenderPasses(), pass);
    }
  }

  std::vector<std::pair<vtkInformation*, PassList>> Saved;
};

/// Keeps the renderer from doing FXAA within a delegate, where it would draw over the normals,
/// while it lives. The renderer is not marked as modified, as its setter would have it: what
/// depends on its time is not to be made again in each frame.
class WithoutFXAA
{
public:
  explicit WithoutFXAA(vtkRenderer* renderer)
    : Flag(renderer->*Access::Member)
    , Usual(this->Flag)
  {
    this->Flag = false;
  }
  ~WithoutFXAA() { this->Flag = this->Usual; }

private:
  struct Access : vtkRenderer // as the flag is protected
  {
    static constexpr bool vtkRenderer::*Member = &Access::UseFXAA;
  };

  bool& Flag;
  const bool Usual;
};

/// What the pass that encloses one that is about to start takes from it.
Outputs GetEnclosingOutputs(const vtkRenderState* s)
{
  vtkObjectBase* pass =
    s->GetPropArrayCount() > 0 ? GetInnermostPass(s->GetPropArray()[0]) : nullptr;
  return vtkImageSpacePass::SafeDownCast(pass) ? WithNormal
    : vtkSSAOPass::SafeDownCast(pass)          ? WithPositionAndNormal
                                               : ColorAlone;
}

/// Makes the first attachments of the framebuffer in force those that are drawn to; see
/// vtkSurfaceTarget::BindForWriting for why VTK is not asked to.
void ActivateOutputs(int count)
{
  const GLenum buffers[3] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2 };
  glDrawBuffers(count, buffers);
}

/// SetShaderParameters() activates them for those who write them.
void ClearNormals()
{
  const GLfloat zero[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
  ActivateOutputs(2);
  glClearBufferfv(GL_COLOR, 1, zero);
  ActivateOutputs(1);
}

/// Lets what comes draw to the colours of vtkSSAOPass alone: a pass between it and this one, such
/// as vtkOpenGLFXAAPass, knows nothing of positions and normals and would draw over them. By VTK's
/// state, so that it knows when mappers ask for all of them; it lets nobody take buffers away but
/// one by one.
void KeepPositionsAndNormals(vtkOpenGLState* state)
{
  unsigned int none[3] = { GL_NONE, GL_NONE, GL_NONE };
  unsigned int color[1] = { GL_COLOR_ATTACHMENT0 };
  state->vtkglDrawBuffers(3, none);
  state->vtkglDrawBuffers(1, color);
}

/// Whether a delegate leaves no normals: vtkOpenGLFXAAPass draws over those of the mappers within
/// it. Those of a pass of this kind are out of its reach, see ActivateOutputs(1).
bool DrawsOverNormals(vtkRenderPass* delegate)
{
  auto* fxaa = vtkOpenGLFXAAPass::SafeDownCast(delegate);
  return fxaa && !vtkImageSpacePass::SafeDownCast(fxaa->GetDelegatePass());
}
}

class vtkImageSpacePass::vtkInternals
{
public:
  // what the delegate draws
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  vtkNew<vtkTextureObject> Color;
  vtkNew<vtkTextureObject> Normal;
  vtkNew<vtkTextureObject> Depth;
  std::array<int, 2> Size{}; // of these

  vtkSurfaceTarget Images[2];
  vtkScreenPass Read{ std::string("//VTK::System::Dec\n") +
    vtkSurfaceTarget::GetOutputDeclarations(
      { vtkSurfaceTarget::Surface, vtkSurfaceTarget::Color }) +
    vtkImageSpaceDepth + vtkImageSpaceReadFS };
  vtkScreenPass Write[3] = { vtkScreenPass(GetWriteShader(0)), vtkScreenPass(GetWriteShader(1)),
    vtkScreenPass(GetWriteShader(2)) };
  vtkNew<vtkOpenGLFXAAFilter> FXAA;
  vtkOpenGLRenderTimer Timer;
  vtkWeakPointer<vtkOpenGLRenderWindow> Window; // of the last frame; cleared when it releases us
  vtkMTimeType ContextTime = 0;                 // of the context that the next is of
  std::string Lack;                             // without which nothing can be filtered

  std::array<int, 4> Rectangle{};
  vtkNew<vtkMatrix4x4> VCDC; // from the eye to clip coordinates; see vtkEyeFrame
  vtkNew<vtkMatrix4x4> EyeToView;

  void SetCamera(vtkRenderer* renderer);
  void SetCameraUniforms(vtkShaderProgram* program);
  void Allocate(vtkOpenGLRenderWindow* window, int width, int height);
  bool IsBound() const;
};

void vtkImageSpacePass::vtkInternals::Allocate(vtkOpenGLRenderWindow* window, int width, int height)
{
  const std::vector<vtkSurfaceTarget::Layer> layers = { vtkSurfaceTarget::Surface,
    vtkSurfaceTarget::Color };
  for (vtkSurfaceTarget& image : this->Images)
  {
    image.Allocate(window, width, height, layers);
  }
  if (this->Size == std::array<int, 2>{ width, height })
  {
    return;
  }
  this->Size = { width, height };
  this->Framebuffer->SetContext(window);
  for (vtkTextureObject* texture : { this->Color.Get(), this->Normal.Get() })
  {
    texture->SetContext(window);
    texture->SetMinificationFilter(vtkTextureObject::Nearest);
    texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    texture->Allocate2D(width, height, 4, VTK_FLOAT);
  }
  this->Depth->SetContext(window);
  this->Depth->AllocateDepth(width, height, vtkTextureObject::Float32);
  vtkOpenGLState* state = window->GetState();
  state->PushFramebufferBindings();
  this->Framebuffer->Bind();
  this->Framebuffer->AddColorAttachment(0, this->Color);
  this->Framebuffer->AddColorAttachment(1, this->Normal);
  this->Framebuffer->AddDepthAttachment(this->Depth);
  state->PopFramebufferBindings();
}

void vtkImageSpacePass::vtkInternals::SetCamera(vtkRenderer* renderer)
{
  vtkMatrix4x4 *wcvc, *vcdc, *wcdc;
  vtkMatrix3x3* normals;
  static_cast<vtkOpenGLCamera*>(renderer->GetActiveCamera())
    ->GetKeyMatrices(renderer, wcvc, normals, vcdc, wcdc);
  vtkNew<vtkMatrix4x4> viewToEye;
  vtkEyeFrame::FromCamera(wcvc, vcdc, viewToEye);
  auto setMatrices = [&]
  {
    vtkMatrix4x4::Invert(viewToEye, this->EyeToView);
    vtkMatrix4x4::Multiply4x4(this->EyeToView, vcdc, this->VCDC);
  };
  setMatrices();
  const double* m = this->VCDC->GetData();
  const double nearest = (m[14] + m[15]) / (m[10] + m[11]);
  const double farthest = (m[14] - m[15]) / (m[10] - m[11]);
  if (m[11] == 0.0 && nearest <= 0.0)
  {
    // a parallel view from within what is seen: all of it is to be in front of the eye
    viewToEye->SetElement(3, 2, viewToEye->GetElement(3, 2) + 2.0 * nearest - farthest);
    setMatrices();
  }
}

void vtkImageSpacePass::vtkInternals::SetCameraUniforms(vtkShaderProgram* program)
{
  program->SetUniformMatrix("VCDC", this->VCDC);
  program->SetUniformMatrix("eyeToView", this->EyeToView);
}

bool vtkImageSpacePass::vtkInternals::IsBound() const
{
  GLint bound = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &bound);
  return static_cast<unsigned int>(bound) == this->Framebuffer->GetFBOIndex();
}

//------------------------------------------------------------------------------
vtkImageSpacePass::vtkImageSpacePass()
  : Internals(new vtkInternals)
{
}

vtkImageSpacePass::~vtkImageSpacePass() = default;

void vtkImageSpacePass::ReleaseGraphicsResources(vtkWindow* w)
{
  this->Superclass::ReleaseGraphicsResources(w);
  vtkInternals& internals = *this->Internals;
  internals.Framebuffer->ReleaseGraphicsResources(w);
  for (vtkTextureObject* texture :
    { internals.Color.Get(), internals.Normal.Get(), internals.Depth.Get() })
  {
    texture->ReleaseGraphicsResources(w);
  }
  for (vtkSurfaceTarget& image : internals.Images)
  {
    image.ReleaseGraphicsResources(w);
  }
  internals.Read.ReleaseGraphicsResources();
  for (vtkScreenPass& pass : internals.Write)
  {
    pass.ReleaseGraphicsResources();
  }
  internals.FXAA->ReleaseGraphicsResources();
  internals.Timer.ReleaseGraphicsResources();
  internals.Size = {};
  internals.Window = nullptr;
}

//------------------------------------------------------------------------------
void vtkImageSpacePass::Render(const vtkRenderState* s)
{
  this->NumberOfRenderedProps = 0;
  if (!this->DelegatePass)
  {
    vtkWarningMacro("There is nothing to filter: set the delegate pass (SetDelegatePass).");
    return;
  }
  vtkInternals& internals = *this->Internals;
  vtkRenderer* renderer = s->GetRenderer();
  auto* window = static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow());
  if (internals.Window && internals.Window != window)
  {
    internals.Window->MakeCurrent();
    this->ReleaseGraphicsResources(internals.Window);
    window->MakeCurrent();
  }
  internals.Window = window;
  this->ExamineContext(window);
  if (!internals.Lack.empty())
  {
    this->DelegatePass->Render(s);
    this->NumberOfRenderedProps += this->DelegatePass->GetNumberOfRenderedProps();
    return;
  }
  int size[2];
  int origin[2] = { 0, 0 };
  if (s->GetFrameBuffer())
  {
    s->GetFrameBuffer()->GetLastSize(size);
  }
  else
  {
    renderer->GetTiledSizeAndOrigin(&size[0], &size[1], &origin[0], &origin[1]);
  }
  if (size[0] <= 0 || size[1] <= 0)
  {
    return;
  }
  internals.Rectangle = { 0, 0, size[0], size[1] };
  internals.Allocate(window, size[0], size[1]);

  vtkOpenGLState* state = window->GetState();
  vtkOpenGLState::ScopedglViewport viewport(state);
  vtkOpenGLState::ScopedglScissor scissor(state);
  vtkOpenGLState::ScopedglDepthMask depthMask(state);
  vtkOpenGLState::ScopedglDepthFunc depthFunc(state);
  vtkOpenGLState::ScopedglColorMask colorMask(state);
  vtkOpenGLState::ScopedglEnableDisable scissorTest(state, GL_SCISSOR_TEST);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable multisample(state, GL_MULTISAMPLE);
  vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);

  const Outputs outputs = GetEnclosingOutputs(s);
  {
    const WithoutFXAA withoutFXAA(renderer);
    this->DrawDelegate(s, window, origin);
  }

  internals.SetCamera(renderer);

  state->vtkglDisable(GL_BLEND);
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_MULTISAMPLE);
  state->vtkglDisable(GL_CULL_FACE);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  vtkSurfaceTarget* image = &internals.Images[0];
  vtkSurfaceTarget* spare = &internals.Images[1];
  state->PushFramebufferBindings();
  this->ReadImage(window, *image);
  internals.Timer.Reset();
  internals.Timer.Start();
  this->Filter(window, image, spare);
  internals.Timer.Stop();
  state->PopFramebufferBindings();

  state->vtkglEnable(GL_DEPTH_TEST);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglDepthFunc(GL_ALWAYS);
  state->vtkglViewport(origin[0], origin[1], size[0], size[1]);
  if (outputs != ColorAlone)
  {
    ActivateOutputs(outputs == WithNormal ? 2 : 3);
  }
  this->WriteImage(window, outputs, origin, *image);
  if (outputs == WithNormal)
  {
    ActivateOutputs(1); // see DrawDelegate()
  }
  if (outputs == WithPositionAndNormal)
  {
    KeepPositionsAndNormals(state);
  }
  if (renderer->GetUseFXAA() && !s->GetFrameBuffer()) // that of another pass has another size
  {
    if (vtkFXAAOptions* options = renderer->GetFXAAOptions()) // none: the filter's own, as in VTK
    {
      internals.FXAA->UpdateConfiguration(options);
    }
    internals.FXAA->Execute(static_cast<vtkOpenGLRenderer*>(renderer));
  }
}

void vtkImageSpacePass::ExamineContext(vtkOpenGLRenderWindow* window)
{
  vtkInternals& internals = *this->Internals;
  if (internals.ContextTime == window->GetContextCreationTime())
  {
    return; // times are unique
  }
  internals.ContextTime = window->GetContextCreationTime();
  internals.Lack = vtkContextNeeds::FindLackOfTargets();
  if (!internals.Lack.empty())
  {
    vtkErrorMacro("This OpenGL context "
      << internals.Lack << ", which this pass needs; what it was to filter is drawn as it is. "
      << "Update the graphics driver, or let Mesa's software renderer draw (the environment "
         "variable LIBGL_ALWAYS_SOFTWARE=1).");
  }
}

void vtkImageSpacePass::DrawDelegate(
  const vtkRenderState* s, vtkOpenGLRenderWindow* window, const int origin[2])
{
  vtkInternals& internals = *this->Internals;
  vtkOpenGLState* state = window->GetState();
  const int width = internals.Rectangle[2];
  const int height = internals.Rectangle[3];
  GLint target = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &target);
  this->PreRender(s);
  state->PushFramebufferBindings();
  internals.Framebuffer->Bind();
  internals.Framebuffer->ActivateDrawBuffers(2);
  internals.Framebuffer->StartNonOrtho(width, height);
  ActivateOutputs(1);

  // the background, where it has been drawn already; state's idea of the bindings holds after it
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDepthMask(GL_TRUE);
  state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(target));
  glBlitFramebuffer(origin[0], origin[1], origin[0] + width, origin[1] + height, 0, 0, width,
    height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, internals.Framebuffer->GetFBOIndex());
  const GLfloat farthest = 1.0f;
  glClearBufferfv(GL_DEPTH, 0, &farthest);
  ClearNormals();

  state->vtkglViewport(0, 0, width, height);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(0, 0, width, height);
  state->vtkglEnable(GL_DEPTH_TEST);
  vtkRenderState inner(s->GetRenderer());
  inner.SetPropArrayAndCount(s->GetPropArray(), s->GetPropArrayCount());
  inner.SetRequiredKeys(s->GetRequiredKeys());
  inner.SetFrameBuffer(internals.Framebuffer);
  {
    const WithoutSSAO withoutSSAO(s);
    this->DelegatePass->Render(&inner);
  }
  if (DrawsOverNormals(this->DelegatePass))
  {
    ClearNormals();
  }
  this->NumberOfRenderedProps += this->DelegatePass->GetNumberOfRenderedProps();
  state->PopFramebufferBindings();
  this->PostRender(s);
}

void vtkImageSpacePass::ReadImage(vtkOpenGLRenderWindow* window, vtkSurfaceTarget& image)
{
  vtkInternals& internals = *this->Internals;
  vtkShaderProgram* program = internals.Read.Ready(window);
  if (!program)
  {
    return;
  }
  vtkTextureObject* const textures[] = { internals.Color, internals.Normal, internals.Depth };
  for (vtkTextureObject* texture : textures)
  {
    texture->Activate();
  }
  program->SetUniformi("colors", internals.Color->GetTextureUnit());
  program->SetUniformi("normals", internals.Normal->GetTextureUnit());
  program->SetUniformi("depths", internals.Depth->GetTextureUnit());
  internals.SetCameraUniforms(program);
  image.BindForWriting(window);
  internals.Read.Draw(window, 0, 0, internals.Rectangle[2], internals.Rectangle[3]);
  for (vtkTextureObject* texture : textures)
  {
    texture->Deactivate();
  }
}

void vtkImageSpacePass::WriteImage(
  vtkOpenGLRenderWindow* window, int outputs, const int origin[2], vtkSurfaceTarget& image)
{
  vtkInternals& internals = *this->Internals;
  vtkScreenPass& pass = internals.Write[outputs];
  vtkShaderProgram* program = pass.Ready(window);
  if (!program)
  {
    return;
  }
  image.Activate();
  image.SetSamplers(program, "in");
  internals.Depth->Activate();
  program->SetUniformi("depths", internals.Depth->GetTextureUnit());
  internals.SetCameraUniforms(program);
  program->SetUniform2i("origin", origin);
  pass.Draw(window, origin[0], origin[1], internals.Rectangle[2], internals.Rectangle[3]);
  internals.Depth->Deactivate();
  image.Deactivate();
}

//------------------------------------------------------------------------------
bool vtkImageSpacePass::PreReplaceShaderValues(
  std::string&, std::string&, std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop)
{
  if (vtkPolyDataMapper::SafeDownCast(mapper) && GetInnermostPass(prop) == this)
  {
    vtkShaderProgram::Substitute(fragmentShader, "//VTK::Light::Impl",
      "//VTK::Light::Impl\n  //PointSurface::Normal\n", false);
  }
  return true;
}

bool vtkImageSpacePass::PostReplaceShaderValues(
  std::string&, std::string&, std::string& fragmentShader, vtkAbstractMapper* mapper, vtkProp* prop)
{
  if (vtkPolyDataMapper::SafeDownCast(mapper) && GetInnermostPass(prop) == this)
  {
    const bool hasNormals = fragmentShader.find("normalVCVSOutput") != std::string::npos;
    vtkShaderProgram::Substitute(fragmentShader, "//PointSurface::Normal",
      hasNormals ? "gl_FragData[1] = vec4(normalVCVSOutput, 1.0);" : "gl_FragData[1] = vec4(0.0);",
      false);
  }
  return true;
}

bool vtkImageSpacePass::SetShaderParameters(
  vtkShaderProgram*, vtkAbstractMapper* mapper, vtkProp* prop, vtkOpenGLVertexArrayObject*)
{
  if (GetInnermostPass(prop) == this && this->Internals->IsBound())
  {
    ActivateOutputs(vtkPolyDataMapper::SafeDownCast(mapper) ? 2 : 1);
  }
  return true;
}

//------------------------------------------------------------------------------
vtkDepthStep vtkImageSpacePass::GetDepthStep(double distance) const
{
  vtkDepthStep step;
  if (distance > 0.0)
  {
    step.Constant = static_cast<float>(distance);
    return step;
  }
  constexpr double Pixels = 10.0;
  const double* m = this->Internals->VCDC->GetData();
  const double pixel = 2.0 / (this->Internals->Rectangle[3] * m[5]);
  step.PerDepth = static_cast<float>(-Pixels * pixel * m[11]);
  step.Constant = static_cast<float>(Pixels * pixel * m[15]);
  return step;
}

const std::array<int, 4>& vtkImageSpacePass::GetRectangle() const
{
  return this->Internals->Rectangle;
}

double vtkImageSpacePass::GetLastFrameMilliseconds()
{
  vtkInternals& internals = *this->Internals;
  if (!internals.Window || !internals.Timer.Stopped())
  {
    return 0.0;
  }
  internals.Window->MakeCurrent();
  glFinish();
  while (!internals.Timer.Ready())
  {
    std::this_thread::yield();
  }
  return internals.Timer.GetElapsedNanoseconds() * 1e-6;
}

void vtkImageSpacePass::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
