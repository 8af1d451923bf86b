// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "bench/edges_summary.hpp"
#include "output/text_output.hpp"

namespace swept {

/// All that a run of `bench edges` found.
struct EdgeBench {
  std::string robot, group;
  double margin = 0.0, tolerance = 0.0;        ///< m
  double selfMargin = 0.0, worldMargin = 0.0;  ///< m, of the two kinds of pairs
  int passes = 0;
  double clockOverhead = 0.0;        ///< ns, left out of the times
  double loadTime = 0.0;             ///< s, of the robot's files
  std::vector<double> checkerTimes;  ///< s, one per problem
  std::vector<EdgeResult> results;   ///< in the order of the file
};

std::string benchText(const EdgeBench& bench);
Json benchJson(const EdgeBench& bench);

}  // namespace swept
