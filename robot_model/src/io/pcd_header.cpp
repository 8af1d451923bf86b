// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd_header.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "text/numbers.hpp"

namespace swept::detail {

namespace {

constexpr std::array<std::string_view, 10> kEntries{
    "VERSION", "FIELDS", "SIZE", "TYPE", "COUNT", "WIDTH", "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
constexpr std::string_view kOldFields = "COLUMNS";  ///< FIELDS of PCD 0.5
constexpr std::uint64_t kMaxCount = 1 << 20;  ///< values of one field: as many as fit in a line

struct Field {
  std::string name;
  std::size_t size = 4;  ///< in bytes, of one value
  char type = 'F';
  std::size_t count = 1;
};

class PcdHeaderReader {
 public:
  PcdHeaderReader(LineReader& lines, const InputSource& source) : lines_(lines), source_(source) {}
  PcdHeader read();

 private:
  struct Entry {
    int line = 0;
    std::vector<std::string_view> values;
  };
  void readEntries();
  const Entry* find(std::string_view name) const;
  const Entry& require(std::string_view name) const;
  /// The values of an entry that has one for each of `count` fields.
  const Entry& requireValues(std::string_view name, std::size_t count) const;
  std::uint64_t wholeNumber(std::string_view name, std::size_t index, std::uint64_t least,
                            std::uint64_t most) const;
  void checkVersion() const;
  PcdForm readForm() const;
  std::size_t readPoints() const;
  std::vector<Field> readFields() const;
  void readSize(Field& field, std::size_t index) const;
  void placeAxes(const std::vector<Field>& fields, PcdHeader& header) const;
  Eigen::Vector3d readViewpoint() const;

  LineReader& lines_;
  const InputSource& source_;
  std::map<std::string_view, Entry> entries_;
};

void PcdHeaderReader::readEntries() {
  while (lines_.nextFilled()) {
    std::vector<std::string_view> values = words(lines_.line());
    const std::string_view name = values.front();
    if (name.front() == '#') continue;
    if (std::ranges::find(kEntries, name) == kEntries.end() && name != kOldFields) {
      lines_.fail("unknown entry " + shown(name) +
                  " of a PCD header; allowed are VERSION, FIELDS, SIZE, TYPE, COUNT, WIDTH, "
                  "HEIGHT, VIEWPOINT, POINTS and DATA");
    }
    const std::string_view key = name == kOldFields ? "FIELDS" : name;
    if (const Entry* const first = find(key)) {
      lines_.fail("a second entry " + std::string(key) + "; the first is at line " +
                  std::to_string(first->line));
    }
    values.erase(values.begin());
    const bool last = name == "DATA";
    entries_[key] = {lines_.number(), std::move(values)};
    if (last) return;
  }
  source_.fail(0, "the file ends where an entry DATA of its header should follow");
}

const PcdHeaderReader::Entry* PcdHeaderReader::find(std::string_view name) const {
  const auto found = entries_.find(name);
  return found == entries_.end() ? nullptr : &found->second;
}

const PcdHeaderReader::Entry& PcdHeaderReader::require(std::string_view name) const {
  const Entry* const entry = find(name);
  if (entry == nullptr) lines_.fail("the header has no entry " + std::string(name));
  return *entry;
}

const PcdHeaderReader::Entry& PcdHeaderReader::requireValues(std::string_view name,
                                                             std::size_t count) const {
  const Entry& entry = require(name);
  if (entry.values.size() != count) {
    source_.fail(entry.line, std::string(name) + " has " + std::to_string(entry.values.size()) +
                                 " values; it must have " + std::to_string(count));
  }
  return entry;
}

std::uint64_t PcdHeaderReader::wholeNumber(std::string_view name, std::size_t index,
                                           std::uint64_t least, std::uint64_t most) const {
  const Entry& entry = require(name);
  const std::string_view text = entry.values[index];
  const auto value = parseCount(text);
  if (!value || *value < least || *value > most) {
    source_.fail(entry.line, std::string(name) + " is " + shown(text) +
                                 "; it must be a whole number from " + std::to_string(least) +
                                 " to " + std::to_string(most));
  }
  return *value;
}

void PcdHeaderReader::checkVersion() const {
  if (find("VERSION") == nullptr) return;
  const Entry& entry = requireValues("VERSION", 1);
  const std::string_view version = entry.values[0];
  constexpr std::array<std::string_view, 6> kVersions{"0.7", ".7", "0.6", ".6", "0.5", ".5"};
  if (std::ranges::find(kVersions, version) == kVersions.end()) {
    source_.fail(entry.line, "VERSION is " + shown(version) + "; allowed are 0.5, 0.6 and 0.7");
  }
}

PcdForm PcdHeaderReader::readForm() const {
  const Entry& entry = requireValues("DATA", 1);
  const std::string_view form = entry.values[0];
  if (form == "ascii") return PcdForm::Ascii;
  if (form == "binary") return PcdForm::Binary;
  if (form == "binary_compressed") return PcdForm::Compressed;
  source_.fail(entry.line,
               "DATA is " + shown(form) + "; allowed are ascii, binary and binary_compressed");
}

std::size_t PcdHeaderReader::readPoints() const {
  const auto size = [&](std::string_view name) {
    if (find(name) == nullptr) return std::uint64_t{0};
    requireValues(name, 1);
    return wholeNumber(name, 0, 0, kMaxPoints);
  };
  requireValues("POINTS", 1);
  std::uint64_t width = size("WIDTH");
  const std::uint64_t height = std::max<std::uint64_t>(size("HEIGHT"), 1);
  const std::uint64_t points = wholeNumber("POINTS", 0, 1, kMaxPoints);
  if (width == 0 && size("HEIGHT") == 0) width = points;
  if (width == 0) require("WIDTH");
  if (width * height != points) {
    source_.fail(require("POINTS").line, "POINTS is " + std::to_string(points) +
                                             ", but WIDTH times HEIGHT " +
                                             std::to_string(width * height));
  }
  return static_cast<std::size_t>(points);
}

void PcdHeaderReader::readSize(Field& field, std::size_t index) const {
  const Entry& sizes = require("SIZE");
  const Entry& types = require("TYPE");
  const std::string_view size = sizes.values[index];
  std::string_view type = types.values[index];
  if (type == "f") type = "F";
  if (type == "i") type = "I";
  // The newest type of this format is a boolean of one byte.
  if (type == "u" || ((type == "B" || type == "b") && size == "1")) type = "U";
  if (size != "1" && size != "2" && size != "4" && size != "8") {
    source_.fail(sizes.line, "SIZE of " + shown(field.name) + " is " + shown(size) +
                                 "; allowed are 1, 2, 4 and 8");
  }
  if (type != "F" && type != "I" && type != "U") {
    source_.fail(types.line, "TYPE of " + shown(field.name) + " is " + shown(type) +
                                 "; allowed are F, I and U");
  }
  field.size = static_cast<std::size_t>(size[0] - '0');
  field.type = type[0];
  if (field.type == 'F' && field.size < 4) {
    source_.fail(sizes.line, "SIZE of " + shown(field.name) + " is " + shown(size) +
                                 "; of TYPE F, 4 and 8 are allowed");
  }
}

std::vector<Field> PcdHeaderReader::readFields() const {
  const Entry& names = require("FIELDS");
  const std::size_t size = names.values.size();
  const bool counted = find("COUNT") != nullptr;
  const bool sized = counted || find("SIZE") != nullptr || find("TYPE") != nullptr;
  if (sized) requireValues("SIZE", size);
  if (sized) requireValues("TYPE", size);
  if (counted) requireValues("COUNT", size);
  std::vector<Field> fields;
  for (std::size_t i = 0; i < size; ++i) {
    Field field;
    field.name = names.values[i];
    if (sized) readSize(field, i);
    // Drivers of lidars write padding with a COUNT of 0; the Point Cloud Library reads it as
    // absent.
    if (counted) field.count = static_cast<std::size_t>(wholeNumber("COUNT", i, 0, kMaxCount));
    fields.push_back(std::move(field));
  }
  return fields;
}

Scalar scalarOf(const Field& field) {
  if (field.type == 'F') return field.size == 4 ? Scalar::Float32 : Scalar::Float64;
  const bool isSigned = field.type == 'I';
  switch (field.size) {
    case 1:
      return isSigned ? Scalar::Int8 : Scalar::UInt8;
    case 2:
      return isSigned ? Scalar::Int16 : Scalar::UInt16;
    case 4:
      return isSigned ? Scalar::Int32 : Scalar::UInt32;
    default:
      return isSigned ? Scalar::Int64 : Scalar::UInt64;
  }
}

void PcdHeaderReader::placeAxes(const std::vector<Field>& fields, PcdHeader& header) const {
  constexpr std::array<std::string_view, 3> kAxes{"x", "y", "z"};
  const int line = require("FIELDS").line;
  std::array<bool, 3> placed{};
  for (const Field& field : fields) {
    Column column{field.name, -1, field.count};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (field.name != kAxes[axis]) continue;
      if (placed[axis]) source_.fail(line, "FIELDS names " + shown(field.name) + " twice");
      if (field.count != 1) {
        source_.fail(require("COUNT").line, "COUNT of " + shown(field.name) + " is '" +
                                                std::to_string(field.count) + "'; it must be 1");
      }
      placed[axis] = true;
      header.axes[axis] = {scalarOf(field), header.pointSize};
      column.axis = static_cast<int>(axis);
    }
    header.columns.push_back(std::move(column));
    header.pointSize += field.size * field.count;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!placed[axis]) {
      source_.fail(
          line, "FIELDS does not name '" + std::string(kAxes[axis]) + "'; x, y and z are needed");
    }
  }
  if (header.pointSize > kMaxFileBytes) {
    source_.fail(line, "a point has " + std::to_string(header.pointSize) + " bytes; at most " +
                           std::to_string(kMaxFileBytes) + " are allowed");
  }
}

/// The sensor's position in the points' own frame. The Point Cloud Library's NormalEstimation and
/// VoxelGridOcclusionEstimation take it so. Some programs write the transform to apply to the
/// points instead. The library's readers never apply it. The remark is for users who expect it.
Eigen::Vector3d PcdHeaderReader::readViewpoint() const {
  if (find("VIEWPOINT") == nullptr) return Eigen::Vector3d::Zero();
  const Entry& entry = requireValues("VIEWPOINT", 7);
  std::array<double, 7> pose{};
  for (std::size_t i = 0; i < pose.size(); ++i) {
    const auto value = parseNumber(entry.values[i]);
    if (!value) {
      source_.fail(entry.line,
                   "VIEWPOINT has " + shown(entry.values[i]) +
                       "; it must be 7 finite numbers: x, y, z, then a quaternion w, x, y, z");
    }
    pose[i] = *value;
  }
  constexpr std::array<double, 7> kIdentity{0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0};
  if (pose != kIdentity) source_.warn(entry.line, "VIEWPOINT " + std::string(kSensorRemark));
  return {pose[0], pose[1], pose[2]};
}

PcdHeader PcdHeaderReader::read() {
  readEntries();
  PcdHeader header;
  checkVersion();
  header.form = readForm();
  header.points = readPoints();
  placeAxes(readFields(), header);
  header.sensor = readViewpoint();
  return header;
}

}  // namespace

PcdHeader readPcdHeader(LineReader& lines, const InputSource& source) {
  return PcdHeaderReader(lines, source).read();
}

}  // namespace swept::detail
