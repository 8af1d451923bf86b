// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/problems.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include "io/input_source.hpp"
#include "io/numbers.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/foreign_text.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {

namespace {

using nlohmann::json;

/// A value of the file with the way to it, as messages name it: `set 'cage' problem 3:
/// world.box[1].name`.
struct Place {
  const json& value;
  std::string name;
  const std::string& file;

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file, 0, name + " " + message);
  }
  std::string join(const std::string& key) const {
    return name + (name.empty() ? "" : name.back() == ':' ? " " : ".") + key;
  }
  Place at(const std::string& key) const {
    if (!value.is_object()) fail("must be an object");
    const auto found = value.find(key);
    if (found == value.end()) throw InputError(file, 0, join(key) + " is missing");
    return {*found, join(key), file};
  }
  void allowOnly(std::initializer_list<std::string_view> keys) const {
    if (!value.is_object()) return;
    for (const auto& [key, ignored] : value.items()) {
      if (std::ranges::find(keys, key) != keys.end()) continue;
      std::string allowed;
      for (const std::string_view known : keys) {
        if (!allowed.empty()) allowed += known == *(keys.end() - 1) ? " and " : ", ";
        allowed += known;
      }
      fail("has the unknown key '" + key + "'; allowed are " + allowed);
    }
  }
  std::vector<Place> elements() const {
    if (!value.is_array()) fail("must be a list");
    std::vector<Place> result;
    for (std::size_t i = 0; i < value.size(); ++i) {
      result.push_back({value[i], name + "[" + std::to_string(i) + "]", file});
    }
    return result;
  }
  std::string shown() const { return foreignText(value.dump()); }
  std::string text() const {
    if (!value.is_string()) fail("is " + shown() + "; it must be text");
    return value.get<std::string>();
  }
  double number() const {
    if (!value.is_number()) fail("is " + shown() + "; it must be a finite number");
    return value.get<double>();
  }
  double positive() const {
    const double given = number();
    if (!(given > 0.0)) fail("is " + shown() + "; it must be greater than 0");
    return given;
  }
  std::vector<double> numbers(std::size_t count) const {
    const auto items = elements();
    if (items.size() != count) {
      fail("holds " + std::to_string(items.size()) + " values; it must hold " +
           std::to_string(count));
    }
    std::vector<double> values;
    for (const Place& item : items) values.push_back(item.number());
    return values;
  }
};

Eigen::Isometry3d readPose(const Place& body, bool oriented) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  const auto p = body.at("position").numbers(3);
  pose.translation() << p[0], p[1], p[2];
  if (!oriented) return pose;
  const Place orientation = body.at("orientation");
  const auto q = orientation.numbers(4);
  const auto unit = detail::unitQuaternion({q[0], q[1], q[2], q[3]});
  if (!unit) {
    orientation.fail("is " + orientation.shown() +
                     "; it must be a quaternion (x, y, z, w) of length 1 to within 0.01");
  }
  pose.linear() = unit->toRotationMatrix();
  return pose;
}

Shape readSphere(const Place& body) {
  body.allowOnly({"name", "position", "orientation", "object_pose", "primitive_pose", "radius"});
  return makeSphere(body.at("radius").positive());
}

Shape readCylinder(const Place& body) {
  body.allowOnly(
      {"name", "position", "orientation", "object_pose", "primitive_pose", "radius", "length"});
  const double radius = body.at("radius").positive();
  return makeCylinder(radius, body.at("length").positive());
}

Shape readBox(const Place& body) {
  body.allowOnly(
      {"name", "position", "orientation", "object_pose", "primitive_pose", "half_extents"});
  const Place place = body.at("half_extents");
  const auto halves = place.elements();
  if (halves.size() != 3) place.fail("must hold 3 values");
  Eigen::Vector3d half;
  for (int axis = 0; axis < 3; ++axis) half[axis] = halves[axis].positive();
  return makeBox(2.0 * half);
}

