// SPDX-License-Identifier: BSD-3-Clause
#include "io/message_rates.hpp"

#include <cmath>
#include <cstdint>
#include <optional>

#include "text/numbers.hpp"

namespace swept::detail {

namespace {

constexpr std::int64_t kMostSeconds = INT32_MAX;
constexpr std::int64_t kMostNanoseconds = 999'999'999;

/// 0 when absent, as in ROS.
std::int64_t wholeUpTo(const YamlPlace& place, std::int64_t most) {
  if (!place.present()) return 0;
  const double value = place.number();
  if (!(value >= 0.0 && value <= static_cast<double>(most)) || value != std::floor(value))
    place.fail("is '" + place.text() + "'; it must be a whole number from 0 to " +
               std::to_string(most));
  return static_cast<std::int64_t>(value);
}

/// Fails for a rate that a planar joint does not have.
void requireInPlane(const YamlPlace& twist, double rate, const char* component) {
  constexpr double kPlane = 1e-6;  // m/s or rad/s: rounding of what a program has written
  if (!(std::abs(rate) <= kPlane))
    twist.fail("has " + std::string(component) + " " + formatNumber(rate) +
               "; a planar joint moves in linear.x, linear.y and angular.z");
}

/// The group moves joints and bases, and only one of them has rates.
[[noreturn]] void failOfOne(const YamlPlace& with, const YamlPlace& without,
                            const std::string& key) {
  without.fail("has no " + key + ", but " + with.name() + " has; both have them or none");
}

}  // namespace

double timeFromStart(const YamlPlace& point) {
  const YamlPlace duration = point.at("time_from_start");
  if (!duration.isMap()) return duration.number();
  const bool isRos1 = duration.at("secs").present() || duration.at("nsecs").present();
  const YamlPlace seconds = duration.at(isRos1 ? "secs" : "sec");
  const YamlPlace rest = duration.at(isRos1 ? "nsecs" : "nanosec");
  if (isRos1)
    duration.allowOnly({"secs", "nsecs"});
  else
    duration.allowOnly({"sec", "nanosec"});
  if (!seconds.present() && !rest.present())
    duration.fail("has no value; it must have sec and nanosec, or secs and nsecs");
  const std::string digits = std::to_string(wholeUpTo(rest, kMostNanoseconds));
  // Read as one decimal number, the time is the double nearest to it.
  return *parseNumber(std::to_string(wholeUpTo(seconds, kMostSeconds)) + "." +
                      std::string(9 - digits.size(), '0') + digits);
}

MessageRates::MessageRates(const Robot& robot, const MessagePart& part, const GroupColumns& columns,
                           std::size_t count)
    : robot_(robot),
      part_(part),
      joints_(part.points.empty() ? 0 : part.names.size()),
      count_(count),
      movesJoints_(columns.haveOfGroup(0, joints_)),
      movesBases_(columns.haveOfGroup(joints_, count)) {}

std::vector<double> MessageRates::at(std::size_t i, const std::string& key) const {
  std::vector<YamlPlace> joints, bases;
  if (!part_.points.empty()) joints = part_.points[i].at(key).elements();
  if (!part_.poses.empty()) bases = part_.poses[i].at(key).elements();
  if (joints.empty() && bases.empty()) return {};
  if (movesJoints_ && movesBases_ && joints.empty())
    failOfOne(part_.poses[i], part_.points[i], key);
  if (movesJoints_ && movesBases_ && bases.empty()) failOfOne(part_.points[i], part_.poses[i], key);
  std::vector<double> rates;
  if (!joints.empty()) {
    requireAsMany(part_.points[i], joints.size(), key, part_.names.size(), "joint_names");
    for (const YamlPlace& rate : joints) rates.push_back(rate.number());
  }
  // A part without rates moves nothing of the group: what it has is at rest.
  rates.resize(joints_, 0.0);
  if (!bases.empty()) {
    const std::vector<YamlPlace> names = part_.bases.at("joint_names").elements();
    requireAsMany(part_.poses[i], bases.size(), key, names.size(), "joint_names");
    for (std::size_t k = 0; k < bases.size(); ++k) addTwist(bases[k], names[k], rates);
  }
  rates.resize(count_, 0.0);
  return rates;
}

void MessageRates::addTwist(const YamlPlace& twist, const YamlPlace& name,
                            std::vector<double>& rates) const {
  if (!twist.isMap()) twist.fail("must be a mapping");
  twist.allowOnly({"linear", "angular"});
  const auto part = [&](const char* key) {
    const YamlPlace given = twist.at(key);
    return given.present() ? given.vector() : Eigen::Vector3d(Eigen::Vector3d::Zero());
  };
  const Eigen::Vector3d linear = part("linear");
  const Eigen::Vector3d angular = part("angular");
  const std::optional<int> joint = robot_.findJoint(name.text());
  const JointType type = joint ? robot_.joints()[*joint].type : JointType::Fixed;
  if (type == JointType::Floating)
    twist.fail("is of '" + name.text() +
               "', a floating joint, whose velocities and accelerations are not read");
  if (type != JointType::Planar) return;
  requireInPlane(twist, linear.z(), "linear.z");
  requireInPlane(twist, angular.x(), "angular.x");
  requireInPlane(twist, angular.y(), "angular.y");
  rates.insert(rates.end(), {linear.x(), linear.y(), angular.z()});
}

}  // namespace swept::detail
