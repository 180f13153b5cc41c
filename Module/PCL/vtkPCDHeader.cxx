// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPCDHeader.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <set>
#include <stdexcept>

namespace
{
// The lines of a header in their order, which the format prescribes.
constexpr std::array<const char*, 10> Keywords = { "VERSION", "FIELDS", "SIZE", "TYPE", "COUNT",
  "WIDTH", "HEIGHT", "VIEWPOINT", "POINTS", "DATA" };

// Longer ones are no text.
constexpr std::size_t LongestLine = 1 << 20;

// What PCL's 32-bit offsets can address.
constexpr std::uint64_t MostBytes = std::numeric_limits<std::uint32_t>::max();

[[noreturn]] void Fail(const std::string& text)
{
  throw std::runtime_error(text);
}

// Whole numbers in text beyond this one are not exact: PCL reads text as double precision.
constexpr std::int64_t LargestExact = std::int64_t(1) << 53;

// Words between blanks, tabs and returns, as PCL splits lines.
const char* NextWord(const char* from, const char* end, const char*& wordEnd)
{
  const auto separates = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  const char* begin = std::find_if_not(from, end, separates);
  wordEnd = std::find_if(begin, end, separates);
  return begin;
}

std::vector<std::string> Split(const std::string& line)
{
  std::vector<std::string> words;
  const char* end = line.data() + line.size();
  const char* wordEnd = line.data();
  for (const char* word = NextWord(wordEnd, end, wordEnd); word != end;
       word = NextWord(wordEnd, end, wordEnd))
  {
    words.emplace_back(word, wordEnd);
  }
  return words;
}

// For messages, where a broken file may have anything.
std::string Quoted(const std::string& word)
{
  std::string text = word.substr(0, 40);
  std::replace_if(
    text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return '"' + text + '"';
}

template <typename T>
bool Parse(const char* begin, const char* end, T& value)
{
  const std::from_chars_result result = std::from_chars(begin, end, value);
  return result.ec == std::errc() && result.ptr == end;
}

std::uint64_t ParseCount(
  const std::string& keyword, const std::string& word, std::uint64_t least, std::uint64_t most)
{
  std::uint64_t value = 0;
  if (!Parse(word.data(), word.data() + word.size(), value) || value < least || value > most)
  {
    Fail("its header has " + Quoted(word) + " in the line " + keyword +
      ", where a whole number of " + std::to_string(least) + " to " + std::to_string(most) +
      " belongs");
  }
  return value;
}

void CheckLength(
  const std::string& keyword, const std::vector<std::string>& values, std::size_t count)
{
  if (values.size() != count)
  {
    Fail("its header has " + std::to_string(values.size()) + " values in the line " + keyword +
      ", where " + std::to_string(count) + " belong");
  }
}

// Digits with at most a minus and a point: most numbers, and always one; to see that much takes a
// fraction of the time of its value.
bool IsPlain(const char* begin, const char* end)
{
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  const char* first = begin + (*begin == '-' ? 1 : 0);
  const char* point = std::find_if_not(first, end, isDigit);
  if (point == end)
  {
    return point != first;
  }
  const char* last = std::find_if_not(point + 1, end, isDigit);
  return *point == '.' && last == end && end - first > 1;
}

bool IsFloat(const char* begin, const char* end)
{
  if (IsPlain(begin, end))
  {
    return true;
  }
  double value;
  const std::from_chars_result result = std::from_chars(begin, end, value);
  // too small or large a number is rounded to 0 or infinity
  return (result.ec == std::errc() || result.ec == std::errc::result_out_of_range) &&
    result.ptr == end;
}

bool IsSigned(const char* begin, const char* end, unsigned int size)
{
  std::int64_t value;
  const std::int64_t most =
    size == 8 ? LargestExact : std::numeric_limits<std::int64_t>::max() >> (64 - 8 * size);
  return Parse(begin, end, value) && value >= (size == 8 ? -most : -most - 1) && value <= most;
}

bool IsUnsigned(const char* begin, const char* end, unsigned int size)
{
  std::uint64_t value;
  const std::uint64_t most =
    size == 8 ? LargestExact : std::numeric_limits<std::uint64_t>::max() >> (64 - 8 * size);
  return Parse(begin, end, value) && value <= most;
}

bool IsValue(const vtkPCDHeader::Field& field, const char* begin, const char* end)
{
  if (*begin == '+' && begin[1] != '-') // there is a word end behind it, or the line's 0
  {
    ++begin;
  }
  switch (field.Type)
  {
    case 'F':
      return IsFloat(begin, end);
    case 'I':
      return IsSigned(begin, end, field.Size);
    case 'B':
      return end - begin == 1 && (*begin == '0' || *begin == '1');
    default:
      return IsUnsigned(begin, end, field.Size);
  }
}
} // anonymous namespace

//------------------------------------------------------------------------------
vtkPCDHeader::vtkPCDHeader(std::istream& file)
{
  std::string line;
  std::size_t next = 0; // in the order of lines
  while (next < Keywords.size())
  {
    line.clear();
    char c;
    while (file.get(c) && c != '\n')
    {
      line += c;
      if (line.size() > LongestLine)
      {
        Fail("it is no .pcd file: its header has a line without an end");
      }
    }
    const Words words = Split(line);
    if (!file)
    {
      Fail("it is no .pcd file, or cut short: its header has no line DATA");
    }
    // PCL takes a line of blanks alone for the end of the header.
    if (line.empty() || (!words.empty() && words[0][0] == '#'))
    {
      continue;
    }
    const std::string keyword =
      words.empty() ? "" : (words[0] == "COLUMNS" ? "FIELDS" : words[0]); // as it once was called
    const auto found = std::find(Keywords.begin(), Keywords.end(), keyword);
    const auto index = static_cast<std::size_t>(found - Keywords.begin());
    if (found == Keywords.end())
    {
      Fail("its header has the line " + Quoted(line) + ", which is none of a .pcd file's");
    }
    if (index < next)
    {
      Fail("its header has the line " + keyword + " twice, or behind one that it belongs before");
    }
    next = index + 1;
    this->ReadLine(keyword, Words(words.begin() + 1, words.end()));
  }
  this->CheckFields();
  this->CheckSize(file);
}

//------------------------------------------------------------------------------
void vtkPCDHeader::ReadLine(const std::string& keyword, const Words& values)
{
  const std::uint64_t most = std::numeric_limits<std::int32_t>::max(); // PCL's indices
  if (keyword == "VERSION")
  {
    return;
  }
  if (keyword == "FIELDS")
  {
    this->ReadFields(values);
  }
  else if (keyword == "SIZE" || keyword == "TYPE" || keyword == "COUNT")
  {
    this->HasSize = this->HasSize || keyword == "SIZE";
    this->HasType = this->HasType || keyword == "TYPE";
    CheckLength(keyword, values, this->Fields.size());
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      Field& field = this->Fields[i];
      if (keyword == "SIZE")
      {
        field.Size = static_cast<unsigned int>(ParseCount(keyword, values[i], 1, 8));
      }
      else if (keyword == "COUNT")
      {
        field.Count = static_cast<unsigned int>(ParseCount(keyword, values[i], 1, 1 << 24));
      }
      else
      {
        field.Type = values[i].size() == 1 ? static_cast<char>(std::toupper(values[i][0])) : '?';
      }
    }
  }
  else if (keyword == "VIEWPOINT")
  {
    CheckLength(keyword, values, 7);
    for (const std::string& value : values)
    {
      float number;
      if (!Parse(value.data(), value.data() + value.size(), number) || !std::isfinite(number))
      {
        Fail("its header has " + Quoted(value) + " in the line VIEWPOINT, where a number belongs");
      }
    }
  }
  else
  {
    CheckLength(keyword, values, 1);
    if (keyword == "WIDTH")
    {
      this->Width = ParseCount(keyword, values[0], 0, most);
      this->HasWidth = true;
    }
    else if (keyword == "HEIGHT")
    {
      this->Height = ParseCount(keyword, values[0], 0, most);
    }
    else if (keyword == "POINTS")
    {
      this->Points = ParseCount(keyword, values[0], 0, most);
    }
    else if (values[0] == "ascii" || values[0] == "binary" || values[0] == "binary_compressed")
    {
      this->Data = values[0] == "ascii"
        ? Encoding::Ascii
        : (values[0] == "binary" ? Encoding::Binary : Encoding::Compressed);
    }
    else
    {
      Fail("its data are " + Quoted(values[0]) + "; known are ascii, binary and binary_compressed");
    }
  }
}

