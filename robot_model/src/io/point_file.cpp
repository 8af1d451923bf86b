// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_file.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <utility>

#include "io/read_files.hpp"
#include "io/regular_file.hpp"

namespace swept::detail {

namespace {

constexpr std::string_view kBlanks = " \t";
constexpr std::size_t kLeastRoom = std::size_t{1} << 16;
constexpr std::size_t kShown = 40;  ///< bytes of a file's text in a message

/// The file's size as the file system gives it: 0 for pipes, and for files that are made while they
/// are read.
std::size_t statedSize(const std::filesystem::path& file, const InputSource& source) {
  const std::string reason = whyNoBytes(file);
  if (!reason.empty()) source.fail(0, reason);
  std::error_code noSize;
  const std::uintmax_t size = std::filesystem::file_size(file, noSize);
  if (noSize) return 0;
  if (size > kMaxFileBytes) {
    source.fail(0, "the file has " + std::to_string(size) + " bytes; at most " +
                       std::to_string(kMaxFileBytes) + " are allowed");
  }
  return static_cast<std::size_t>(size);
}

}  // namespace

PointFile::PointFile(const std::filesystem::path& file, const LoadOptions& options)
    : source_(file.string(), options) {
  // With one byte more, the read meets the end without another buffer.
  std::size_t room = std::max(statedSize(file, source_) + 1, kLeastRoom);
  bytes_ = std::make_unique_for_overwrite<char[]>(room);
  ReadFiles::note(file);
  std::ifstream stream(file, std::ios::binary);
  const auto readOn = [&] {
    stream.read(bytes_.get() + size_, static_cast<std::streamsize>(room - size_));
    size_ += static_cast<std::size_t>(stream.gcount());
  };
  for (readOn(); size_ == room && size_ <= kMaxFileBytes; readOn()) {
    room *= 2;
    auto larger = std::make_unique_for_overwrite<char[]>(room);
    std::copy_n(bytes_.get(), size_, larger.get());
    bytes_ = std::move(larger);
  }
  if (size_ > kMaxFileBytes) {
    source_.fail(0, "the file has more than " + std::to_string(kMaxFileBytes) +
                        " bytes, which are the most allowed");
  }
  if (!stream.eof()) source_.fail(0, "file cannot be read");
  if (size_ == 0) source_.fail(0, "the file is empty");
}

void PointFile::failAt(std::size_t offset, const std::string& message) const {
  source_.fail(0, "at byte " + std::to_string(offset) + ": " + message);
}

bool LineReader::next() {
  const std::string_view rest = bytes_.substr(offset_);
  if (rest.empty()) return false;
  ++number_;
  // One byte more than the longest line, for its end of line.
  const std::size_t end = rest.substr(0, kMaxLine + 1).find('\n');
  const bool ends = end != std::string_view::npos;
  if (!ends && rest.size() > kMaxLine) {
    fail("the line has more than " + std::to_string(kMaxLine) +
         " bytes, which is the most allowed");
  }
  line_ = rest.substr(0, end);
  offset_ += line_.size() + (ends ? 1 : 0);
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  return true;
}

bool LineReader::nextFilled() {
  while (next()) {
    if (line_.find_first_not_of(kBlanks) != std::string_view::npos) return true;
  }
  return false;
}

std::vector<Eigen::Vector3d> PointList::finish(const InputSource& source) {
  const std::string given = std::to_string(given_);
  if (given_ == 0) source.fail(0, "the file has no points");
  if (points_.empty()) source.fail(0, "none of its " + given + " points is finite");
  const std::size_t left = given_ - points_.size();
  if (left > 0) {
    source.warn(0, std::to_string(left) + " of " + given + " points are not finite and left out");
  }
  return std::move(points_);
}

void addPoints(const std::array<CoordinateData, 3>& axes, std::size_t count, std::endian order,
               PointList& points) {
  points.reserve(points.given() + count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto value = [&](const CoordinateData& axis) {
      return decode(axis.type, axis.first + i * axis.step, order);
    };
    points.add({value(axes[0]), value(axes[1]), value(axes[2])});
  }
}

std::string lowerEnding(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> result;
  for (auto begin = line.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const auto end = std::min(line.find_first_of(kBlanks, begin), line.size());
    result.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(kBlanks, end);
  }
  return result;
}

std::string shown(std::string_view text) {
  std::string cut(text.substr(0, kShown));
  for (char& c : cut) {
    if (c < ' ' || c > '~') c = '?';
  }
  return "'" + cut + (text.size() > kShown ? "..." : "") + "'";
}

std::optional<std::uint64_t> parseCount(std::string_view text) {
  constexpr std::uint64_t kMost = 9'000'000'000'000'000;
  std::uint64_t value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc{} || result.ptr != text.data() + text.size()) return std::nullopt;
  if (value > kMost) return std::nullopt;
  return value;
}

}  // namespace swept::detail
