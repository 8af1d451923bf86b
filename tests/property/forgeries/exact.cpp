// SPDX-License-Identifier: BSD-3-Clause
#include "exact.hpp"

#include <cmath>
#include <numbers>

namespace forgeries {
namespace {

Real numberOf(const Json& json) {
  return Real(json.get<double>());
}

Vec unit(const Vec& v) {
  return v * (1 / v.norm());
}

/// Rodrigues' rotation about an axis of length 1.
Pose turn(const Vec& axis, const Real& angle) {
  const Real c = cos(angle), s = sin(angle);
  Pose pose;
  for (Vec& column : pose.columns)
    column = column * c + axis.cross(column) * s + axis * (axis.dot(column) * (1 - c));
  return pose;
}

struct Quaternion {
  Real w;
  Vec v;
  Quaternion operator*(const Quaternion& o) const {
    return {w * o.w - v.dot(o.v), o.v * w + v * o.w + v.cross(o.v)};
  }
};

Quaternion quaternionOf(const Json& q, std::size_t first) {
  Quaternion result{numberOf(q[first + 3]),
                    {numberOf(q[first]), numberOf(q[first + 1]), numberOf(q[first + 2])}};
  const Real length = root(result.w * result.w + result.v.dot(result.v));
  return {result.w / length, result.v * (1 / length)};
}

/// The turn that a unit quaternion is.
Pose turnOf(const Quaternion& q) {
  const Real sine = q.v.norm();
  if (sine == 0) return {};
  return turn(q.v * (1 / sine), 2 * atan2(sine, q.w));
}

const Real& pi() {
  static const Real kValue = acos(Real(-1));
  return kValue;
}

/// Between two angles. Which way is the shorter one of two of half a turn is told by doubles, as
/// everywhere.
Real shorterWay(double from, double to) {
  const double difference = to - from;
  constexpr double kPi = std::numbers::pi;
  if (std::abs(difference) <= kPi) return Real(to) - Real(from);
  const double turns =
      std::round((difference - std::remainder(difference, 2.0 * kPi)) / (2.0 * kPi));
  return Real(to) - Real(from) - 2 * pi() * Real(turns);
}

/// What values from `first` on make of a joint that may fly.
Pose flown(const Json& from, const Json& to, std::size_t first, const Real& t) {
  const Quaternion start = quaternionOf(from, first + 3), goal = quaternionOf(to, first + 3);
  Quaternion relative = goal * Quaternion{start.w, start.v * Real(-1)};
  double product = 0.0;
  for (std::size_t i = 3; i < 7; ++i)
    product += from[first + i].get<double>() * to[first + i].get<double>();
  if (product < 0.0) relative = {-relative.w, relative.v * Real(-1)};
  const Real sine = relative.v.norm();
  Pose pose = turnOf(start);
  if (sine > 0) pose = turn(relative.v * (1 / sine), 2 * t * atan2(sine, relative.w)) * pose;
  const auto between = [&](std::size_t i) {
    return numberOf(from[first + i]) * (1 - t) + numberOf(to[first + i]) * t;
  };
  pose.translation = {between(0), between(1), between(2)};
  return pose;
}

bool crosses(const Vec& ray, const std::array<Vec, 3>& c, int& way) {
  const Real ab = ray.dot(c[0].cross(c[1])), bc = ray.dot(c[1].cross(c[2])),
             ca = ray.dot(c[2].cross(c[0]));
  way = ab > 0 ? 1 : -1;
  return (ab > 0) == (bc > 0) && (bc > 0) == (ca > 0) &&
         (c[0].dot(c[1].cross(c[2])) > 0) == (ab > 0);
}

}  // namespace

Real root(const Real& square) {
  const auto guess = square.convert_to<double>();
  if (!(guess > 1e-290 && guess < 1e290)) return sqrt(square);
  // Newton's steps double the digits: 16, 32, 64.
  Real result(std::sqrt(guess));
  for (int i = 0; i < 2; ++i) result = (result + square / result) / 2;
  return result;
}

Vec vecOf(const Json& numbers) {
  return {numberOf(numbers[0]), numberOf(numbers[1]), numberOf(numbers[2])};
}

Pose poseOf(const Json& numbers) {
  Pose pose;
  for (std::size_t i = 0; i < 3; ++i)
    pose.columns[i] = {numberOf(numbers[i]), numberOf(numbers[3 + i]), numberOf(numbers[6 + i])};
  pose.translation = {numberOf(numbers[9]), numberOf(numbers[10]), numberOf(numbers[11])};
  return pose;
}

Pose Pose::operator*(const Pose& o) const {
  return {{turned(o.columns[0]), turned(o.columns[1]), turned(o.columns[2])},
          *this * o.translation};
}

ExactMotion::ExactMotion(const Json& path, std::size_t segment)
    : model_(path["model"]), from_(path["states"][segment]), to_(path["states"][segment + 1]) {
  if (!path.contains("trajectory")) return;
  begin_ = &path["trajectory"]["points"][segment];
  end_ = &path["trajectory"]["points"][segment + 1];
}

const Json* ExactMotion::jointAbove(const std::string& link) const {
  for (const Json& joint : model_["joints"])
    if (joint["child"] == link) return &joint;
  return nullptr;
}

std::string ExactMotion::commonAncestor(const std::string& a, const std::string& b) const {
  const auto parentOf = [&](const std::string& link) -> std::string {
    const Json* joint = jointAbove(link);
    return joint == nullptr || (*joint)["parent"].is_null() ? "" : (*joint)["parent"];
  };
  for (std::string above = a;; above = parentOf(above))
    for (std::string other = b;; other = parentOf(other)) {
      if (above == other) return above;
      if (other.empty()) break;
    }
}

/// The cubic or quintic whose derivatives at both ends are the points', by its Bernstein
/// coefficients: the first ones have the derivatives at the begin, and the last ones at the end.
Real ExactMotion::valueOf(std::size_t variable, const Real& t) const {
  const Real first = numberOf(from_[variable]), last = numberOf(to_[variable]);
  const auto both = [&](const char* key) {
    return begin_ != nullptr && begin_->contains(key) && end_->contains(key);
  };
  if (!both("velocities")) return first * (1 - t) + last * t;
  const Real time = numberOf((*end_)["time"]) - numberOf((*begin_)["time"]);
  const auto rate = [&](const Json* point, const char* key) {
    return numberOf((*point)[key][variable]);
  };
  const bool quintic = both("accelerations");
  const Real step = time / (quintic ? 5 : 3);
  std::vector<Real> b{first, first + step * rate(begin_, "velocities")};
  if (quintic) {
    const Real square = time * time / 20;
    b.push_back(2 * b[1] - first + square * rate(begin_, "accelerations"));
    const Real before = last - step * rate(end_, "velocities");
    b.push_back(2 * before - last + square * rate(end_, "accelerations"));
  }
  b.push_back(last - step * rate(end_, "velocities"));
  b.push_back(last);
  for (std::size_t left = b.size() - 1; left > 0; --left)
    for (std::size_t k = 0; k < left; ++k) b[k] = b[k] * (1 - t) + b[k + 1] * t;
  return b[0];
}

Pose ExactMotion::moved(const Json& joint, const Real& t, const Errors& errors) const {
  const std::string type = joint["type"], name = joint["name"];
  const bool held = joint["variable"].is_null();
  const Json& from = held ? joint["values"] : from_;
  const Json& to = held ? joint["values"] : to_;
  if (type == "fixed") return {};
  const std::size_t first = held ? 0 : joint["variable"].get<std::size_t>();
  // Of a trajectory no value takes another way than its own.
  const auto valueAt = [&](std::size_t i, bool shorter) {
    if (held) return numberOf(from[i]);
    if (!shorter || begin_ != nullptr) return valueOf(i, t);
    return numberOf(from[i]) + t * shorterWay(from[i].get<double>(), to[i].get<double>());
  };
  const auto slide = [&] {
    return errors.slides.contains(name) ? errors.slides.at(name) : Vec{0, 0, 0};
  };
  const Real rotation = errors.rotation.contains(name) ? errors.rotation.at(name) : Real(0);
  if (type == "floating") {
    Pose pose = flown(from, to, first, t);
    pose.translation =
        Vec{valueAt(first, false), valueAt(first + 1, false), valueAt(first + 2, false)} + slide();
    if (rotation == 0) return pose;
    const Vec place = pose.translation;
    pose.translation = {0, 0, 0};
    pose = turn(errors.axes.at(name), rotation) * pose;
    pose.translation = place;
    return pose;
  }
  const Vec axis = unit(vecOf(joint["axis"]));
  if (type == "planar") {
    const Vec x = unit(vecOf(joint["planar_x"]));
    Pose pose = turn(axis, valueAt(first + 2, true) + rotation);
    pose.translation =
        x * valueAt(first, false) + axis.cross(x) * valueAt(first + 1, false) + slide();
    return pose;
  }
  const bool cyclic = !held && model_["variables"][first]["cyclic"].get<bool>();
  const Real error = held || !errors.values.contains(first) ? Real(0) : errors.values.at(first);
  const Real own = valueAt(first, cyclic) + error;
  const Real value = held ? own : numberOf(joint["multiplier"]) * own + numberOf(joint["offset"]);
  if (type != "prismatic") return turn(axis, value);
  Pose pose;
  pose.translation = axis * value;
  return pose;
}

Pose ExactMotion::placed(const std::string& link, const std::string& reference, const Real& t,
                         const Errors& errors) const {
  if (link == reference || link.empty()) return {};
  const Json* joint = jointAbove(link);
  if (joint == nullptr) return {};
  const Json& parent = (*joint)["parent"];
  return placed(parent.is_null() ? "" : parent, reference, t, errors) * poseOf((*joint)["pose"]) *
         moved(*joint, t, errors);
}

bool isInside(const Shell& shell, const Vec& point) {
  // Of no mesh an edge lies that way.
  const Vec ray{Real("0.5377130918250681"), Real("0.6193240179503791"), Real("0.5722093617734092")};
  int turns = 0;
  for (const std::array<Vec, 3>& triangle : shell) {
    int way = 0;
    if (crosses(ray, {triangle[0] - point, triangle[1] - point, triangle[2] - point}, way))
      turns += way;
  }
  return turns != 0;
}

}  // namespace forgeries
