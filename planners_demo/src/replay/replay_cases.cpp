// SPDX-License-Identifier: BSD-3-Clause
#include "replay/replay_cases.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <variant>

#include "io/json_value.hpp"
#include "replay/replay_shapes.hpp"

namespace swept {
namespace {

/// Of a rotation's columns. Poses printed with few digits are meant as they are; a scaling or a
/// mirror image is another shape.
constexpr double kOrthonormal = 1e-6;

const std::map<std::string, PairQuery> kQueries = {
    {"signed_distance", PairQuery::SignedDistance},
    {"penetration", PairQuery::SignedDistance},
    {"contact", PairQuery::SignedDistance},
    {"distance", PairQuery::Distance},
    {"collide", PairQuery::Collide},
    {"ccd", PairQuery::FirstContact},
};

using MakeMotion = UniformMotion (*)(const Eigen::Isometry3d&, const Eigen::Isometry3d&);
const std::map<std::string, MakeMotion> kInterpolations = {
    {"linear translation, constant rotation",
     [](const Eigen::Isometry3d& start, const Eigen::Isometry3d& end) {
       return UniformMotion::translation(start, end.translation() - start.translation());
     }},
    {"linear translation, slerp",
     [](const Eigen::Isometry3d& start, const Eigen::Isometry3d& end) {
       return UniformMotion::interpolation(start, end);
     }},
    {"screw", [](const Eigen::Isometry3d& start, const Eigen::Isometry3d& end) {
       return UniformMotion::screw(start, end);
     }}};
const std::string kStraight = "linear translation, constant rotation";

Eigen::Matrix4d readTransform(const JsonValue& place) {
  Eigen::Matrix4d matrix;
  const auto rows = place.elements(4);
  for (int r = 0; r < 4; ++r) {
    const auto row = rows[r].elements(4);
    for (int c = 0; c < 4; ++c) matrix(r, c) = row[c].number();
  }
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) rows[3].refuse("[0, 0, 0, 1]");
  const Eigen::Matrix3d linear = matrix.topLeftCorner<3, 3>();
  const Eigen::Matrix3d gram = linear.transpose() * linear;
  const double error = (gram - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= kOrthonormal && linear.determinant() > 0.0))
    place.fail(
        "does not turn and move only: its first three columns must be orthonormal to 1e-6, "
        "with determinant 1");
  return matrix;
}

/// inverse(A) * B as affine maps: a transpose would put the rounding of A's columns into the pose.
/// The translations are subtracted first, which keeps the digits of two shapes far from the origin.
Eigen::Isometry3d relativePose(const Eigen::Matrix4d& world_from_a,
                               const Eigen::Matrix4d& world_from_b) {
  const Eigen::Matrix3d a_from_world = world_from_a.topLeftCorner<3, 3>().inverse();
  const Eigen::Vector3d offset =
      world_from_b.topRightCorner<3, 1>() - world_from_a.topRightCorner<3, 1>();
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  a_from_b.linear() = a_from_world * world_from_b.topLeftCorner<3, 3>();
  a_from_b.translation() = a_from_world * offset;
  return a_from_b;
}

/// m. How far numbers about the shape reach: of planes and half-spaces, their offset.
double extent(const Shape& shape) {
  if (const auto* plane = std::get_if<Plane>(&shape)) return std::abs(plane->offset);
  if (const auto* halfSpace = std::get_if<HalfSpace>(&shape)) return std::abs(halfSpace->offset);
  const BoundingSphere ball = boundingSphere(shape);
  return ball.center.stableNorm() + ball.radius;
}

/// `collides` decides, where it is given, else `state`.
std::optional<bool> readHits(const JsonValue& expected) {
  if (!expected.has("state")) return expected.at("collides").boolean();
  const JsonValue place = expected.at("state");
  const std::string state = place.text();
  if (state == "touching") return std::nullopt;
  if (state != "separated" && state != "penetrating")
    place.refuse("separated, touching or penetrating");
  const bool hits = state == "penetrating";
  if (expected.has("collides") && expected.at("collides").boolean() != hits)
    expected.at("collides").fail("contradicts the state");
  return hits;
}

std::string interpolationOf(const JsonValue& motion) {
  return motion.has("interpolation") ? motion.at("interpolation").text() : kStraight;
}

