// SPDX-License-Identifier: BSD-3-Clause
#include "spheres/link_names.hpp"

#include <vector>

#include "swept/robot_model/did_you_mean.hpp"

namespace swept::detail {

std::string unknownLink(const Robot& robot, const std::string& name) {
  if (robot.findLink(name)) return {};
  std::vector<std::string> known;
  for (const Link& link : robot.links()) known.push_back(link.name);
  return "'" + name + "', which is no link of robot '" + robot.name() + "'" +
         didYouMean(name, known);
}

std::optional<std::filesystem::path> urdfOfConfiguration(const JsonValue& root) {
  if (root.has("links") || !root.has("urdf")) return {};
  return std::filesystem::path(root.file()).parent_path() / root.at("urdf").text();
}

}  // namespace swept::detail
