// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <memory>
#include <span>

#include "io/lzf.hpp"
#include "io/pcd_header.hpp"

namespace swept::detail {

namespace {

using Points = std::vector<Eigen::Vector3d>;

Points readAscii(const PointFile& file, LineReader& lines, const PcdHeader& header) {
  PointList points;
  // A line has at least one character and an end for each of the three numbers.
  points.reserve(std::min(header.points, file.bytes().size() / 6 + 1));
  while (points.given() < header.points) {
    if (!lines.nextFilled()) {
      lines.fail("the file ends after " + std::to_string(points.given()) + " of " +
                 std::to_string(header.points) + " points");
    }
    points.add(readRow(lines, header.columns));
  }
  if (lines.nextFilled()) {
    lines.fail("more follows after the last of " + std::to_string(header.points) + " points");
  }
  return points.finish(file.source());
}

Points collect(const PointFile& file, const std::array<CoordinateData, 3>& axes,
               std::size_t count) {
  PointList points;
  addPoints(axes, count, std::endian::little, points);
  return points.finish(file.source());
}

/// Only the file's bytes up to `end` were read. Writers that map a file into memory leave up to a
/// page of zeros after them.
void requireEnd(const PointFile& file, std::size_t end) {
  const std::size_t more = file.bytes().find_first_not_of('\0', end);
  if (more != std::string_view::npos) file.failAt(more, "more follows after the last point");
}

Points readBinary(const PointFile& file, std::size_t begin, const PcdHeader& header) {
  const std::size_t size = header.points * header.pointSize;
  if (file.bytes().size() - begin < size) {
    file.failAt(begin, std::to_string(file.bytes().size() - begin) + " bytes of data follow; " +
                           std::to_string(header.points) + " points of " +
                           std::to_string(header.pointSize) + " bytes have " +
                           std::to_string(size));
  }
  requireEnd(file, begin + size);
  std::array<CoordinateData, 3> axes;
  for (std::size_t k = 0; k < 3; ++k) {
    axes[k] = {header.axes[k].type, file.bytes().data() + begin + header.axes[k].offset,
               header.pointSize};
  }
  return collect(file, axes, header.points);
}

/// The sizes of the compressed and of the expanded data come first.
std::span<const char> compressedData(const PointFile& file, std::size_t begin,
                                     std::size_t expanded) {
  const std::size_t rest = file.bytes().size() - begin;
  constexpr std::size_t kSizes = 8;
  if (rest < kSizes) file.failAt(begin, "the file ends within the sizes of the compressed data");
  const char* const sizes = file.bytes().data() + begin;
  const std::size_t compressed = bytesAs<std::uint32_t>(sizes, std::endian::little);
  const std::size_t claimed = bytesAs<std::uint32_t>(sizes + 4, std::endian::little);
  if (compressed > rest - kSizes) {
    file.failAt(begin, "the compressed data have " + std::to_string(compressed) + " bytes, but " +
                           std::to_string(rest - kSizes) + " follow");
  }
  if (claimed != expanded) {
    file.failAt(begin + 4, "the data expand to " + std::to_string(claimed) +
                               " bytes, but the points have " + std::to_string(expanded));
  }
  if (expanded > kMaxFileBytes) {
    file.failAt(begin + 4, "the data expand to " + std::to_string(expanded) + " bytes; at most " +
                               std::to_string(kMaxFileBytes) + " are allowed");
  }
  if (expanded / kLzfRatio > compressed) {
    file.failAt(begin,
                std::to_string(compressed) + " bytes cannot expand to " + std::to_string(expanded));
  }
  requireEnd(file, begin + kSizes + compressed);
  return {sizes + kSizes, compressed};
}

/// All values of the first field, then all of the next.
Points readCompressed(const PointFile& file, std::size_t begin, const PcdHeader& header) {
  const std::size_t size = header.points * header.pointSize;
  const std::span<const char> data = compressedData(file, begin, size);
  const auto expanded = std::make_unique_for_overwrite<char[]>(size);
  if (const auto fault = expandLzf(data, {expanded.get(), size})) {
    const auto dataBegin = static_cast<std::size_t>(data.data() - file.bytes().data());
    file.failAt(dataBegin + fault->at, "broken LZF data: " + fault->what);
  }
  std::array<CoordinateData, 3> axes;
  for (std::size_t k = 0; k < 3; ++k) {
    axes[k] = {header.axes[k].type, expanded.get() + header.axes[k].offset * header.points,
               sizeOf(header.axes[k].type)};
  }
  return collect(file, axes, header.points);
}

Points readPoints(const PointFile& file, LineReader& lines, const PcdHeader& header) {
  switch (header.form) {
    case PcdForm::Ascii:
      return readAscii(file, lines, header);
    case PcdForm::Binary:
      return readBinary(file, lines.offset(), header);
    case PcdForm::Compressed:
      break;
  }
  return readCompressed(file, lines.offset(), header);
}

}  // namespace

SensedPoints readPcd(const PointFile& file) {
  LineReader lines(file);
  const PcdHeader header = readPcdHeader(lines, file.source());
  return {readPoints(file, lines, header), header.sensor};
}

}  // namespace swept::detail
