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
};

/// Reads the header of PCD 0.6 or 0.7 (Point Cloud Library, "The PCD file format") and leaves
/// `lines` at its last line. Throws InputError; a VIEWPOINT gives a remark.
PcdHeader readPcdHeader(LineReader& lines, const InputSource& source);

}  // namespace swept::detail
