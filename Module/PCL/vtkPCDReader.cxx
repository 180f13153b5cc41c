// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPCDReader.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPCDHeader.h"
#include "vtkPCLConversion.h"
#include "vtkPolyData.h"
#include "vtkProgressFor.h"

#include <boost/interprocess/file_mapping.hpp>
#include <boost/interprocess/mapped_region.hpp>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

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
  pcl::PCLPointCloud2 Points; // without data where File has them
  Eigen::Vector4f Origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf Orientation = Eigen::Quaternionf::Identity();
  boost::interprocess::mapped_region File;
  std::size_t Begin = 0; // of the data in it

  const unsigned char* GetData() const
  {
    return this->File.get_size() > 0
      ? static_cast<const unsigned char*>(this->File.get_address()) + this->Begin
      : this->Points.data.data();
  }
  std::size_t GetSize() const
  {
    return this->File.get_size() > 0 ? this->File.get_size() - this->Begin
                                     : this->Points.data.size();
  }
};

// Whole lines of text data, and what they were found to be.
struct TextBlock
{
  const char* Begin = nullptr;
  const char* End = nullptr;
  std::uint64_t Lines = 0; // up to the first one with a fault
  std::uint64_t Points = 0;
  const char* Fault = nullptr; // that line
};

std::vector<TextBlock> SplitText(const char* begin, const char* end)
{
  constexpr std::ptrdiff_t size = 1 << 18;
  std::vector<TextBlock> blocks;
  while (begin != end)
  {
    TextBlock block;
    block.Begin = begin;
    begin = std::find(begin + std::min(size, end - begin), end, '\n');
    begin += begin != end ? 1 : 0;
    block.End = begin;
    blocks.push_back(block);
  }
  return blocks;
}

void CheckTextBlock(const vtkPCDHeader& header, TextBlock& block)
{
  for (const char* line = block.Begin; line != block.End; ++block.Lines)
  {
    const char* end = std::find(line, block.End, '\n');
    if (end != line)
    {
      try
      {
        header.CheckPoint(line, end, 0);
      }
      catch (const std::runtime_error&)
      {
        block.Fault = line;
        return;
      }
      ++block.Points;
    }
    line = end + (end != block.End ? 1 : 0);
  }
}

// PCL leaves out a line that has too few values, and takes what is no number for 0.
void CheckText(
  const vtkPCDHeader& header, const char* begin, const char* end, vtkAlgorithm* reader, double to)
{
  std::vector<TextBlock> blocks = SplitText(begin, end);
  const vtkIdType batch = 16 * vtkSMPTools::GetEstimatedNumberOfThreads();
  if (!vtkProgressFor(reader, static_cast<vtkIdType>(blocks.size()), batch, 0.0, to,
        [&](vtkIdType first, vtkIdType last)
        {
          for (vtkIdType i = first; i < last; ++i)
          {
            CheckTextBlock(header, blocks[i]);
          }
        }))
  {
    return;
  }
  std::uint64_t lines = 0;
  std::uint64_t points = 0;
  for (const TextBlock& block : blocks)
  {
    lines += block.Lines;
    points += block.Points;
    if (points >= header.GetNumberOfPoints())
    {
      return; // what follows is not read
    }
    if (block.Fault)
    {
      header.CheckPoint(block.Fault, std::find(block.Fault, block.End, '\n'), lines + 1);
    }
  }
  throw std::runtime_error("it is cut short: its header asks for " +
    std::to_string(header.GetNumberOfPoints()) + " points, and there are " +
    std::to_string(points));
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
  using namespace boost::interprocess;
  if (header.GetEncoding() == vtkPCDHeader::Encoding::Ascii && header.GetNumberOfPoints() > 0)
  {
    const mapped_region map(file_mapping(name, read_only), read_only);
    const char* begin = static_cast<const char*>(map.get_address());
    CheckText(header, begin + data, begin + map.get_size(), reader, 0.1);
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
    switch (header.GetEncoding())
    {
      case vtkPCDHeader::Encoding::Ascii:
        file.clear();
        file.seekg(static_cast<std::streamoff>(data));
        buffer.SetRange(0.1, 0.8);
        result = pcd.readBodyASCII(file, cloud.Points, version);
        break;
      case vtkPCDHeader::Encoding::Binary: // lie there as they will in memory: PCL would copy them
        cloud.File = mapped_region(file_mapping(name, read_only), read_only);
        cloud.Begin = data;
        break;
      case vtkPCDHeader::Encoding::Compressed:
      {
        const mapped_region map(file_mapping(name, read_only), read_only);
        result = pcd.readBodyBinary(static_cast<const unsigned char*>(map.get_address()),
          cloud.Points, version, true, static_cast<unsigned int>(data));
        break;
      }
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
      vtkPCLConversion::ToPolyData(cloud.Points, cloud.GetData(), cloud.GetSize(), cloud.Origin,
        cloud.Orientation, output, this->RemoveInvalidPoints);
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
