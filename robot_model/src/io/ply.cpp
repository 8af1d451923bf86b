// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include "io/ply_header.hpp"
#include "io/row.hpp"

namespace swept::detail {

namespace {

std::vector<Column> columnsOf(const PlyElement& element) {
  std::vector<Column> columns;
  for (const PlyProperty& property : element.properties) {
    columns.push_back({property.name, property.axis, 1, property.lengthType.has_value()});
  }
  return columns;
}

PointList readAscii(const PointFile& file, LineReader& lines, const PlyHeader& header) {
  PointList points;
  for (const PlyElement& element : header.elements) {
    // Without properties it has no lines that could be counted.
    if (element.properties.empty()) continue;
    const std::vector<Column> columns = columnsOf(element);
    if (isVertex(element)) {
      // A line has at least one character and an end for each of the three numbers.
      points.reserve(std::min<std::uint64_t>(element.count, file.bytes().size() / 6 + 1));
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!lines.nextFilled()) {
        lines.fail("the file ends after " + std::to_string(i) + " of " +
                   std::to_string(element.count) + " elements " + shown(element.name));
      }
      const Eigen::Vector3d point = readRow(lines, columns);
      if (isVertex(element)) points.add(point);
    }
  }
  if (lines.nextFilled()) lines.fail("more follows after the last element of the header");
  return points;
}

class BinaryReader {
 public:
  BinaryReader(const PointFile& file, std::size_t begin, std::endian order)
      : file_(file), at_(begin), order_(order) {}
  PointList read(const PlyHeader& header);

 private:
  std::size_t rest() const { return file_.bytes().size() - at_; }
  /// Bytes of the property at the present place.
  std::size_t sizeHere(const PlyElement& element, const PlyProperty& property) const;
  [[noreturn]] void failEnd(const PlyElement& element) const;
  void readOneByOne(const PlyElement& element, PointList& points);
  void readEven(const PlyElement& element, std::size_t size, PointList& points);

  const PointFile& file_;
  std::size_t at_;
  std::endian order_;
};

void BinaryReader::failEnd(const PlyElement& element) const {
  file_.failAt(at_, "the file ends within " + std::to_string(element.count) + " elements " +
                        shown(element.name));
}

std::size_t BinaryReader::sizeHere(const PlyElement& element, const PlyProperty& property) const {
  if (!property.lengthType) return sizeOf(property.type);
  const std::size_t lengthSize = sizeOf(*property.lengthType);
  if (rest() < lengthSize) failEnd(element);
  const double length = decode(*property.lengthType, file_.bytes().data() + at_, order_);
  if (length < 0.0) {
    file_.failAt(at_, "the length of list " + shown(property.name) + " is " +
                          std::to_string(static_cast<std::int64_t>(length)) +
                          "; it must be at least 0");
  }
  return lengthSize + static_cast<std::size_t>(length) * sizeOf(property.type);
}

/// Every element has a property, and so takes at least one byte: the file bounds the effort.
void BinaryReader::readOneByOne(const PlyElement& element, PointList& points) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (const PlyProperty& property : element.properties) {
      const std::size_t size = sizeHere(element, property);
      if (rest() < size) failEnd(element);
      if (property.axis >= 0) {
        point[property.axis] = decode(property.type, file_.bytes().data() + at_, order_);
      }
      at_ += size;
    }
    if (isVertex(element)) points.add(point);
  }
}

/// Elements without lists have the same size.
void BinaryReader::readEven(const PlyElement& element, std::size_t size, PointList& points) {
  if (size > 0 && element.count > rest() / size) failEnd(element);
  if (isVertex(element)) {
    std::array<CoordinateData, 3> axes;
    const char* first = file_.bytes().data() + at_;
    for (const PlyProperty& property : element.properties) {
      if (property.axis >= 0) {
        axes[static_cast<std::size_t>(property.axis)] = {property.type, first, size};
      }
      first += sizeOf(property.type);
    }
    addPoints(axes, element.count, order_, points);
  }
  at_ += element.count * size;
}

PointList BinaryReader::read(const PlyHeader& header) {
  PointList points;
  for (const PlyElement& element : header.elements) {
    std::size_t size = 0;
    bool lists = false;
    for (const PlyProperty& property : element.properties) {
      size += sizeOf(property.type);
      lists = lists || property.lengthType.has_value();
    }
    if (lists) {
      readOneByOne(element, points);
    } else {
      readEven(element, size, points);
    }
  }
  if (rest() > 0) file_.failAt(at_, "more follows after the last element of the header");
  return points;
}

}  // namespace

std::vector<Eigen::Vector3d> readPly(const PointFile& file) {
  LineReader lines(file);
  const PlyHeader header = readPlyHeader(lines, file.source());
  if (header.form == PlyForm::Ascii) return readAscii(file, lines, header).finish(file.source());
  const std::endian order =
      header.form == PlyForm::LittleEndian ? std::endian::little : std::endian::big;
  return BinaryReader(file, lines.offset(), order).read(header).finish(file.source());
}

}  // namespace swept::detail
