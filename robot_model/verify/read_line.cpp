// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <string>

#include "line.hpp"
#include "rounding.hpp"

namespace swept::verify {
namespace {

/// rad. Less is not worth a word.
constexpr double kSmallTurn = 1e-6;

Eigen::Vector3d readFinite(const Json& json, const char* key, const std::string& where) {
  const Eigen::Vector3d vector = readVector(at(json, key, where), where + ", " + key);
  if (!(vector.norm() <= kLargest)) throw Refusal(where + ", " + key + ": it is too large");
  return vector;
}

void readShares(const Json& json, std::size_t segments, const std::string& where, Line& line) {
  const Json& first = at(json, "first", where);
  if (!first.is_number_unsigned() || first.get<std::size_t>() >= segments)
    throw Refusal(where + ": there is no segment " + first.dump());
  line.first = first.get<std::size_t>();
  for (const Json& share : readList(json, "shares", where))
    line.shares.push_back(readNumber(share, where + ", shares"));
  if (line.shares.size() < 2) throw Refusal(where + ": fewer than two shares");
  if (line.shares.size() - 1 > segments - line.first)
    throw Refusal(where + ": more shares than the path has states");
  if (!(line.shares.front() >= 0.0 && line.shares.back() <= 1.0))
    throw Refusal(where + ": shares are from 0 to 1");
  for (std::size_t i = 1; i < line.shares.size(); ++i)
    if (!(line.shares[i - 1] < line.shares[i])) throw Refusal(where + ": shares do not increase");
}

std::string textOf(const Line& line, const Model& model) {
  const auto pointAt = [&](double share) {
    return listText(line.begin.translation() + share * line.way);
  };
  const std::size_t last = line.first + line.shares.size() - 1;
  std::string text =
      "in segments " + std::to_string(line.first + 1) + " to " + std::to_string(last) + " point " +
      listText(line.tool.link_from_frame.translation()) + " of " + nameOf(line.tool, model) +
      " within " + briefText(line.position) + " m of the line from " +
      pointAt(line.shares.front()) + " to " + pointAt(line.shares.back());
  if (std::isinf(line.angle)) return text;
  text += ", and within " + briefText(line.angle) + " rad of its orientation there";
  if (line.turn.norm() > kSmallTurn)
    text += ", turned by " + listText((line.shares.back() - line.shares.front()) * line.turn) +
            " rad on the way";
  return text;
}

Line readLine(const Json& json, const Model& model, std::size_t segments,
              const std::string& where) {
  requireKeys(json, {"tool", "begin", "way", "turn", "first", "shares", "position", "angle"},
              where);
  Line line;
  line.tool = readFrame(json, "tool", model, where);
  if (line.tool.link < 0) throw Refusal(where + ": no link carries the tool");
  line.begin = readPose(at(json, "begin", where), where + ", begin");
  if (!(line.begin.translation().norm() <= kLargest))
    throw Refusal(where + ", begin: it is too large");
  line.way = readFinite(json, "way", where);
  line.turn = readFinite(json, "turn", where);
  readShares(json, segments, where, line);
  line.position = readMost(at(json, "position", where), where + ", position");
  line.angle = readMost(at(json, "angle", where), where + ", angle");
  line.name = "line of " + nameOf(line.tool, model);
  line.text = textOf(line, model);
  return line;
}

}  // namespace

std::vector<Line> readLines(const Json& list, const Model& model, std::size_t segments) {
  if (!list.is_array()) throw Refusal("lines: not a list");
  std::vector<Line> lines;
  for (std::size_t i = 0; i < list.size(); ++i)
    lines.push_back(readLine(list[i], model, segments, "line " + std::to_string(i + 1)));
  return lines;
}

}  // namespace swept::verify
