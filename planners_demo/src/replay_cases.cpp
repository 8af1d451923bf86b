// SPDX-License-Identifier: BSD-3-Clause
#include "replay_cases.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "json_value.hpp"

namespace swept {
namespace {

/// Of a rotation's columns. Poses printed with few digits are meant as they are; a scaling or a
/// mirror image is another shape.
constexpr double kOrthonormal = 1e-6;

std::vector<Eigen::Vector3d> readPoints(const JsonValue& place) {
  std::vector<Eigen::Vector3d> points;
  for (const JsonValue& item : place.elements()) points.push_back(item.vector3());
  if (points.empty()) place.fail("must hold at least one point");
  return points;
}

Eigen::Vector3d readSize(const JsonValue& shape) {
  const JsonValue place = shape.at("size");
  Eigen::Vector3d size;
  int axis = 0;
  for (const JsonValue& item : place.elements(3)) size[axis++] = item.notNegative();
  return size;
}

/// Corner i is at + where bit k of i is set, along axis k.
Shape meshBox(const Eigen::Vector3d& size) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(
        0.5 * size.cwiseProduct(Eigen::Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1)));
  std::vector<TriangleMesh::Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis) {
    const int normal = 1 << axis, u = 1 << (axis + 1) % 3, v = 1 << (axis + 2) % 3;
    triangles.insert(triangles.end(), {{0, v, u + v},
                                       {0, u + v, u},
                                       {normal, normal + u, normal + u + v},
                                       {normal, normal + u + v, normal + v}});
  }
  return TriangleMesh::build(corners, triangles);
}

Shape readTriangle(const JsonValue& shape) {
  const JsonValue place = shape.at("vertices");
  place.elements(3);
  return ConvexHull::of(readPoints(place));
}

Shape readMeshBox(const JsonValue& shape) {
  const Eigen::Vector3d size = readSize(shape);
  if (!(size.minCoeff() > 0.0)) shape.at("size").refuse("greater than 0");
  return meshBox(size);
}

using ShapeReader = Shape (*)(const JsonValue&);
const std::map<std::string, ShapeReader> kShapes = {
    {"box", [](const JsonValue& s) -> Shape { return makeBox(readSize(s)); }},
    {"sphere",
     [](const JsonValue& s) -> Shape { return makeSphere(s.at("radius").notNegative()); }},
    {"cylinder",
     [](const JsonValue& s) -> Shape {
       const double radius = s.at("radius").notNegative();
       return makeCylinder(radius, s.at("length").notNegative());
     }},
    {"capsule",
     [](const JsonValue& s) -> Shape {
       const double radius = s.at("radius").notNegative();
       return makeCapsule(radius, s.at("length").notNegative());
     }},
    {"convex",
     [](const JsonValue& s) -> Shape { return ConvexHull::of(readPoints(s.at("vertices"))); }},
    {"triangle", readTriangle},
    {"mesh_box", readMeshBox},
};

const std::map<std::string, PairQuery> kQueries = {
    {"signed_distance", PairQuery::SignedDistance},
    {"penetration", PairQuery::SignedDistance},
    {"contact", PairQuery::SignedDistance},
    {"distance", PairQuery::Distance},
    {"collide", PairQuery::Collide},
};

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

double extent(const Shape& shape) {
  const BoundingSphere ball = boundingSphere(shape);
  return ball.center.norm() + ball.radius;
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

PairQuestion readQuestion(PairQuery query, const JsonValue& entry) {
  const auto shapes = entry.at("shapes").elements();
  const auto shapeOf = [&](int i) { return kShapes.at(shapes[i].at("type").text())(shapes[i]); };
  const auto transforms = entry.at("transforms").elements(2);
  PairQuestion question{
      .query = query,
      .a = shapeOf(0),
      .b = shapeOf(1),
      .a_from_b = relativePose(readTransform(transforms[0]), readTransform(transforms[1])),
      .scale = 0.0,
      .hits = {}};
  question.scale =
      std::max({extent(question.a), extent(question.b), question.a_from_b.translation().norm()});
  const JsonValue expected = entry.at("expected");
  if (query == PairQuery::Collide) {
    question.hits = readHits(expected);
    return question;
  }
  const double distance = expected.at("signed_distance").number();
  question.distance = query == PairQuery::Distance ? std::max(0.0, distance) : distance;
  question.tolerance = expected.at("tolerance").notNegative();
  return question;
}

/// Why the case is skipped; empty when it is not.
std::string unsupported(const std::string& query, const JsonValue& entry) {
  if (!kQueries.contains(query)) return "query " + query;
  const auto shapes = entry.at("shapes").elements(2);
  for (const JsonValue& shape : shapes) {
    const std::string type = shape.at("type").text();
    if (!kShapes.contains(type)) return "shape " + type;
  }
  return {};
}

ReplayCase readCase(const JsonValue& entry) {
  ReplayCase result;
  result.id = entry.at("id").text();
  const JsonValue place = entry.renamed("case '" + result.id + "':");
  result.query = place.at("query").text();
  result.skipReason = unsupported(result.query, place);
  if (result.skipReason.empty()) result.question = readQuestion(kQueries.at(result.query), place);
  return result;
}

}  // namespace

std::vector<ReplayCase> readReplayCases(const std::string& file) {
  const nlohmann::json root = JsonValue::parseFile(file);
  const JsonValue top(root, "", file);
  if (!root.is_object()) top.renamed("the file").fail("must be an object with the key 'cases'");
  if (top.has("version") && root["version"] != 1) top.at("version").refuse("1");
  std::set<std::string> ids;
  std::vector<ReplayCase> cases;
  for (const JsonValue& entry : top.at("cases").elements()) {
    cases.push_back(readCase(entry));
    if (!ids.insert(cases.back().id).second)
      entry.at("id").fail("repeats '" + cases.back().id + "'");
  }
  return cases;
}

}  // namespace swept
