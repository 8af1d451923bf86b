// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <string>
#include <vector>

#include "program.hpp"

/// `swept report`, and what its tests have in common.
namespace swept::test {

using Words = std::vector<std::string>;

/// `report` of the arm rook7, and `more`, which says where.
inline Words rook7In(const Words& more) {
  Words all{"report", "models/robots/rook7/rook7.urdf", "--group", "arm", "--passes", "1"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// So many motions among plates of 1 mm, and `more`.
inline Words rook7Report(int motions, const Words& more) {
  Words all{"--scene",       "models/scenes/tunnel_trap.yaml",
            "--motions",     std::to_string(motions),
            "--resolutions", "0.01,0.2,0.02,0.05",
            "--tolerances",  "0.1,0.001,0.01"};
  all.insert(all.end(), more.begin(), more.end());
  return rook7In(all);
}

using CsvRow = std::map<std::string, std::string>;

/// Rows by the titles of the header; cells have no quotes. Fails the test where a row has another
/// number of cells than the header.
std::vector<CsvRow> csvRows(const std::string& text);

}  // namespace swept::test
