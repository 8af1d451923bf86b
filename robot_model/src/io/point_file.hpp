// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_source.hpp"
#include "io/scalar.hpp"
#include "swept/robot_model/cloud_file.hpp"

namespace swept::detail {

/// The largest file, in bytes: 2 GiB, less one so that an int counts the lines of any file. That is
/// far more than one robot senses. A larger bound would let the program take more memory at once
/// before it knows anything about a file.
inline constexpr std::size_t kMaxFileBytes = (std::size_t{1} << 31) - 1;
/// The most points and cubes: 1.2 and 1.6 GB of memory. With a larger bound, a small file of binary
/// zeros or of a compressed cloud could take more than that.
inline constexpr std::size_t kMaxPoints = 50'000'000;
/// The most bytes in a line of text: some 100 thousand numbers. With a larger bound, files that are
/// not text would be searched for ends of lines.
inline constexpr std::size_t kMaxLine = std::size_t{1} << 20;

/// A file of sensed points or cubes, whole in memory.
class PointFile {
 public:
  /// Throws InputError (line 0) for a file that is missing, neither regular nor a pipe or the like,
  /// empty, too large, or unreadable.
  PointFile(const std::filesystem::path& file, const LoadOptions& options);

  const InputSource& source() const { return source_; }
  std::string_view bytes() const { return {bytes_.get(), size_}; }
  /// Throws with line 0 and the offset in the message, for the parts of files that have no lines.
  [[noreturn]] void failAt(std::size_t offset, const std::string& message) const;

 private:
  InputSource source_;
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// The lines of a file in order, without their ends (LF, or CR and LF).
class LineReader {
 public:
  explicit LineReader(const PointFile& file) : LineReader(file.source(), file.bytes()) {}
  /// Both outlive it. A mark of UTF-8 in front is passed over.
  LineReader(const InputSource& source, std::string_view bytes)
      : source_(source), bytes_(bytes), offset_(bytes.starts_with("\xef\xbb\xbf") ? 3 : 0) {}
  /// Moves to the next line; false: there is none. Throws InputError for a line that is too long.
  bool next();
  /// Moves to the next line that has more than white space.
  bool nextFilled();
  /// The present line.
  std::string_view line() const { return line_; }
  int number() const { return number_; }
  /// The offset of the byte after the end of the present line.
  std::size_t offset() const { return offset_; }
  [[noreturn]] void fail(const std::string& message) const { source_.fail(number_, message); }

 private:
  const InputSource& source_;
  std::string_view bytes_;
  std::string_view line_;
  int number_ = 0;
  std::size_t offset_;
};

/// The content of a file, without the points that are not finite.
class PointList {
 public:
  void reserve(std::size_t count) { points_.reserve(count); }
  void add(const Eigen::Vector3d& point) {
    ++given_;
    if (std::isfinite(point.x()) && std::isfinite(point.y()) && std::isfinite(point.z())) {
      points_.push_back(point);
    }
  }
  std::size_t given() const { return given_; }
  /// Adds a remark on the points left out. Throws InputError if none are left.
  std::vector<Eigen::Vector3d> finish(const InputSource& source);

 private:
  std::vector<Eigen::Vector3d> points_;
  std::size_t given_ = 0;
};

/// The location of one coordinate of the points in a binary file.
struct CoordinateData {
  Scalar type = Scalar::Float32;
  const char* first = nullptr;
  std::size_t step = 0;  ///< in bytes, from a point to the next
};

/// Adds this many points; `axes` are x, y and z.
void addPoints(const std::array<CoordinateData, 3>& axes, std::size_t count, std::endian order,
               PointList& points);

/// The file's ending, dot included, in lower case.
std::string lowerEnding(const std::filesystem::path& file);

/// Separated by blanks and tabs.
std::vector<std::string_view> words(std::string_view line);

/// A file's text as messages show it: in quotes, unprintable characters as `?`, long text cut.
std::string shown(std::string_view text);

/// A whole number from 0 to 9e15, which doubles and 64 bits hold.
std::optional<std::uint64_t> parseCount(std::string_view text);

/// One reader per format. `file` outlives the call.
SensedPoints readPcd(const PointFile& file);
SensedPoints readPly(const PointFile& file);
SensedPoints readXyz(const PointFile& file);

/// Appended to a sensor's pose in messages.
inline constexpr std::string_view kSensorRemark =
    "is where the sensor was, in the frame of the points; it does not move them";

}  // namespace swept::detail