World readWorld(const Place& place) {
  struct Kind {
    const char* key;
    bool oriented;
    Shape (*read)(const Place&);
  };
  World world;
  for (const Kind& kind : {Kind{"sphere", false, readSphere}, Kind{"cylinder", true, readCylinder},
                           Kind{"box", true, readBox}}) {
    if (!place.value.is_object() || !place.value.contains(kind.key)) continue;
    for (const Place& body : place.at(kind.key).elements()) {
      const std::string name = body.at("name").text();
      if (world.find(name) != nullptr) body.fail("is a second body named '" + name + "'");
      const Shape shape = kind.read(body);
      world.add(name, shape, readPose(body, kind.oriented));
    }
  }
  place.allowOnly({"sphere", "cylinder", "box"});
  return world;
}

PlanningProblem readProblem(const std::string& set, const Place& entry) {
  PlanningProblem problem;
  problem.set = set;
  const Place index = entry.at("index");
  const double number = index.number();
  if (number != std::floor(number) || !(std::abs(number) <= 1e9)) {
    index.fail("is " + index.shown() + "; it must be a whole number");
  }
  problem.index = static_cast<int>(number);
  const Place place{entry.value, "set '" + set + "' problem " + std::to_string(problem.index) + ":",
                    entry.file};
  place.allowOnly({"index", "world", "joint_names", "start", "goals", "valid"});
  const Place world = place.at("world");
  if (!world.value.is_object()) world.fail("must be an object");
  problem.world = readWorld(world);
  for (const Place& name : place.at("joint_names").elements()) {
    problem.jointNames.push_back(name.text());
  }
  problem.start = place.at("start").numbers(problem.jointNames.size());
  for (const Place& goal : place.at("goals").elements()) {
    problem.goals.push_back(goal.numbers(problem.jointNames.size()));
  }
  if (problem.goals.empty()) place.at("goals").fail("must hold at least one goal");
  return problem;
}

/// The reason alone: the library puts its own name and place in front of it.
std::string reasonOf(const json::exception& error, const char* front) {
  const std::string what = error.what();
  const auto at = what.find(front);
  return foreignText(at == std::string::npos ? what
                                             : what.substr(at + std::string_view(front).size()));
}

/// Of two values of one key in an object the library would keep one, in silence.
class KeysOnce {
 public:
  explicit KeysOnce(const std::string& file) : file_(file) {}

  bool operator()(int /*depth*/, json::parse_event_t event, const json& parsed) {
    if (event == json::parse_event_t::object_start) open_.emplace_back();
    if (event == json::parse_event_t::object_end) open_.pop_back();
    if (event != json::parse_event_t::key) return true;
    Object& object = open_.back();
    object.key = parsed.get<std::string>();
    if (!object.known.insert(object.key).second) {
      std::string name;
      for (const Object& outer : open_) name += (name.empty() ? "" : ".") + outer.key;
      throw InputError(file_, 0, name + " is given twice");
    }
    return true;
  }

 private:
  struct Object {
    std::set<std::string> known;
    std::string key;  ///< whose value is read
  };
  const std::string& file_;
  std::vector<Object> open_;
};

json parseJson(const std::string& text, const std::string& file) {
  requireModestJson(text, file);
  KeysOnce once(file);
  try {
    return json::parse(text, std::ref(once));
  } catch (const json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw InputError(file, static_cast<int>(line), "malformed JSON: " + reasonOf(error, ": "));
  } catch (const json::exception& error) {  // a number beyond every double
    throw InputError(file, 0, "malformed JSON: " + reasonOf(error, "] "));
  }
}

/// As they are given; of many their number, and those on either side of where `wanted` would stand
/// in order.
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
  const auto root = parseJson(readTextFile(json), result.file_);
  if (!root.is_object() || root.empty()) {
    throw InputError(result.file_, 0, "the file must be an object of problem sets { SET: [...] }");
  }
  for (const auto& item : root.items()) {
    const std::string& set = item.key();
    const Place list{item.value(), "set '" + set + "'", result.file_};
    for (const Place& entry : list.elements()) {
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
