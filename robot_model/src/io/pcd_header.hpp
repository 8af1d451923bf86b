// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "io/point_file.hpp"
#include "io/row.hpp"
#include "io/scalar.hpp"

namespace swept::detail {

enum class PcdForm : std::uint8_t { Ascii, Binary, Compressed };

/// Where x, y or z is in a point, and its type.
struct PcdAxis {
  Scalar type = Scalar::Float32;
  std::size_t offset = 0;  ///< in bytes, within a point
};

struct PcdHeader {
  PcdForm form = PcdForm::Ascii;
  std::size_t points = 0;  ///< at most kMaxPoints
  std::array<PcdAxis, 3> axes;
  std::size_t pointSize = 0;    ///< in bytes, at most kMaxFileBytes
  std::vector<Column> columns;  ///< of a point in a line of text
  /// The sensor's position (m, the points' frame), from VIEWPOINT.
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();
};

/// Reads the header of PCD 0.5, 0.6 or 0.7 (Point Cloud Library, "The PCD file format") and leaves
/// `lines` at its last line. Short and old headers are read as the library reads them: without
/// VERSION; with COLUMNS for FIELDS; without SIZE, TYPE and COUNT, which means single floats; with
/// a COUNT of 0, which means that the field is absent; with HEIGHT missing or 0, which means 1;
/// without WIDTH and HEIGHT, which POINTS replaces. Throws InputError. A VIEWPOINT that moves or
/// turns gives a remark.
PcdHeader readPcdHeader(LineReader& lines, const InputSource& source);

}  // namespace swept::detail
