// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <span>

#include "info/info.hpp"
#include "input/states.hpp"
#include "output/robot_json.hpp"
#include "output/shape_summary.hpp"
#include "output/terminal_text.hpp"
#include "output/text_table.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept {
namespace {

std::string baseName(const std::string& file) {
  return file.substr(file.find_last_of('/') + 1);
}

/// Of a length in mm or a time in ms.
std::string milli(double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.1f", 1e3 * value);
  return text.data();
}

/// The finest level of the cover of each geometry, its inner balls and the time it took.
std::string linkTable(const Robot& robot) {
  TextTable table({{"link"},
                   {"collision geometry"},
                   {"balls", true},
                   {"overhang", true},
                   {"inner", true},
                   {"built in", true},
                   {"file"}});
  int balls = 0;
  std::size_t inner = 0;
  double seconds = 0.0;
  for (const Link& link : robot.links())
    for (const CollisionGeometry& geometry : link.collision) {
      const bool first = &geometry == &link.collision.front();
      const bool mesh = std::holds_alternative<TriangleMesh>(geometry.shape);
      std::vector<std::string> row{first ? link.name : "", shapeText(geometry.shape)};
      if (geometry.cover != nullptr) {
        const SphereCover::Level& finest = geometry.cover->levels.back();
        balls += finest.ballCount;
        inner += geometry.cover->inner.size();
        seconds += geometry.coverSeconds;
        row.insert(row.end(),
                   {std::to_string(finest.ballCount), milli(finest.largestOverhang) + " mm",
                    std::to_string(geometry.cover->inner.size()),
                    geometry.coverSeconds > 0.0 ? milli(geometry.coverSeconds) + " ms" : "shared"});
      } else {
        row.insert(row.end(), 4, "");
      }
      row.push_back(mesh ? baseName(geometry.source) : "");
      table.add(std::move(row));
    }
  return table.text() + "covers: " + std::to_string(balls) + " balls, " + std::to_string(inner) +
         " inner balls, built in " + milli(seconds) + " ms\n";
}

std::string mimicText(const Robot& robot, const Mimic& mimic) {
  std::string text = shortNumber(mimic.multiplier) + " * " + robot.joints()[mimic.master].name;
  if (mimic.offset != 0.0)
    text += (mimic.offset > 0.0 ? " + " : " - ") + shortNumber(std::abs(mimic.offset));
  return "= " + text;
}

std::string jointTable(const Robot& robot) {
  TextTable table({{"joint"}, {"type"}, {"lower", true}, {"upper", true}, {"unit"}});
  for (const Joint& joint : robot.joints()) {
    const std::string type(toString(joint.type));
    if (joint.mimic) {
      table.add({joint.name, type, "", "", mimicText(robot, *joint.mimic)});
    } else if (joint.firstVariable < 0) {
      table.add({joint.name, type, "", "", ""});
    }
    const int index = static_cast<int>(&joint - robot.joints().data());
    for (const Variable& variable : robot.variables())
      if (variable.joint == index)
        table.add({variable.name, type, shortNumber(variable.lower), shortNumber(variable.upper),
                   unitOf(robot, variable) + (variable.cyclic ? ", cyclic" : "")});
  }
  return table.text();
}

std::string groupTable(const Robot& robot) {
  TextTable table({{"group"}, {"tip"}, {"named states"}, {"variables"}});
  for (const Group& group : robot.groups()) {
    std::vector<std::string> states;
    for (const NamedState& state : robot.namedStates())
      if (state.group == group.name) states.push_back(state.name);
    table.add({group.name, group.tipLink < 0 ? "" : robot.links()[group.tipLink].name,
               joined(states), joined(variableNames(robot, group), ",")});
  }
  return table.text();
}

std::string worldTable(const World& world) {
  TextTable table({{"world body"}, {"geometry"}});
  for (const WorldBody& body : world.bodies())
    for (const WorldBody::Part& part : body.parts)
      table.add({&part == &body.parts.front() ? body.name : "", shapeText(part.shape)});
  for (const MovingObstacle& body : world.obstacles())
    for (const MovingObstacle::Part& part : body.parts)
      table.add({&part == &body.parts.front() ? body.name : "",
                 shapeText(part.shape) + ", moves from " +
                     shortNumber(body.waypoints.front().time) + " to " +
                     shortNumber(body.waypoints.back().time) + " s"});
  return table.text();
}

std::string count(std::size_t number, const std::string& one, const std::string& many) {
  return std::to_string(number) + " " + (number == 1 ? one : many);
}

/// `adjacent: joint NAME` is a reason of its own for every pair; the joint goes.
std::string shortReason(const std::string& reason) {
  return reason.starts_with("adjacent") ? "adjacent" : reason;
}

/// `(2): a - b, c - d`; of many the first, unless all are asked for.
std::string listText(const std::vector<std::string>& pairs, bool all) {
  constexpr std::size_t kMany = 60, kShown = 20;
  const std::string count = "(" + std::to_string(pairs.size()) + "): ";
  if (all || pairs.size() <= kMany) return count + joined(pairs);
  return count + joined(std::span(pairs).first(kShown)) + ", and " +
         std::to_string(pairs.size() - kShown) + " more (--verbose names them)";
}

/// Pairs are many; their reasons are few.
std::string pairText(const Checker& checker, bool all) {
  std::size_t selfPairs = 0;
  for (const Checker::Pair& pair : checker.checkedPairs()) selfPairs += pair.selfPair ? 1 : 0;
  std::string text = "group " + escapedLine(checker.group().name) + " checks " +
                     count(checker.checkedPairs().size(), "pair", "pairs") + ": " +
                     std::to_string(checker.checkedPairs().size() - selfPairs) +
                     " of a link with a world body, " + std::to_string(selfPairs) +
                     " of two links\n";
  std::map<std::pair<double, std::string>, std::vector<std::string>> byMargin;
  for (const Checker::Pair& pair : checker.checkedPairs())
    byMargin[{pair.margin, pair.reason}].push_back(escapedLine(pair.bodyA + " - " + pair.bodyB));
  for (const auto& [how, pairs] : byMargin)
    text += "checked, more than " + shortNumber(how.first) + " m apart" +
            (how.second.empty() ? " " : ", " + how.second + " ") + listText(pairs, all) + "\n";
  std::map<std::string, std::vector<std::string>> byReason;
  for (const Checker::Pair& pair : checker.skippedPairs())
    byReason[shortReason(pair.reason)].push_back(escapedLine(pair.bodyA + " - " + pair.bodyB));
  for (const auto& [reason, pairs] : byReason)
    text += "not checked, " + reason + " " + listText(pairs, all) + "\n";
  for (const Checker::Pair& pair : checker.staticContacts())
    text += "standing contact: " + escapedLine(pair.bodyA + " - " + pair.bodyB) + "\n";
  return text;
}

}  // namespace

