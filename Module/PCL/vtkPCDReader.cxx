// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPCDReader.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPCDHeader.h"
#include "vtkPCLConversion.h"
#include "vtkPolyData.h"

#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkPCDReader);

namespace
{
// A file that reports how far it is read, and ends where the reader is aborted.
class FollowedFile : public std::filebuf
{
public:
  FollowedFile(const char* name, vtkAlgorithm* reader)
    : Reader(reader)
  {
    this->open(name, std::ios::in | std::ios::binary);
    this->Size = this->pubseekoff(0, std::ios::end);
    this->pubseekoff(0, std::ios::beg);
  }

  // The progress from the beginning to the end of the file.
  void SetRange(double from, double to)
  {
    this->From = from;
    this->To = to;
    this->Next = 0;
    this->Done = 0;
  }

protected:
  int_type underflow() override
  {
    const int_type result = std::filebuf::underflow();
    this->Done += this->egptr() - this->gptr();
    if (this->Done >= this->Next && this->To > this->From)
    {
      this->Next += 1 << 20;
      this->Reader->UpdateProgress(this->From + (this->To - this->From) * this->Done / this->Size);
    }
    return this->Reader->GetAbortExecute() ? traits_type::eof() : result;
  }

private:
  vtkAlgorithm* Reader;
  std::streamoff Size = 0;
  std::streamoff Done = 0;
  std::streamoff Next = 0;
  double From = 0.0;
  double To = 0.0;
};

// PCL prints what it does not like; what matters of that is an error of ours.
class SilentPCL
{
public:
  SilentPCL() { pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS); }
  ~SilentPCL() { pcl::console::setVerbosityLevel(this->Usual); }

private:
  const pcl::console::VERBOSITY_LEVEL Usual = pcl::console::getVerbosityLevel();
};

struct Cloud
{
  pcl::PCLPointCloud2 Points;
  Eigen::Vector4f Origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf Orientation = Eigen::Quaternionf::Identity();
};

// PCL leaves out a line that has too few values, and takes what is no number for 0.
void CheckText(const vtkPCDHeader& header, std::istream& file)
{
  std::string line;
  std::uint64_t number = 0;
  std::uint64_t points = 0;
  while (points < header.GetNumberOfPoints() && std::getline(file, line))
  {
    ++number;
    if (!line.empty())
    {
      header.CheckPoint(line, number);
      ++points;
    }
  }
  if (points < header.GetNumberOfPoints())
  {
    throw std::runtime_error("it is cut short: its header asks for " +
      std::to_string(header.GetNumberOfPoints()) + " points, and there are " +
      std::to_string(points));
  }
}

// Throws std::exception where that fails; nothing that is read is of worth when the reader was
// aborted.
void ReadCloud(const char* name, vtkAlgorithm* reader, Cloud& cloud)
{
  FollowedFile buffer(name, reader);
  std::istream file(&buffer);
  if (!buffer.is_open())
  {
    throw std::runtime_error("it does not exist, or may not be read");
  }
  const vtkPCDHeader header(file);
  const auto data = static_cast<std::size_t>(file.tellg());
  std::string head(data, '\0');
  file.seekg(0);
  file.read(&head[0], static_cast<std::streamsize>(data));
  const bool text = header.GetEncoding() == vtkPCDHeader::Encoding::Ascii;
  if (text)
  {
    buffer.SetRange(0.0, 0.2);
    CheckText(header, file);
    if (reader->GetAbortExecute())
    {
      return;
    }
  }

  // PCL sees the header alone: it would go on reading lines of it in the data.
  const SilentPCL silent;
  pcl::PCDReader pcd;
  std::istringstream lines(head);
  int version = 0;
  int encoding = 0;
  unsigned int begin = 0;
  int result =
    pcd.readHeader(lines, cloud.Points, cloud.Origin, cloud.Orientation, version, encoding, begin);
  if (result == 0 && header.GetNumberOfPoints() > 0)
  {
    if (text)
    {
      file.clear();
      file.seekg(static_cast<std::streamoff>(data));
      buffer.SetRange(0.2, 0.8);
      result = pcd.readBodyASCII(file, cloud.Points, version);
    }
    else
    {
      using namespace boost::interprocess;
      const mapped_region map(file_mapping(name, read_only), read_only);
      result = pcd.readBodyBinary(static_cast<const unsigned char*>(map.get_address()),
        cloud.Points, version, encoding == 2, static_cast<unsigned int>(data));
    }
  }
  if (result < 0 && !reader->GetAbortExecute())
  {
    throw std::runtime_error("its data are broken: PCL cannot read them");
  }
}
} // anonymous namespace

//------------------------------------------------------------------------------
vtkPCDReader::vtkPCDReader()
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
vtkPCDReader::~vtkPCDReader()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
int vtkPCDReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkPolyData* output = vtkPolyData::GetData(outputVector);
  if (!this->FileName || !*this->FileName)
  {
    vtkErrorMacro("No file to read: call SetFileName.");
    return 1; // the pipeline would add an error of its own
  }
  try
  {
    this->UpdateProgress(0.0);
    Cloud cloud;
    if (!this->GetAbortExecute())
    {
      ReadCloud(this->FileName, this, cloud);
      this->UpdateProgress(0.8);
    }
    if (!this->GetAbortExecute())
    {
      vtkPCLConversion::ToPolyData(
        cloud.Points, cloud.Origin, cloud.Orientation, output, this->RemoveInvalidPoints);
      this->UpdateProgress(1.0);
    }
  }
  catch (const std::bad_alloc&)
  {
    output->Initialize();
    vtkErrorMacro("Cannot read " << this->FileName << ": there is not enough memory for it.");
  }
  catch (const std::exception& fault)
  {
    output->Initialize();
    vtkErrorMacro("Cannot read " << this->FileName << ": " << fault.what() << ".");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkPCDReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "RemoveInvalidPoints: " << (this->RemoveInvalidPoints ? "On\n" : "Off\n");
}
