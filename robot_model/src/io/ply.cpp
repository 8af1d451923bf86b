// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <optional>

#include "io/ply_header.hpp"
#include "io/row.hpp"

namespace swept::detail {

namespace {

/// Which coordinate of a vertex, or of the camera's place, it is; -1: none.
int coordinateOf(const PlyProperty& property) {
  return std::max(property.axis, property.view);
}

/// The points, and where the camera is, if there is one.
struct Seen {
  PointList points;
  std::optional<Eigen::Vector3d> camera;

  void add(const PlyElement& element, const Eigen::Vector3d& point) {
    if (isVertex(element)) points.add(point);
    if (isCamera(element)) camera = point;
  }
};

/// The position of a camera that has one; other cameras say nothing about the points.
void checkCamera(const PlyHeader& header, const InputSource& source) {
  const auto camera = std::ranges::find_if(header.elements, isCamera);
  if (camera == header.elements.end()) return;
  std::array<int, 3> given{};
  for (const PlyProperty& property : camera->properties)
    if (property.view >= 0) ++given[static_cast<std::size_t>(property.view)];
  if (given == std::array{0, 0, 0}) return;
  if (given != std::array{1, 1, 1}) {
    source.fail(camera->line,
                "the camera must have view_px, view_py and view_pz once each, or none of them");
  }
  if (camera->count > 1) {
    source.fail(camera->line, "the count of element 'camera' is '" + std::to_string(camera->count) +
                                  "'; points that one sensor saw have one");
  }
}

bool hasPlace(const PlyElement& camera) {
  return std::ranges::any_of(camera.properties,
                             [](const PlyProperty& property) { return property.view >= 0; });
}

std::vector<Column> columnsOf(const PlyElement& element) {
  std::vector<Column> columns;
  for (const PlyProperty& property : element.properties) {
    columns.push_back({property.name, coordinateOf(property), 1, property.lengthType.has_value()});
  }
  return columns;
}

Seen readAscii(const PointFile& file, LineReader& lines, const PlyHeader& header) {
  Seen seen;
  for (const PlyElement& element : header.elements) {
    // An element without properties has no lines to count.
    if (element.properties.empty()) continue;
    const std::vector<Column> columns = columnsOf(element);
    if (isVertex(element)) {
      // A line has at least one character and an end for each of the three numbers.
      seen.points.reserve(std::min<std::uint64_t>(element.count, file.bytes().size() / 6 + 1));
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (!lines.nextFilled()) {
        lines.fail("the file ends after " + std::to_string(i) + " of " +
                   std::to_string(element.count) + " elements " + shown(element.name));
      }
      seen.add(element, readRow(lines, columns));
    }
  }
  if (lines.nextFilled()) lines.fail("more follows after the last element of the header");
  return seen;
}

class BinaryReader {
 public:
  BinaryReader(const PointFile& file, std::size_t begin, std::endian order)
      : file_(file), at_(begin), order_(order) {}
  Seen read(const PlyHeader& header);

 private:
  std::size_t rest() const { return file_.bytes().size() - at_; }
  /// The bytes of the property at the present position.
  std::size_t sizeHere(const PlyElement& element, const PlyProperty& property) const;
  [[noreturn]] void failEnd(const PlyElement& element) const;
  void readOneByOne(const PlyElement& element, Seen& seen);
  void readEven(const PlyElement& element, std::size_t size, Seen& seen);

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
void BinaryReader::readOneByOne(const PlyElement& element, Seen& seen) {
  for (std::uint64_t i = 0; i < element.count; ++i) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    for (const PlyProperty& property : element.properties) {
      const std::size_t size = sizeHere(element, property);
      if (rest() < size) failEnd(element);
      if (const int axis = coordinateOf(property); axis >= 0)
        point[axis] = decode(property.type, file_.bytes().data() + at_, order_);
      at_ += size;
    }
    seen.add(element, point);
  }
}

/// Elements without lists have the same size.
void BinaryReader::readEven(const PlyElement& element, std::size_t size, Seen& seen) {
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
    addPoints(axes, element.count, order_, seen.points);
  }
  at_ += element.count * size;
}

Seen BinaryReader::read(const PlyHeader& header) {
  Seen seen;
  for (const PlyElement& element : header.elements) {
    std::size_t size = 0;
    bool lists = false;
    for (const PlyProperty& property : element.properties) {
      size += sizeOf(property.type);
      lists = lists || property.lengthType.has_value();
    }
    if (lists || (isCamera(element) && hasPlace(element))) {
      readOneByOne(element, seen);
    } else {
      readEven(element, size, seen);
    }
  }
  if (rest() > 0) file_.failAt(at_, "more follows after the last element of the header");
  return seen;
}

Seen readSeen(const PointFile& file, LineReader& lines, const PlyHeader& header) {
  if (header.form == PlyForm::Ascii) return readAscii(file, lines, header);
  const std::endian order =
      header.form == PlyForm::LittleEndian ? std::endian::little : std::endian::big;
  return BinaryReader(file, lines.offset(), order).read(header);
}

}  // namespace

SensedPoints readPly(const PointFile& file) {
  LineReader lines(file);
  const PlyHeader header = readPlyHeader(lines, file.source());
  checkCamera(header, file.source());
  Seen seen = readSeen(file, lines, header);
  SensedPoints sensed{.points = seen.points.finish(file.source())};
  const auto camera = std::ranges::find_if(header.elements, isCamera);
  if (!seen.camera || !hasPlace(*camera)) return sensed;
  sensed.sensor = *seen.camera;
  if (!sensed.sensor.allFinite())
    file.source().fail(camera->line, "view_px, view_py and view_pz of the camera must be finite");
  if (!sensed.sensor.isZero(0.0))
    file.source().warn(camera->line, "the camera " + std::string(kSensorRemark));
  return sensed;
}

}  // namespace swept::detail
