// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/problems.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <type_traits>

#include "io/json_place.hpp"
#include "io/zero_sizes.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/text_file.hpp"
#include "text/numbers.hpp"

namespace swept {

namespace {

using detail::JsonPlace;

/// x, y, z (m), and a quaternion x, y, z, w.
Eigen::Isometry3d readWholePose(const JsonPlace& place) {
  const auto p = place.numbers(7);
  const auto unit = detail::unitQuaternion({p[3], p[4], p[5], p[6]});
  if (!unit) place.fail("has a quaternion (x, y, z, w) whose length is not 1 to within 0.01");
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() << p[0], p[1], p[2];
  pose.linear() = unit->toRotationMatrix();
  return pose;
}

/// A file may keep the two poses that a body's pose is the product of. Their product must be that
/// pose.
void requireFactors(const JsonPlace& body, const Eigen::Isometry3d& pose, bool oriented) {
  constexpr double kRounding = 1e-6;  // m, and of an axis
  Eigen::Isometry3d product = Eigen::Isometry3d::Identity();
  const char* last = nullptr;
  for (const char* key : {"object_pose", "primitive_pose"}) {
    if (!body.value.is_object() || !body.value.contains(key)) continue;
    product = product * readWholePose(body.at(key));
    last = key;
  }
  if (last == nullptr) return;
  Eigen::Matrix4d difference = product.matrix() - pose.matrix();
  if (!oriented) difference.leftCols<3>().setZero();
  if (difference.cwiseAbs().maxCoeff() <= kRounding) return;
  body.at(last).fail(
      "makes another pose than position and orientation, which is object_pose times "
      "primitive_pose");
}

Eigen::Isometry3d readPose(const JsonPlace& body, bool oriented) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const auto p = body.at("position").numbers(3);
  pose.translation() << p[0], p[1], p[2];
  if (!oriented) return pose;
  const JsonPlace orientation = body.at("orientation");
  const auto q = orientation.numbers(4);
  const auto unit = detail::unitQuaternion({q[0], q[1], q[2], q[3]});
  if (!unit) {
    orientation.fail("is " + orientation.shown() +
                     "; it must be a quaternion (x, y, z, w) of length 1 to within 0.01");
  }
  pose.linear() = unit->toRotationMatrix();
  return pose;
}

Shape readSphere(const JsonPlace& body) {
  body.allowOnly({"name", "position", "orientation", "object_pose", "primitive_pose", "radius"});
  return makeSphere(body.at("radius").notNegative());
}

Shape readCylinder(const JsonPlace& body) {
  body.allowOnly(
      {"name", "position", "orientation", "object_pose", "primitive_pose", "radius", "length"});
  const double radius = body.at("radius").notNegative();
  return makeCylinder(radius, body.at("length").notNegative());
}

Shape readBox(const JsonPlace& body) {
  body.allowOnly(
      {"name", "position", "orientation", "object_pose", "primitive_pose", "half_extents"});
  const JsonPlace place = body.at("half_extents");
  const auto halves = place.elements();
  if (halves.size() != 3) place.fail("must hold 3 values");
  Eigen::Vector3d half;
  for (int axis = 0; axis < 3; ++axis) half[axis] = halves[axis].notNegative();
  return makeBox(2.0 * half);
}

World readWorld(const JsonPlace& place, std::vector<std::string>& withZeroSize) {
  struct Kind {
    const char* key;
    bool oriented;
    Shape (*read)(const JsonPlace&);
  };
  World world;
  for (const Kind& kind : {Kind{"sphere", false, readSphere}, Kind{"cylinder", true, readCylinder},
                           Kind{"box", true, readBox}}) {
    if (!place.value.is_object() || !place.value.contains(kind.key)) continue;
    for (const JsonPlace& body : place.at(kind.key).elements()) {
      const std::string name = body.at("name").text();
      if (world.find(name) != nullptr) body.fail("is a second body named '" + name + "'");
      const Shape shape = kind.read(body);
      if (detail::hasZeroSize(shape)) withZeroSize.push_back(name);
      const Eigen::Isometry3d pose = readPose(body, kind.oriented);
      requireFactors(body, pose, kind.oriented);
      world.add(name, shape, pose);
    }
  }
  place.allowOnly({"sphere", "cylinder", "box"});
  return world;
}

PlanningProblem readProblem(const std::string& set, const JsonPlace& entry) {
  PlanningProblem problem;
  problem.set = set;
  const JsonPlace index = entry.at("index");
  const double number = index.number();
  if (number != std::floor(number) || !(std::abs(number) <= 1e9)) {
    index.fail("is " + index.shown() + "; it must be a whole number");
  }
  problem.index = static_cast<int>(number);
  const JsonPlace place{
      entry.value, "set '" + set + "' problem " + std::to_string(problem.index) + ":", entry.file};
  place.allowOnly({"index", "world", "joint_names", "start", "goals", "valid"});
  const JsonPlace world = place.at("world");
  if (!world.value.is_object()) world.fail("must be an object");
  problem.world = readWorld(world, problem.withZeroSize);
  for (const JsonPlace& name : place.at("joint_names").elements()) {
    problem.jointNames.push_back(name.text());
  }
  problem.start = place.at("start").numbers(problem.jointNames.size());
  for (const JsonPlace& goal : place.at("goals").elements()) {
    problem.goals.push_back(goal.numbers(problem.jointNames.size()));
  }
  if (problem.goals.empty()) place.at("goals").fail("must hold at least one goal");
  return problem;
}

/// The names as they are given. If there are many: their number, and the two between which `wanted`
/// would stand in order.
template <typename Value>
std::string listed(std::vector<Value> values, const Value& wanted) {
  constexpr std::ptrdiff_t kMost = 10;
  const auto count = std::ssize(values);
  std::string text;
  std::ptrdiff_t first = 0;
  if (count > kMost) {
    std::ranges::sort(values);
    const auto place = std::ranges::lower_bound(values, wanted) - values.begin();
    first = std::clamp<std::ptrdiff_t>(place - kMost / 2, 0, count - kMost);
    text = std::to_string(count) + ", among them ";
  }
  for (std::ptrdiff_t i = first; i < std::min(count, first + kMost); ++i) {
    if (i > first) text += ", ";
    const Value& value = values[static_cast<std::size_t>(i)];
    if constexpr (std::is_same_v<Value, std::string>) {
      text += value;
    } else {
      text += std::to_string(value);
    }
  }
  return text;
}

}  // namespace

