// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "io/point_file.hpp"

namespace swept::detail {

enum class OctomapForm : std::uint8_t {
  Binary,  ///< `.bt`: two bits per node
  Full,    ///< `.ot`: the log odds of each node
};

struct OctomapHeader {
  bool hasColors = false;   ///< ColorOcTree: three more bytes per node, where nodes have values
  double resolution = 0.0;  ///< m, from 1e-9 to 1e6
  std::uint64_t nodes = 0;
};

/// Leaves `lines` at the header's last line. Throws InputError.
OctomapHeader readOctomapHeader(LineReader& lines, OctomapForm form);

}  // namespace swept::detail