std::string infoText(const Arguments& args, const Model& model, const Checker* checker) {
  const Robot& robot = *model.robot;
  const auto withGeometry = std::ranges::count_if(
      robot.links(), [](const Link& link) { return !link.collision.empty(); });
  std::string text = escapedLine("robot " + robot.name() + " from " + args.robot) + "\n";
  text += model.srdf.file.empty()
              ? "no SRDF\n"
              : escapedLine("SRDF " + model.srdf.file) +
                    (model.srdf.foundBesideUrdf ? " (found beside the URDF)\n" : "\n");
  text += count(robot.links().size(), "link", "links") + ", " + std::to_string(withGeometry) +
          " with collision geometry; " + count(robot.joints().size(), "joint", "joints") + ", " +
          count(robot.variables().size(), "variable", "variables") + "; " +
          count(robot.disabledPairs().size(), "pair", "pairs") + " disabled by the SRDF\n";
  text += "\n" + linkTable(robot) + "\n" + jointTable(robot) + "\n" + groupTable(robot);
  const std::size_t bodies = model.world->bodies().size() + model.world->obstacles().size();
  if (bodies > 0 || !args.scene.empty())
    text += "\n" + (args.scene.empty() ? "world" : escapedLine("scene " + args.scene)) + ": " +
            count(bodies, "body", "bodies") + "\n" + worldTable(*model.world);
  if (checker == nullptr) return text;
  text.append("\n").append(pairText(*checker, args.verbose));
  for (const std::string& sentence : explanations(args, *checker))
    text.append(escapedLine(sentence)).append("\n");
  return text;
}

}  // namespace swept