ProblemFile ProblemFile::load(const std::filesystem::path& json) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return load(json); });
  }
  ProblemFile result;
  result.file_ = json.string();
  const auto root = detail::parseJson(readTextFile(json), result.file_);
  if (!root.is_object() || root.empty()) {
    throw InputError(result.file_, 0, "the file must be an object of problem sets { SET: [...] }");
  }
  for (const auto& item : root.items()) {
    const std::string& set = item.key();
    const JsonPlace list{item.value(), "set '" + set + "'", result.file_};
    for (const JsonPlace& entry : list.elements()) {
      PlanningProblem problem = readProblem(set, entry);
      const int index = problem.index;
      Set& known = result.sets_[set];
      if (!known.problems.emplace(index, std::move(problem)).second)
        entry.fail("repeats the index " + std::to_string(index));
      known.indices.push_back(index);
    }
  }
  return result;
}

std::vector<std::string> ProblemFile::sets() const {
  std::vector<std::string> names;
  for (const auto& [name, ignored] : sets_) names.push_back(name);
  return names;
}

std::vector<int> ProblemFile::indices(const std::string& set) const {
  const auto found = sets_.find(set);
  return found == sets_.end() ? std::vector<int>() : found->second.indices;
}

PlanningProblem ProblemFile::problem(const std::string& set, int index) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, index] { return problem(set, index); });
  }
  const auto known = sets_.find(set);
  if (known == sets_.end()) {
    const std::string instead =
        sets_.empty() ? "the file has no problems" : "there are " + listed(sets(), set);
    throw InputError(file_, 0, "there is no set '" + set + "'; " + instead);
  }
  const auto found = known->second.problems.find(index);
  if (found != known->second.problems.end()) return found->second;
  throw InputError(file_, 0,
                   "set '" + set + "' has no problem " + std::to_string(index) + "; it has " +
                       listed(known->second.indices, index));
}

}  // namespace swept