UniformMotion readMotion(const JsonValue& place) {
  const std::string interpolation = interpolationOf(place);
  const Eigen::Isometry3d start(readTransform(place.at("start")));
  const Eigen::Isometry3d end(readTransform(place.at("end")));
  if (interpolation == kStraight && !start.linear().isApprox(end.linear(), kOrthonormal))
    place.at("end").fail("turns, which '" + kStraight + "' does not");
  return kInterpolations.at(interpolation)(start, end);
}

PairQuestion readFirstContact(const JsonValue& entry) {
  const auto shapes = entry.at("shapes").elements();
  PairQuestion question{.query = PairQuery::FirstContact,
                        .a = readReplayShape(shapes[0]),
                        .b = readReplayShape(shapes[1])};
  question.scale = std::max(extent(question.a), extent(question.b));
  for (const JsonValue& motion : entry.at("motions").elements(2)) {
    question.motions.push_back(readMotion(motion));
    for (const double t : {0.0, 1.0})
      question.scale = std::max(question.scale, question.motions.back().at(t).translation().norm());
  }
  const JsonValue expected = entry.at("expected");
  question.hits = expected.at("collides").boolean();
  question.tolerance = expected.at("tolerance").notNegative();
  if (*question.hits) question.expected = expected.at("time_of_contact").notNegative();
  return question;
}

PairQuestion readQuestion(PairQuery query, const JsonValue& entry) {
  if (query == PairQuery::FirstContact) return readFirstContact(entry);
  const auto shapes = entry.at("shapes").elements();
  const auto transforms = entry.at("transforms").elements(2);
  PairQuestion question{
      .query = query,
      .a = readReplayShape(shapes[0]),
      .b = readReplayShape(shapes[1]),
      .a_from_b = relativePose(readTransform(transforms[0]), readTransform(transforms[1]))};
  question.scale = std::max(
      {extent(question.a), extent(question.b), question.a_from_b.translation().stableNorm()});
  const JsonValue expected = entry.at("expected");
  if (query == PairQuery::Collide) {
    question.hits = readHits(expected);
    return question;
  }
  const double distance = expected.at("signed_distance").number();
  question.expected = query == PairQuery::Distance ? std::max(0.0, distance) : distance;
  question.tolerance = expected.at("tolerance").notNegative();
  return question;
}

/// Why the case is skipped; empty when it is not.
std::string unsupported(const std::string& query, const JsonValue& entry) {
  if (!kQueries.contains(query)) return "query " + query;
  const auto shapes = entry.at("shapes").elements(2);
  for (const JsonValue& shape : shapes) {
    const std::string type = shape.at("type").text();
    if (!isReplayShape(type)) return "shape " + type;
  }
  if (kQueries.at(query) != PairQuery::FirstContact) return {};
  for (const JsonValue& motion : entry.at("motions").elements(2)) {
    const std::string interpolation = interpolationOf(motion);
    if (!kInterpolations.contains(interpolation)) return "interpolation " + interpolation;
  }
  return {};
}

ReplayCase readCase(const JsonValue& entry) {
  ReplayCase result;
  result.id = entry.at("id").text();
  const JsonValue place = entry.renamed("case '" + result.id + "':");
  result.query = place.at("query").text();
  if (isRobotQuery(result.query)) {
    result.robot = readRobotQuestion(result.query, place);
    return result;
  }
  result.skipReason = unsupported(result.query, place);
  if (result.skipReason.empty()) result.pair = readQuestion(kQueries.at(result.query), place);
  return result;
}

}  // namespace

void forEachReplayCase(const std::string& file,
                       const std::function<void(const ReplayCase&)>& visit) {
  const nlohmann::json root = JsonValue::parseFile(file);
  const JsonValue top(root, "", file);
  if (!root.is_object()) top.renamed("the file").fail("must be an object with the key 'cases'");
  if (top.has("version") && root["version"] != 1) top.at("version").refuse("1");
  std::set<std::string> ids;
  for (const JsonValue& entry : top.at("cases").elements()) {
    const ReplayCase item = readCase(entry);
    if (!ids.insert(item.id).second) entry.at("id").fail("repeats '" + item.id + "'");
    visit(item);
  }
}

}  // namespace swept
