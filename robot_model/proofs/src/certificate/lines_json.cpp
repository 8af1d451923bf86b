// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/lines_json.hpp"

#include <numbers>
#include <stdexcept>
#include <string>

#include "certificate/constraints_json.hpp"
#include "certificate/model_json.hpp"
#include "kinematics/rigid_transform.hpp"
#include "line/line_model.hpp"

namespace swept {

Json linesJson(const Checker& checker, const ConstraintFrame& tool, std::span<const ToolLine> lines,
               const ToolLineOptions& options) {
  Json list = Json::array();
  std::size_t first = 0;
  for (const ToolLine& line : lines) {
    if (line.shares.size() < 2) continue;
    const detail::StraightMotion straight(line.model_from_start,
                                          detail::orthonormalized(line.model_from_goal));
    Json json = {{"tool", frameJson(tool, checker)},
                 {"begin", poseJson(line.model_from_start)},
                 {"way", toJson(straight.way)},
                 {"turn", toJson(straight.turn)},
                 {"first", first},
                 {"shares", toJson(line.shares)},
                 {"position", options.position}};
    json["angle"] = options.angle < std::numbers::pi ? Json(options.angle) : Json(nullptr);
    list.push_back(std::move(json));
    first += line.shares.size() - 1;
  }
  return list;
}

std::vector<std::vector<double>> statesOf(std::span<const ToolLine> lines) {
  if (lines.empty()) throw std::invalid_argument("a proof of no line");
  std::vector<std::vector<double>> states;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::vector<std::vector<double>>& own = lines[i].wayPoints;
    if (own.empty() || own.size() != lines[i].shares.size())
      throw std::invalid_argument("line " + std::to_string(i + 1) +
                                  " has not one share for each way point");
    if (!states.empty() && own.front() != states.back())
      throw std::invalid_argument("line " + std::to_string(i + 1) +
                                  " does not begin where the one before ends");
    states.insert(states.end(), own.begin() + (states.empty() ? 0 : 1), own.end());
  }
  return states;
}

}  // namespace swept
