// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "swept/robot_model/problems.hpp"

namespace swept {

/// A straight motion in the world of one problem.
struct BenchEdge {
  std::string set;
  int index = 0;
  std::vector<double> from, to;  ///< rad or m, in the order of the problem's joint names
  double length = 0.0;           ///< as the file says
};

/// Reads CSV, plain or compressed with gzip, of the columns `set,index,from0,..,to0,..,length` with
/// `dimension` values each for `from` and `to`. Throws InputError, which names the line, for
/// anything else, and for a set or an index that `problems` does not have.
std::vector<BenchEdge> readBenchEdges(const std::string& file, int dimension,
                                      const ProblemFile& problems);

}  // namespace swept
