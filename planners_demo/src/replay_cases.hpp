// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "swept/core/shapes.hpp"

/// Cases of two shapes with a known answer, read from JSON; planners_demo/README.md has the format.
namespace swept {

enum class PairQuery {
  SignedDistance,  ///< m, negative: length of the shortest separating translation
  Distance,        ///< m, 0 in overlap
  Collide,         ///< yes or no
};

/// Two shapes, and what is true about them.
struct PairQuestion {
  PairQuery query;
  Shape a, b;
  Eigen::Isometry3d a_from_b;
  double scale;              ///< m, largest of the shapes' extents (finite) and their offset
  double distance = 0.0;     ///< m, the true answer; 0 for Collide
  double tolerance = 0.0;    ///< m, of the answer; 0 for Collide
  std::optional<bool> hits;  ///< the true answer of Collide; empty: both are right (touching)
};

/// An entry of the file: a question, or the reason why this program does not answer it.
struct ReplayCase {
  std::string id;
  std::string query;                     ///< as the file names it
  std::optional<PairQuestion> question;  ///< empty: skipped
  std::string skipReason;                ///< `query ccd`, `shape robot`; empty with a question
};

/// Throws InputError, which names the case, the key, its value and what is allowed.
std::vector<ReplayCase> readReplayCases(const std::string& file);

}  // namespace swept