//------------------------------------------------------------------------------
void vtkPCDHeader::ReadFields(const Words& names)
{
  std::set<std::string> known;
  for (const std::string& name : names)
  {
    if (name != "_" && !known.insert(name).second)
    {
      Fail("its header names the field " + Quoted(name) + " twice");
    }
    Field field;
    field.Name = name;
    this->Fields.push_back(field);
  }
}

//------------------------------------------------------------------------------
void vtkPCDHeader::CheckFields() const
{
  if (this->Fields.empty())
  {
    Fail("its header names no fields");
  }
  if (this->HasSize != this->HasType)
  {
    Fail(std::string("its header has no line ") + (this->HasSize ? "TYPE" : "SIZE"));
  }
  for (const Field& field : this->Fields)
  {
    const bool whole = field.Type == 'I' || field.Type == 'U';
    const bool power = field.Size == 1 || field.Size == 2 || field.Size == 4 || field.Size == 8;
    if (!(whole && power) && !(field.Type == 'F' && (field.Size == 4 || field.Size == 8)) &&
      !(field.Type == 'B' && field.Size == 1))
    {
      Fail("its header gives the field " + Quoted(field.Name) + " the type " +
        Quoted(std::string(1, field.Type)) + " of " + std::to_string(field.Size) +
        " bytes, which there is not");
    }
    if (field.Name == "_" && this->Data == Encoding::Compressed)
    {
      Fail("its data are binary_compressed with padding (a field named _), which PCL cannot read");
    }
  }
  const std::uint64_t size = this->HasWidth ? this->Width * this->Height : this->Points;
  if (size != this->Points)
  {
    Fail("its header says POINTS " + std::to_string(this->Points) + ", which is not WIDTH " +
      std::to_string(this->Width) + " times HEIGHT " + std::to_string(this->Height));
  }
}

