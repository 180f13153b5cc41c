// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkJointSurface
 * @brief   the clouds of several mappers that are reconstructed as one
 *
 * Mappers add what they would draw (Begin() to End()); the first of them reconstructs all; then
 * each shades the pixels whose ids are of its own points, within the rectangle where these may be;
 * of clouds that follow each other and look alike the first one shades those of all. Clouds that do
 * not fit are drawn by themselves: those of another class of mapper, another back end,
 * supersampling, eye or clipping planes. The widest rim around the viewport that one of them needs
 * is that of all.
 */
#ifndef vtkJointSurface_h
#define vtkJointSurface_h

#include "vtkPointSurfaceView.h"
#include "vtkType.h"

#include <array>
#include <memory>
#include <vector>

class vtkActor;
class vtkPointSurfaceMapper;
struct vtkSurfaceBuffer;

/// A cloud, as its mapper would draw it.
struct vtkJointSurfaceMember
{
  vtkPointSurfaceMapper* Mapper = nullptr;
  vtkActor* Actor = nullptr;
  vtkPointSurfaceView View;
  bool HasColors = false;
  bool HasDuplicates = false;   ///< see vtkDuplicatePoints
  std::array<float, 4> Color{}; ///< of a cloud without colours, where it borders on others
  vtkIdType NumberOfPoints = 0;
  vtkIdType FirstId = 0; ///< of its points among those of all members
  /// Ids, from the first on, whose pixels this member shades; none where an earlier one does it.
  vtkIdType ShadedIds = 0;
  std::array<int, 4> ShadedRectangle{}; ///< where they may be; x, y, width, height in the viewport

  /// The member's view, over the image, the rectangle and the depths of the joint one.
  vtkPointSurfaceView GetView(const vtkPointSurfaceView& joint) const
  {
    vtkPointSurfaceView view = this->View;
    view.Size = joint.Size;
    view.VCDC = joint.VCDC;
    view.Rim = joint.Rim;
    view.Rectangle = joint.Rectangle;
    view.DepthRange = joint.DepthRange;
    return view;
  }

  bool operator==(const vtkJointSurfaceMember& other) const
  {
    return this->Mapper == other.Mapper && this->View == other.View &&
      this->HasColors == other.HasColors && this->Color == other.Color &&
      this->FirstId == other.FirstId;
  }
};

class vtkJointSurface
{
public:
  using Member = vtkJointSurfaceMember;

  vtkJointSurface();
  ~vtkJointSurface();

  ///@{
  /**
   * From Begin() to End() mappers add what they would draw. End() returns whether the buffer has to
   * be made anew.
   */
  void Begin();
  bool IsCollecting() const { return this->Collecting; }
  void Add(Member member);
  bool End();
  ///@}

  const std::vector<Member>& GetMembers() const { return this->Members; }

  /**
   * The member that was added for a view, or nullptr if it is to be drawn by itself.
   */
  const Member* Find(vtkPointSurfaceMapper* mapper, const vtkPointSurfaceView& view) const;

  /**
   * The view of all members.
   */
  vtkPointSurfaceView GetView() const;

  const std::shared_ptr<vtkSurfaceBuffer>& GetBuffer() const { return this->Buffer; }

private:
  bool Fits(const Member& member) const;
  void AssignShading();
  void SetExtent(vtkPointSurfaceView& joint) const;

  bool Collecting = false;
  std::vector<Member> Members;
  std::vector<Member> LastMembers; // that the buffer is of
  std::shared_ptr<vtkSurfaceBuffer> Buffer;
};

#endif
