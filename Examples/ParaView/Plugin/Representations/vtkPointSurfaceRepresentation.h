// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPointSurfaceRepresentation
 * @brief   "Point Surface": points drawn as the surface that they stand for, in ParaView
 *
 * All that ParaView's surface representation can do (colouring, lighting, opacity, transforms,
 * back faces, selection, blocks) holds here too: only the mappers are others. Which one is told by
 * System. Input is any data set or tree of them; of a grid with cells, as of a mesh, the points of
 * its outer surface are drawn.
 *
 * Where ParaView asks for a coarser level of detail while the camera moves (its settings tell from
 * which size of data on), one point of 2^k is drawn, with a radius as much larger; k falls from 8
 * to 0 with ParaView's "LOD Resolution". Algebraic splats, which are few already, are all drawn.
 *
 * Where the data are spread over several ranks, each gets copies of the points beyond its borders
 * (vtkGhostPointsGenerator) and draws its part; ParaView puts the pictures together by depth.
 *
 * @sa vtkPointSurfaceMapper
 */
#ifndef vtkPointSurfaceRepresentation_h
#define vtkPointSurfaceRepresentation_h

#include "vtkGeometryRepresentationWithFaces.h"
#include "vtkNew.h"                               // for vtkNew
#include "vtkPointSurfaceRepresentationsModule.h" // for export macro
#include "vtkSmartPointer.h"                      // for vtkSmartPointer

#include <string> // for std::string

class vtkCompositeDataDisplayAttributes;
class vtkGhostPointsGenerator;
class vtkPointSurfaceMapper;

class VTKPOINTSURFACEREPRESENTATIONS_EXPORT vtkPointSurfaceRepresentation
  : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkPointSurfaceRepresentation* New();
  vtkTypeMacro(vtkPointSurfaceRepresentation, vtkGeometryRepresentationWithFaces);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * The systems that make a surface of points.
   */
  enum SystemType
  {
    AUTOMATIC,        ///< ALGEBRAIC_SPLATS for what vtkAlgebraicSplats makes, else PULL_PUSH
    PULL_PUSH,        ///< vtkPullPushMapper
    IMAGE_SPACE,      ///< vtkImageSpacePointMapper
    DIRECT,           ///< vtkDirectPointMapper
    ALGEBRAIC_SPLATS, ///< vtkAlgebraicSplatMapper
    SURFACE_SPLATS    ///< vtkSurfaceSplatMapper
  };

  ///@{
  /**
   * The system that draws; see SystemType. Default AUTOMATIC.
   */
  void SetSystem(int system);
  vtkGetMacro(System, int);
  ///@}

  ///@{
  /**
   * Draw as the system's paper says, with all departures from it turned off. Default off.
   */
  void SetPublished(bool published);
  vtkGetMacro(Published, bool);
  ///@}

  ///@{
  /**
   * Properties of vtkPointSurfaceMapper; the array "None", the default, is none.
   */
  void SetRadiusArray(const std::string& array);
  void SetRadius(double radius);
  void SetRadiusScale(double scale);
  vtkSetClampMacro(Supersampling, int, 1, 4);
  vtkSetClampMacro(Backend, int, 0, 2);
  ///@}

  ///@{
  /**
   * Properties of vtkImageSpacePointMapper. Not used where Published is on.
   */
  vtkSetClampMacro(SmoothingIterations, int, 0, 100);
  vtkSetMacro(AntialiasOutline, bool);
  ///@}

  /**
   * A property of vtkDirectPointMapper. Not used where Published is on.
   */
  vtkSetClampMacro(DepthTolerance, double, 0.0, 1.0);

  void SetArrayIdNames(const char* pointArray, const char* cellArray) override;
  int ProcessViewRequest(
    vtkInformationRequestKey* request, vtkInformation* inInfo, vtkInformation* outInfo) override;

protected:
  vtkPointSurfaceRepresentation();
  ~vtkPointSurfaceRepresentation() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int System = AUTOMATIC;
  bool Published = false;
  std::string RadiusArray = "None";
  double Radius = 0.0;
  double RadiusScale = 1.0;
  int Supersampling = 1;
  int Backend = 0;
  int SmoothingIterations = 1;
  bool AntialiasOutline = false;
  double DepthTolerance = 0.0075;

private:
  vtkPointSurfaceRepresentation(const vtkPointSurfaceRepresentation&) = delete;
  void operator=(const vtkPointSurfaceRepresentation&) = delete;

  void TellBounds(vtkInformation* inInfo);
  int ChooseSystem(vtkDataObject* data) const;
  void UpdateMappers(int system, double growth);
  vtkSmartPointer<vtkPointSurfaceMapper> NewMapper(int system) const;
  void ReplaceMapper(vtkMapper*& mapper, int system, vtkCompositeDataDisplayAttributes* blocks);
  void SetUpMapper(vtkMapper* mapper, double growth) const;
  void UpdateLOD(vtkInformation* inInfo);
  bool HasRadiusArray() const;
  bool HasRadii(vtkDataObject* data, int system) const; // else they are estimated

  vtkNew<vtkGhostPointsGenerator> Ghosts;
  vtkNew<vtkCompositeDataDisplayAttributes> BlockAttributes;
  vtkNew<vtkCompositeDataDisplayAttributes> LODBlockAttributes;
  int MapperSystem = AUTOMATIC; // that the mappers are of; none yet
  bool MapperPublished = false;
};

#endif
