// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkPCDHeader
 * @brief   the header of a .pcd file, checked against the file that it is in
 *
 * PCL believes what a header says: it allocates what it is told, and takes a file for as long as it
 * should be. A file that passes here is one that pcl::PCDReader reads whole, and within the memory
 * that the file's own size bounds (some hundred times as much for the compressed format, at most).
 * Not wrapped, not installed: it serves vtkPCDReader.
 */
#ifndef vtkPCDHeader_h
#define vtkPCDHeader_h

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

class vtkPCDHeader
{
public:
  enum class Encoding
  {
    Ascii,
    Binary,
    Compressed
  };

  struct Field
  {
    std::string Name;
    char Type = 'F'; // signed (I), unsigned (U), floating point (F), bool (B)
    unsigned int Size = 4;
    unsigned int Count = 1;
  };

  /**
   * Reads the header from the beginning of a file that was opened as binary, and stays behind it.
   * Throws std::runtime_error, with a text for the user, where it is broken or asks for more than
   * the file holds.
   */
  explicit vtkPCDHeader(std::istream& file);

  /**
   * Throws std::runtime_error, with a text for the user, unless the line is the values of a point:
   * as many as there are fields, each a number that its field can hold. `number`: of the line, for
   * the text.
   */
  void CheckPoint(const char* line, const char* end, std::uint64_t number) const;

  Encoding GetEncoding() const { return this->Data; }
  std::uint64_t GetNumberOfPoints() const { return this->Points; }

private:
  using Words = std::vector<std::string>;

  void ReadLine(const std::string& keyword, const Words& values);
  void ReadFields(const Words& names);
  void CheckFields() const;
  void CheckSize(std::istream& file) const;
  std::uint64_t GetPointSize() const;

  std::vector<Field> Fields;
  std::uint64_t Width = 0;
  std::uint64_t Height = 1;
  bool HasWidth = false;
  bool HasSize = false;
  bool HasType = false;
  std::uint64_t Points = 0;
  Encoding Data = Encoding::Ascii;
};

#endif
