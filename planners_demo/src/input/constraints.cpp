// SPDX-License-Identifier: BSD-3-Clause
#include "input/constraints.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "input/poses.hpp"
#include "input/states.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/did_you_mean.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept {
namespace {

constexpr double kDegrees = 5.0;         // of a tilt that nothing is said about
constexpr double kStayTolerance = 5e-3;  // m, likewise of a line or a plane
constexpr double kRadPerDegree = std::numbers::pi / 180.0;

/// One option as typed: the pieces between colons, the first of which is a link.
class TypedConstraint {
 public:
  TypedConstraint(const char* option, std::string text, const char* form, const Checker& checker)
      : label_(std::string(option) + " '" + text + "'"), form_(form) {
    std::size_t begin = 0;
    for (std::size_t colon = 0; colon != std::string::npos; begin = colon + 1) {
      colon = text.find(':', begin);
      pieces_.push_back(text.substr(begin, colon - begin));
    }
    requireLink(checker);
  }

  const std::string& label() const { return label_; }
  const std::string& link() const { return pieces_.front(); }
  std::size_t count() const { return pieces_.size(); }
  const std::string& piece(std::size_t i) const { return pieces_[i]; }
  [[noreturn]] void fail() const { throw UsageError(label_ + ": expected " + form_); }
  void requireCount(std::size_t least, std::size_t most) const {
    if (count() < least || count() > most) fail();
  }
  std::vector<double> numbers(const std::string& text,
                              const std::vector<std::string>& names) const {
    return readValues(text, names, label_);
  }
  /// Or `otherwise`, where there is no such piece.
  double number(std::size_t i, const std::string& name, double otherwise) const {
    if (i >= count()) return otherwise;
    const double value = numbers(pieces_[i], {name})[0];
    if (value >= 0.0) return value;
    throw UsageError(label_ + ": " + name + " is " + shortNumber(value) + ", allowed is from 0");
  }

 private:
  void requireLink(const Checker& checker) const {
    std::vector<std::string> known;
    for (const Link& other : checker.robot().links()) known.push_back(other.name);
    for (const AttachedBody& body : checker.options().attached) known.push_back(body.name);
    if (std::ranges::find(known, link()) == known.end())
      throw UsageError(label_ + ": robot '" + checker.robot().name() +
                       "' has no link or attached body '" + link() + "'" +
                       didYouMean(link(), known));
  }

