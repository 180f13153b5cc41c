// SPDX-License-Identifier: BSD-3-Clause
// pcl_visualizer CLOUD.pcd [PICTURE.png]: a cloud of PCL's as a closed surface in PCL's own viewer,
// beside what else is added to it; or a picture of that, which needs no display.

#include <pcl/io/pcd_io.h>
#include <pcl/visualization/pcl_visualizer.h>

#include <vtkActor.h>
#include <vtkNew.h>
#include <vtkPCLConversion.h>
#include <vtkPNGWriter.h>
#include <vtkPolyData.h>
#include <vtkPullPushMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkRendererCollection.h>
#include <vtkWindowToImageFilter.h>

#include <iostream>

int main(int count, char* words[])
{
  if (count < 2 || count > 3)
  {
    std::cerr << "usage: pcl_visualizer CLOUD.pcd [PICTURE.png]\n";
    return EXIT_FAILURE;
  }
  // Any pcl::PointCloud will do as well: vtkPCLConversion::ToPolyData(cloud, surface).
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  if (pcl::io::loadPCDFile(words[1], cloud, origin, orientation) < 0)
  {
    return EXIT_FAILURE;
  }
  vtkNew<vtkPolyData> surface;
  vtkPCLConversion::ToPolyData(cloud, origin, orientation, surface);

  vtkNew<vtkPullPushMapper> mapper;
  mapper->SetInputData(surface);
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);

  const bool picture = count == 3;
  pcl::visualization::PCLVisualizer viewer("PointSurface", !picture);
  viewer.setSize(600, 600);
  viewer.setShowFPS(false);
  vtkRenderer* renderer = viewer.getRendererCollection()->GetFirstRenderer();
  renderer->AddActor(actor);
  renderer->ResetCamera();
  if (picture)
  {
    viewer.getRenderWindow()->SetOffScreenRendering(1);
    vtkNew<vtkWindowToImageFilter> shot; // PCL's own wants a window on a screen
    shot->SetInput(viewer.getRenderWindow());
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputConnection(shot->GetOutputPort());
    writer->SetFileName(words[2]);
    writer->Write();
    return EXIT_SUCCESS;
  }
  viewer.spin();
  return EXIT_SUCCESS;
}
