// SPDX-License-Identifier: BSD-3-Clause
#include "input/tracking.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "input/states.hpp"
#include "io/input_source.hpp"
#include "io/yaml.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/did_you_mean.hpp"
#include "swept/robot_model/text_file.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept {
namespace {

JointTolerance bothOf(double value) {
  return {.rotation = value, .translation = value};
}

double toleranceOf(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (!text.empty() && *end == '\0' && value >= 0.0 && std::isfinite(value)) return value;
  throw UsageError("--tracking: '" + text +
                   "' is no tolerance; it must be a number of rad or m that is not negative");
}

std::string unknownJoint(const std::string& name, const Robot& robot) {
  std::vector<std::string> known;
  for (const Joint& joint : robot.joints())
    if (joint.firstVariable >= 0) known.push_back(joint.name);
  return "'" + name + "', which is no joint of robot '" + robot.name() + "'" +
         didYouMean(name, known);
}

/// The controllers of a file of parameters, wherever they are in its namespaces.
class Controllers {
 public:
  Controllers(const Robot& robot, const TrackingTolerance& except)
      : robot_(robot), except_(except) {}

  TrackingTolerance read(const detail::YamlPlace& root) {
    look(root);
    if (!found_)
      root.fail(
          "has no joint_trajectory_controller: no 'ros__parameters' with 'joints' and "
          "'constraints'");
    return std::move(tracking_);
  }

 private:
  void look(const detail::YamlPlace& place) {
    if (!place.isMap()) return;
    for (const auto& [key, value] : place.entries()) {
      if (key.text() == "ros__parameters")
        lookAtParameters(value);
      else
        look(value);
    }
  }

  void lookAtParameters(const detail::YamlPlace& parameters) {
    if (!parameters.isMap()) return;
    const detail::YamlPlace joints = parameters.at("joints");
    const detail::YamlPlace constraints = parameters.at("constraints");
    if (!joints.present() || !constraints.present()) return;
    found_ = true;
    for (const detail::YamlPlace& joint : joints.elements()) add(joint, constraints);
  }

  void add(const detail::YamlPlace& joint, const detail::YamlPlace& constraints) {
    const std::string name = joint.text();
    const std::optional<int> index = robot_.findJoint(name);
    if (!index || robot_.joints()[static_cast<std::size_t>(*index)].firstVariable < 0)
      joint.fail("is " + unknownJoint(name, robot_));
    if (except_.joints.contains(name)) return;
    const detail::YamlPlace own = constraints.at(name);
    const detail::YamlPlace tolerance = own.present() ? own.at("trajectory") : own;
    const double value = tolerance.present() ? tolerance.number() : 0.0;
    if (!(value > 0.0))
      (tolerance.present() ? tolerance : joint)
          .fail("joint '" + name + "' has no tolerance 'constraints." + name +
                ".trajectory' above 0: its controller never aborts; give one with --tracking " +
                name + "=...");
    tracking_.joints[name] = bothOf(value);
  }

  const Robot& robot_;
  const TrackingTolerance& except_;
  TrackingTolerance tracking_;
  bool found_ = false;
};

TrackingTolerance readTracking(const std::string& text, const Robot& robot) {
  TrackingTolerance tracking;
  bool first = true;
  for (const std::string& piece : splitAtCommas(text)) {
    const std::size_t equal = piece.find('=');
    if (equal == std::string::npos) {
      if (!first)
        throw UsageError("--tracking: '" + piece +
                         "' is no JOINT=TOLERANCE; only the first may be a number for all joints");
      static_cast<JointTolerance&>(tracking) = bothOf(toleranceOf(piece));
    } else {
      const std::string name = piece.substr(0, equal);
      const std::optional<int> joint = robot.findJoint(name);
      if (!joint) throw UsageError("--tracking: it has " + unknownJoint(name, robot));
      if (!tracking.joints.emplace(name, bothOf(toleranceOf(piece.substr(equal + 1)))).second)
        throw UsageError("--tracking: it has joint '" + name + "' twice");
    }
    first = false;
  }
  return tracking;
}

TrackingTolerance readControllers(const std::filesystem::path& file, const Robot& robot,
                                  const TrackingTolerance& except) {
  const detail::InputSource source(file.string(), {});
  return Controllers(robot, except).read(detail::YamlPlace::parse(readTextFile(file), source));
}

}  // namespace

TrackingTolerance trackingOf(const Arguments& args, const Robot& robot) {
  const TrackingTolerance typed =
      args.tracking.empty() ? TrackingTolerance{} : readTracking(args.tracking, robot);
  if (args.controllers.empty()) return typed;
  TrackingTolerance tracking = readControllers(args.controllers, robot, typed);
  tracking.rotation = typed.rotation;
  tracking.translation = typed.translation;
  for (const auto& [name, tolerance] : typed.joints) tracking.joints[name] = tolerance;
  return tracking;
}

}  // namespace swept