//------------------------------------------------------------------------------
std::uint64_t vtkPCDHeader::GetPointSize() const
{
  std::uint64_t size = 0;
  for (const Field& field : this->Fields)
  {
    size += std::uint64_t(field.Size) * field.Count;
  }
  return size;
}

//------------------------------------------------------------------------------
void vtkPCDHeader::CheckSize(std::istream& file) const
{
  const std::streampos begin = file.tellg();
  file.seekg(0, std::ios::end);
  const auto left = static_cast<std::uint64_t>(file.tellg() - begin);
  file.seekg(begin);

  const std::uint64_t size = this->GetPointSize();
  if (size > MostBytes / 2 || this->Points > MostBytes / size)
  {
    Fail("it has more than 4 GiB of data, which PCL cannot read");
  }
  std::uint64_t needed = this->Points * size;
  if (this->Data == Encoding::Ascii)
  {
    std::uint64_t values = 0;
    for (const Field& field : this->Fields)
    {
      values += field.Count;
    }
    needed =
      this->Points * (2 * values) - (this->Points > 0 ? 1 : 0); // a digit, and what is between two
  }
  else if (this->Data == Encoding::Compressed)
  {
    std::array<std::uint32_t, 2>
      sizes = {}; // of the data, as they are in the file and as they will be
    if (!file.read(reinterpret_cast<char*>(sizes.data()), sizeof(sizes)))
    {
      Fail("it is cut short behind its header");
    }
    file.seekg(begin);
    if (sizes[1] != needed)
    {
      Fail("its header asks for " + std::to_string(needed) + " bytes of data, but " +
        std::to_string(sizes[1]) + " are compressed in it");
    }
    // LZF makes at most 264 bytes of 3.
    if (needed > std::uint64_t(88) * sizes[0])
    {
      Fail("its header says that " + std::to_string(needed) +
        " bytes of data are compressed into " + std::to_string(sizes[0]) + ", which cannot be");
    }
    needed = sizeof(sizes) + std::uint64_t(sizes[0]);
  }
  if (left < needed)
  {
    Fail("it is cut short, or its header lies: " + std::to_string(this->Points) +
      " points need at least " + std::to_string(needed) + " bytes, and " + std::to_string(left) +
      " follow the header");
  }
}

//------------------------------------------------------------------------------
void vtkPCDHeader::CheckPoint(const char* line, const char* end, std::uint64_t number) const
{
  const auto where = [&] { return "line " + std::to_string(number) + " of its data "; };
  const char* wordEnd = line;
  for (const Field& field : this->Fields)
  {
    for (unsigned int i = 0; i < field.Count; ++i)
    {
      const char* word = NextWord(wordEnd, end, wordEnd);
      if (word == end)
      {
        Fail(where() + "has no value for the field " + Quoted(field.Name));
      }
      if (!IsValue(field, word, wordEnd))
      {
        Fail(where() + "has " + Quoted(std::string(word, wordEnd)) + " for the field " +
          Quoted(field.Name) + ", which is no value of its type (" + field.Type + ", " +
          std::to_string(field.Size) + " bytes" +
          (field.Size == 8 && field.Type != 'F' ? ", of which PCL reads up to 2^53)" : ")"));
      }
    }
  }
  const char* more = NextWord(wordEnd, end, wordEnd);
  if (more != end)
  {
    Fail(where() + "has more values than there are fields");
  }
}
