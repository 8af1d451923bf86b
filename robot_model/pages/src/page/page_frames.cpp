// SPDX-License-Identifier: BSD-3-Clause
#include "page/page_frames.hpp"

#include <algorithm>

#include "swept/robot_model/link_motion.hpp"

namespace swept {

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
    frames.poses.resize(first + static_cast<std::size_t>(span.steps) + 1);
    for (const int link : frames.links) {
      const std::string& name = robot.links()[static_cast<std::size_t>(link)].name;
      const LinkMotion motion(robot, group.name, name, span.from, span.to, reference);
      for (int i = 0; i <= span.steps; ++i)
        frames.poses[first + static_cast<std::size_t>(i)].push_back(
            motion.at(span.steps == 0 ? 0.0 : static_cast<double>(i) / span.steps));
    }
  }
  return frames;
}

int piecesPerMotion(std::size_t motions) {
  constexpr int kMost = 24, kLeast = 4, kInAll = 960;
  return std::clamp(kInAll / std::max(1, static_cast<int>(motions)), kLeast, kMost);
}

}  // namespace swept
