// SPDX-License-Identifier: BSD-3-Clause
#include "page/page_frames.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "kinematics/motion_model.hpp"
#include "page/page_curves.hpp"
#include "swept/robot_model/link_motion.hpp"

namespace swept {

namespace {

/// The group's frames at any values: a curve is shown where it leaves its limits, too.
class UnlimitedPoses {
 public:
  UnlimitedPoses(const Robot& robot, const Group& group, const Eigen::VectorXd& reference)
      : kinematics_(detail::compileKinematics(robot, group, reference)),
        motion_(kinematics_.bodies.size()),
        states_(kinematics_.bodies.size()) {
    for (detail::MovingBody& body : kinematics_.bodies) {
      body.lower = -std::numeric_limits<double>::infinity();
      body.upper = std::numeric_limits<double>::infinity();
    }
  }

  void moveTo(const Eigen::VectorXd& configuration) {
    const std::span<const double> q(configuration.data(), std::size_t(configuration.size()));
    detail::compileMotion(kinematics_, q, q, motion_);
    for (std::size_t body = 1; body < states_.size(); ++body)
      detail::evaluateBody(kinematics_, motion_, 0.0, static_cast<int>(body), states_);
  }
  /// model_from_link.
  Eigen::Isometry3d of(int link) const {
    const auto index = static_cast<std::size_t>(link);
    const auto body = static_cast<std::size_t>(kinematics_.bodyOfLink[index]);
    return states_[body].world_from_body * kinematics_.body_from_link[index];
  }

 private:
  detail::KinematicModel kinematics_;
  std::vector<detail::JointMotion> motion_;
  std::vector<detail::BodyState> states_;
};

void appendCurve(const Robot& robot, const Group& group, const Eigen::VectorXd& reference,
                 const PageSpan& span, PageFrames& frames) {
  UnlimitedPoses poses(robot, group, reference);
  for (int i = 0; i <= span.steps; ++i) {
    poses.moveTo(configurationAt(robot, group, *span.curve, timeAt(*span.curve, i, span.steps)));
    frames.clocks.push_back(span.clock + timeAt(*span.curve, i, span.steps));
    std::vector<Eigen::Isometry3d>& frame = frames.poses.emplace_back();
    for (const int link : frames.links) frame.push_back(poses.of(link));
  }
}

}  // namespace

const Eigen::Isometry3d& PageFrames::pose(std::size_t frame, int link) const {
  const auto place = std::ranges::find(links, link) - links.begin();
  return poses[frame][static_cast<std::size_t>(place)];
}

PageFrames framesOf(const Robot& robot, const Group& group,
                    const std::optional<Eigen::VectorXd>& reference,
                    const std::vector<PageSpan>& spans, std::vector<int> links) {
  PageFrames frames{.links = std::move(links), .poses = {}, .firstFrame = {}};
  for (const PageSpan& span : spans) {
    const std::size_t first = frames.poses.size();
    frames.firstFrame.push_back(static_cast<int>(first));
    if (span.curve != nullptr) {
      appendCurve(robot, group, reference.value_or(robot.defaultState()), span, frames);
      continue;
    }
    frames.poses.resize(first + static_cast<std::size_t>(span.steps) + 1);
    const std::size_t own = group.variables.size();
    const auto shareOf = [&span](int i) {
      return span.steps == 0 ? 0.0 : static_cast<double>(i) / span.steps;
    };
    for (int i = 0; i <= span.steps; ++i)
      frames.clocks.push_back(
          span.from.size() > own ? std::lerp(span.from[own], span.to[own], shareOf(i)) : 0.0);
    for (const int link : frames.links) {
      const std::string& name = robot.links()[static_cast<std::size_t>(link)].name;
      const LinkMotion motion(robot, group.name, name, std::span(span.from).first(own),
                              std::span(span.to).first(own), reference);
      for (int i = 0; i <= span.steps; ++i)
        frames.poses[first + static_cast<std::size_t>(i)].push_back(motion.at(shareOf(i)));
    }
  }
  return frames;
}

int piecesPerMotion(std::size_t motions) {
  constexpr int kMost = 24, kLeast = 4, kInAll = 960;
  return std::clamp(kInAll / std::max(1, static_cast<int>(motions)), kLeast, kMost);
}

}  // namespace swept
