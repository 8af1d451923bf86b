// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <string>
#include <vector>

#include "constraint.hpp"
#include "model.hpp"
#include "motion.hpp"

/// Straight lines that a tool follows in segments of a path. `lines` of a path file has them.
namespace swept::verify {

/// The line at a share s from 0 to 1: its point begin + s way, and its orientation exp([s turn])
/// that of `begin`. In the model frame. Segment `first` + i of the path is the chord from shares[i]
/// to shares[i + 1]. At each of its times t from 0 to 1
///
/// * the origin of `tool` is within `position` of the straight segment between the line's points at
///   these two shares;
/// * the orientation of `tool` is within `angle` of the line's at the share that is as far between
///   the two as t.
///
/// This is about the path itself, not about where tolerances let the joints be.
struct Line {
  Frame tool;
  Eigen::Isometry3d begin = Eigen::Isometry3d::Identity();
  Eigen::Vector3d way = Eigen::Vector3d::Zero();   ///< m
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< rad
  std::size_t first = 0;
  std::vector<double> shares;  ///< two at least, increasing
  double position = 0.0;       ///< m
  double angle = 0.0;          ///< rad; pi and more: any orientation
  std::string name;            ///< `line of hand`: for messages
  std::string text;            ///< see Summary::constraints

  bool has(std::size_t segment) const {
    return segment >= first && segment - first + 1 < shares.size();
  }
};

/// Reads `lines` of a path file with so many segments. Throws Refusal.
std::vector<Line> readLines(const Json& list, const Model& model, std::size_t segments);

/// The model with joints that have no tolerance.
Model withoutTolerances(const Model& model);

/// Shows that the tool keeps to its line during a segment, as checkConstraint() does. `motion`: of
/// that segment, in a model without tolerances.
std::size_t checkLine(const Motion& motion, const Line& line, std::size_t segment,
                      const std::string& place);

}  // namespace swept::verify