  std::string label_;
  const char* form_;
  std::vector<std::string> pieces_;
};

TaskConstraint uprightOf(const TypedConstraint& typed) {
  static const std::map<std::string, Eigen::Vector3d> kAxes{{"x", {1, 0, 0}},   {"y", {0, 1, 0}},
                                                            {"z", {0, 0, 1}},   {"-x", {-1, 0, 0}},
                                                            {"-y", {0, -1, 0}}, {"-z", {0, 0, -1}}};
  typed.requireCount(1, 3);
  const double angle = typed.number(1, "degrees", kDegrees) * kRadPerDegree;
  const auto axis = kAxes.find(typed.count() > 2 ? typed.piece(2) : "z");
  if (axis == kAxes.end()) typed.fail();
  return TaskConstraint::upright(typed.link(), angle, axis->second);
}

/// The pose of a link, or of that which carries a body.
Eigen::Isometry3d poseOf(const Checker& checker, const std::string& name,
                         std::span<const double> start) {
  std::string link = name;
  for (const AttachedBody& body : checker.options().attached)
    if (body.name == name && !checker.robot().findLink(name)) link = body.link;
  const std::size_t values = checker.group().variables.size();
  return linkPose(checker.robot(), checker.group().name, link, start.first(values),
                  checker.options().reference);
}

TaskConstraint levelOf(const TypedConstraint& typed, const Checker& checker,
                       std::span<const double> start) {
  typed.requireCount(1, 2);
  return TaskConstraint::level(typed.link(), poseOf(checker, typed.link(), start),
                               typed.number(1, "degrees", kDegrees) * kRadPerDegree);
}

TaskConstraint regionOf(const TypedConstraint& typed) {
  typed.requireCount(3, 3);
  const std::string& text = typed.piece(2);
  const std::size_t at = text.find('@');
  const std::string sizes = text.substr(0, at);
  ConstraintRegion region;
  if (typed.piece(1) == "box") {
    const auto v = typed.numbers(sizes, {"x", "y", "z"});
    region.size = {v[0], v[1], v[2]};
  } else if (typed.piece(1) == "sphere") {
    region.type = ConstraintRegion::Type::Sphere;
    region.size.x() = typed.numbers(sizes, {"radius"})[0];
  } else if (typed.piece(1) == "cylinder") {
    region.type = ConstraintRegion::Type::Cylinder;
    const auto v = typed.numbers(sizes, {"radius", "length"});
    region.size.head<2>() << v[0], v[1];
  } else {
    typed.fail();
  }
  if (region.size.minCoeff() < 0.0)
    throw UsageError(typed.label() + ": a size is " + shortNumber(region.size.minCoeff()) +
                     ", allowed is from 0 m");
  if (at != std::string::npos)
    region.reference_from_region = readPlace(text.substr(at + 1), typed.label());
  return {.positions = {{.frame = {.body = typed.link()}, .regions = {region}}}};
}

TaskConstraint lineOrPlaneOf(const TypedConstraint& typed) {
  typed.requireCount(3, 4);
  const auto v = typed.numbers(typed.piece(2), {"x", "y", "z", "dx", "dy", "dz"});
  const Eigen::Vector3d origin(v[0], v[1], v[2]), direction(v[3], v[4], v[5]);
  if (direction.isZero(0.0)) throw UsageError(typed.label() + ": the direction 0,0,0 is none");
  const double tolerance = typed.number(3, "tolerance", kStayTolerance);
  if (typed.piece(1) == "line")
    return TaskConstraint::onLine(typed.link(), origin, direction, tolerance);
  if (typed.piece(1) == "plane")
    return TaskConstraint::onPlane(typed.link(), origin, direction, tolerance);
  typed.fail();
}

}  // namespace

TaskConstraint constraintsOf(const Arguments& args, const Checker& checker,
                             std::span<const double> start) {
  TaskConstraint all;
  for (const std::string& text : args.keepUpright)
    all.add(uprightOf(
        {"--keep-upright", text, "LINK[:DEG[:AXIS]] with x, y, z, -x, -y or -z", checker}));
  for (const std::string& text : args.keepLevel)
    all.add(levelOf({"--keep-level", text, "LINK[:DEG]", checker}, checker, start));
  for (const std::string& text : args.stayIn)
    all.add(regionOf({"--stay-in", text,
                      "LINK:box:X,Y,Z, LINK:sphere:R or LINK:cylinder:R,L, each with "
                      "@X,Y,Z[,QX,QY,QZ,QW] or without",
                      checker}));
  for (const std::string& text : args.stayOn)
    all.add(
        lineOrPlaneOf({"--stay-on", text,
                       "LINK:line:X,Y,Z,DX,DY,DZ[:M] or LINK:plane:X,Y,Z,NX,NY,NZ[:M]", checker}));
  return all;
}

std::shared_ptr<const Checker> withConstraintsOf(const Arguments& args,
                                                 std::shared_ptr<const Checker> checker,
                                                 std::span<const double> start,
                                                 const TaskConstraint& others) {
  TaskConstraint all = constraintsOf(args, *checker, start);
  all.add(others);
  if (all.empty()) return checker;
  if (!args.dump.empty())
    throw UsageError("--dump: the files that it writes hold no constraints; leave one of them out");
  try {
    return std::make_shared<const Checker>(checker->withConstraints(std::move(all)));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

}  // namespace swept
