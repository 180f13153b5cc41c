// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkEyeFrame
 * @brief   the eye's own coordinate system, in which every camera of VTK's is a plain one
 *
 * VTK's view coordinates are not always those of an eye: an off-axis projection has its screen and
 * its eye anywhere in them, a stereo pair has its two eyes beside their origin, a user's transform
 * turns the picture, and in parallel projection what is seen may lie behind the origin. The steps
 * of this module want an eye at the origin that looks along -z, rows of the picture along x, and
 * what is seen in front of it. This is the motion from view coordinates there; for most cameras it
 * is none. Eye coordinates have the lengths and angles of the world's: where a user's transform of
 * the view shears or scales it, that is undone here and left to the projection.
 *
 * What is left in the projection beside its diagonal is an oblique direction of view and, where a
 * user's transform shears the picture, x depending on y.
 */
#ifndef vtkEyeFrame_h
#define vtkEyeFrame_h

class vtkMatrix4x4;

namespace vtkEyeFrame
{
/**
 * Sets `viewToEye` from the camera's matrices from world to view and from view to clip coordinates.
 * All have row vectors, as VTK's key matrices.
 */
void FromCamera(vtkMatrix4x4* worldToView, vtkMatrix4x4* viewToClip, vtkMatrix4x4* viewToEye);

/**
 * Moves the eye of a parallel projection back, so that all depths of `bounds`, in model
 * coordinates, are over 0; does nothing if they are, or the projection is a perspective.
 */
void StepBack(vtkMatrix4x4* viewToClip, vtkMatrix4x4* modelToView, const double bounds[6],
  vtkMatrix4x4* viewToEye);
}

#endif
