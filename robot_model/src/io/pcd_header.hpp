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

/// One of x, y and z: where it is, and as what.
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
  /// Where the sensor was (m, the points' frame): of VIEWPOINT.
  Eigen::Vector3d sensor = Eigen::Vector3d::Zero();
};

/// Reads the header of PCD 0.5, 0.6 or 0.7 (Point Cloud Library, "The PCD file format") and leaves
/// `lines` at its last line. What the library reads of short and old headers is read likewise: no
/// VERSION; COLUMNS for FIELDS; neither SIZE, TYPE nor COUNT, for single floats; a field of COUNT
/// 0, which is not there; no HEIGHT or 0, for 1; neither WIDTH nor HEIGHT, for POINTS. Throws
/// InputError; a VIEWPOINT that moves or turns gives a remark.
PcdHeader readPcdHeader(LineReader& lines, const InputSource& source);

}  // namespace swept::detail
