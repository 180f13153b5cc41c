// SPDX-License-Identifier: BSD-3-Clause
// PCDReaderBenchmark [POINTS [RUNS]]: vtkPCDReader beside pcl::PCDReader, which it reads by. Prints
// a Markdown table. Medians of runs that take turns, so that a busy machine slows both alike; the
// ratio of a row is what counts. Text has a tenth of the points.
#include "vtkMinimalStandardRandomSequence.h"
#include "vtkNew.h"
#include "vtkPCDReader.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"

#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <iostream>
#include <string>
#include <vector>

namespace
{
double Milliseconds(const std::function<void()>& work)
{
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
    .count();
}

double Median(std::vector<double> values)
{
  std::nth_element(values.begin(), values.begin() + values.size() / 2, values.end());
  return values[values.size() / 2];
}

template <typename PointT>
void Measure(const std::string& type, const std::string& encoding, std::size_t points, int runs)
{
  const std::string file = "PCDReaderBenchmark.pcd";
  {
    pcl::PointCloud<PointT> cloud;
    cloud.resize(points);
    vtkNew<vtkMinimalStandardRandomSequence> random;
    random->SetSeed(1);
    for (auto& point : cloud)
    {
      for (float& x : { std::ref(point.x), std::ref(point.y), std::ref(point.z) })
      {
        random->Next();
        x = static_cast<float>(random->GetRangeValue(-100.0, 100.0));
      }
    }
    pcl::PCDWriter writer;
    encoding == "ascii"      ? writer.writeASCII(file, cloud)
      : encoding == "binary" ? writer.writeBinary(file, cloud)
                             : writer.writeBinaryCompressed(file, cloud);
  }
  std::vector<double> fields;
  std::vector<double> typed;
  std::vector<double> ours;
  for (int run = 0; run < runs; ++run)
  {
    fields.push_back(Milliseconds(
      [&]
      {
        pcl::PCLPointCloud2 cloud;
        pcl::PCDReader().read(file, cloud);
      }));
    typed.push_back(Milliseconds(
      [&]
      {
        pcl::PointCloud<PointT> cloud;
        pcl::PCDReader().read(file, cloud);
      }));
    ours.push_back(Milliseconds(
      [&]
      {
        vtkNew<vtkPCDReader> reader;
        reader->SetFileName(file.c_str());
        reader->Update();
        if (reader->GetOutput()->GetNumberOfPoints() != static_cast<vtkIdType>(points))
        {
          std::abort();
        }
      }));
  }
  std::remove(file.c_str());
  std::printf("| %s | %s | %zu | %.0f | %.0f | %.0f | %.2f | %.2f |\n", type.c_str(),
    encoding.c_str(), points, Median(fields), Median(typed), Median(ours),
    Median(ours) / Median(fields), Median(ours) / Median(typed));
  std::fflush(stdout);
}
} // anonymous namespace

int main(int count, char* words[])
{
  const std::size_t points = count > 1 ? std::strtoul(words[1], nullptr, 10) : 10000000;
  const int runs = count > 2 ? std::atoi(words[2]) : 7;
  std::cout << "# vtkPCDReader beside pcl::PCDReader\n\nMedians of " << runs << " runs in turn, "
            << vtkSMPTools::GetEstimatedNumberOfThreads() << " threads; milliseconds. PCL into a "
            << "PCLPointCloud2 (fields as in the file), and into a PointCloud of the type.\n\n"
            << "| points of | data | points | PCL, fields | PCL, typed | vtkPCDReader | ratio to "
               "fields | ratio to typed |\n| --- | --- | --- | --- | --- | --- | --- | --- |"
            << std::endl;
  for (const std::string encoding : { "binary", "binary_compressed", "ascii" })
  {
    const std::size_t size = encoding == "ascii" ? points / 10 : points;
    Measure<pcl::PointXYZ>("PointXYZ", encoding, size, runs);
    Measure<pcl::PointXYZRGBNormal>("PointXYZRGBNormal", encoding, size, runs);
  }
  return EXIT_SUCCESS;
}
