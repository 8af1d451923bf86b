// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "swept/robot_model/piecewise_polynomial.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// A motion that is drawn as `steps` + 1 frames, kFramesPerPiece for each of its parts. With 0
/// steps it is a state, and `to` is `from`.
struct PageSpan {
  /// Configurations as the checker takes them: with the time of moving obstacles, unless it is a
  /// curve.
  std::vector<double> from, to;
  int steps = 0;
  const PiecewisePolynomial* curve = nullptr;  ///< from one to the other; null: straight
  double clock = 0.0;  ///< s, what that of moving obstacles shows at the curve's time 0
};

/// Poses of links, frame by frame.
struct PageFrames {
  std::vector<int> links;                             ///< indices, in the order of each frame
  std::vector<std::vector<Eigen::Isometry3d>> poses;  ///< model_from_link: [frame][link]
  std::vector<int> firstFrame;                        ///< per span
  std::vector<double> clocks = {};  ///< s, of moving obstacles, per frame; 0 without one

  /// model_from_link of a link that is among `links`.
  const Eigen::Isometry3d& pose(std::size_t frame, int link) const;
};

/// The frames of all spans, one after the other. The parameter t of a motion, or the time of a
/// curve, advances evenly from frame to frame, and the poses are those that the checker checks.
/// `reference` is as LinkMotion takes it. Values of a curve may be beyond their limits.
PageFrames framesOf(const Robot& robot, const Group& group,
                    const std::optional<Eigen::VectorXd>& reference,
                    const std::vector<PageSpan>& spans, std::vector<int> links);

/// How many parts of each motion are certified by themselves, for this many motions: few enough for
/// the page to stay small.
int piecesPerMotion(std::size_t motions);
/// Frames within a part: a browser draws what is between two of them on straight lines.
inline constexpr int kFramesPerPiece = 2;

}  // namespace swept
