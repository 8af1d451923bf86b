// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/point_file.hpp"
#include "io/scalar.hpp"

namespace swept::detail {

enum class PlyForm : std::uint8_t { Ascii, LittleEndian, BigEndian };

struct PlyProperty {
  std::string name;
  Scalar type = Scalar::Float32;     ///< of the value, or of each in a list
  std::optional<Scalar> lengthType;  ///< engaged for a list: of the number in front of it
  int axis = -1;                     ///< 0, 1, 2: x, y, z of the vertex; -1: anything else
  int view = -1;                     ///< 0, 1, 2: x, y, z of where the camera is; -1: other
};

struct PlyElement {
  std::string name;
  int line = 0;             ///< where the header declares it
  std::uint64_t count = 0;  ///< at most kMaxPoints for the vertex
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  PlyForm form = PlyForm::Ascii;
  std::vector<PlyElement> elements;  ///< in the order of the data
};

/// True for the element that has the points.
inline bool isVertex(const PlyElement& element) {
  return element.name == "vertex";
}

/// True for the element that has the position of the camera.
inline bool isCamera(const PlyElement& element) {
  return element.name == "camera";
}

/// Reads the header of PLY 1.0 (G. Turk, "The PLY Polygon File Format", 1994) and leaves `lines` at
/// its last line. One element is the vertex, with x, y and z. Throws InputError.
PlyHeader readPlyHeader(LineReader& lines, const InputSource& source);

}  // namespace swept::detail
