// SPDX-License-Identifier: BSD-3-Clause
#include "shape_pair_case.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "swept/core/distance.hpp"
#include "swept/core/height_field.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept::test {
namespace {

using Eigen::Vector3d;

std::vector<Vector3d> pointsOf(const std::vector<double>& numbers, double scale) {
  if (numbers.empty() || numbers.size() % 3 != 0)
    throw std::invalid_argument("points need three numbers each");
  std::vector<Vector3d> points;
  for (std::size_t i = 0; i < numbers.size(); i += 3)
    points.push_back(scale * Vector3d(numbers[i], numbers[i + 1], numbers[i + 2]));
  return points;
}

/// A cube each. They must not share faces, which would be taken for repeated triangles.
Shape voxels(const std::vector<double>& numbers, double scale) {
  const double size = scale * numbers.at(0);
  std::vector<Vector3d> vertices;
  std::vector<TriangleMesh::Triangle> triangles;
  for (std::size_t i = 1; i + 2 < numbers.size(); i += 3) {
    const auto base = static_cast<int>(vertices.size());
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d cell(numbers[i] + (corner & 1), numbers[i + 1] + (corner >> 1 & 1),
                          numbers[i + 2] + (corner >> 2));
      vertices.push_back(size * cell);
    }
    for (const TriangleMesh::Triangle& t : std::initializer_list<TriangleMesh::Triangle>{{0, 2, 1},
                                                                                         {1, 2, 3},
                                                                                         {4, 5, 6},
                                                                                         {5, 7, 6},
                                                                                         {0, 1, 4},
                                                                                         {1, 5, 4},
                                                                                         {2, 6, 3},
                                                                                         {3, 6, 7},
                                                                                         {0, 4, 2},
                                                                                         {2, 4, 6},
                                                                                         {1, 3, 5},
                                                                                         {3, 7, 5}})
      triangles.emplace_back(t[0] + base, t[1] + base, t[2] + base);
  }
  return TriangleMesh::build(vertices, triangles);
}

Shape flatTerrain(const std::vector<double>& n, double scale) {
  const auto rows = static_cast<int>(n.at(2)), columns = static_cast<int>(n.at(3));
  return heightField(scale * n.at(0), scale * n.at(1),
                     Eigen::MatrixXd::Constant(rows, columns, scale * n.at(4)), scale * n.at(5));
}

std::vector<double> numbersIn(std::istream& words) {
  std::vector<double> numbers;
  for (double number = 0.0; words >> number;) numbers.push_back(number);
  if (!words.eof()) throw std::invalid_argument("not a number");
  return numbers;
}

Eigen::Affine3d poseIn(std::istream& words) {
  const std::vector<double> n = numbersIn(words);
  if (n.size() != 12) throw std::invalid_argument("a pose has 12 numbers");
  Eigen::Affine3d pose = Eigen::Affine3d::Identity();
  for (int i = 0; i < 12; ++i) {
    const int row = i / 4, column = i % 4;
    pose(row, column) = n[static_cast<std::size_t>(i)];
  }
  return pose;
}

void readLine(const std::string& line, std::vector<ShapePairCase>& cases) {
  std::istringstream words(line);
  std::string key, rest;
  words >> key >> std::ws;
  if (key == "case") {
    words >> cases.emplace_back().id;
    return;
  }
  if (cases.empty()) throw std::invalid_argument("'" + key + "' before the first case");
  ShapePairCase& item = cases.back();
  if (key == "source") {
    std::getline(words, item.source);
  } else if (key == "a" || key == "b") {
    ShapeText& text = key == "a" ? item.a : item.b;
    words >> text.kind;
    text.numbers = numbersIn(words);
    text.shape();  // must be one
  } else if (key == "a_pose") {
    item.world_from_a = poseIn(words);
  } else if (key == "b_pose") {
    item.world_from_b = poseIn(words);
  } else if (key == "signed_distance") {
    item.signedDistance = numbersIn(words).at(0);
  } else if (key == "tolerance") {
    item.tolerance = numbersIn(words).at(0);
  } else {
    throw std::invalid_argument("unknown key '" + key + "'");
  }
}

/// The translations are subtracted first, which keeps the digits of shapes far from the origin.
Eigen::Isometry3d relativePose(const ShapePairCase& item) {
  const Eigen::Matrix3d a_from_world = item.world_from_a.linear().inverse();
  Eigen::Isometry3d a_from_b = Eigen::Isometry3d::Identity();
  a_from_b.linear() = a_from_world * item.world_from_b.linear();
  a_from_b.translation() =
      a_from_world * (item.world_from_b.translation() - item.world_from_a.translation());
  return a_from_b;
}

double extentOf(const Shape& shape) {
  if (const auto* halfSpace = std::get_if<HalfSpace>(&shape)) return std::abs(halfSpace->offset);
  const BoundingSphere ball = boundingSphere(shape);
  return ball.center.norm() + ball.radius;
}

/// How far a pose is from a turn: the frame of a, in which distances are measured, is off by it.
double skewOf(const Eigen::Affine3d& pose) {
  return (pose.linear().transpose() * pose.linear() - Eigen::Matrix3d::Identity()).norm();
}

/// m; what rounding and skew of the poses can do to the answer.
double slackOf(const ShapePairCase& item, const Shape& a, const Shape& b) {
  const double size = extentOf(a) + extentOf(b) + relativePose(item).translation().norm();
  const double far =
      item.world_from_a.translation().norm() + item.world_from_b.translation().norm();
  return (1e-12 + skewOf(item.world_from_a) + skewOf(item.world_from_b)) * size + 1e-15 * far;
}

void expectRightInThisOrder(const ShapePairCase& item) {
  SCOPED_TRACE("paste-able:\n" + toText(item));
  const Shape a = item.a.shape(item.scale), b = item.b.shape(item.scale);
  const Eigen::Isometry3d pose = relativePose(item);
  const double slack = item.tolerance + slackOf(item, a, b);
  const double expected = item.signedDistance, apart = std::max(0.0, expected);
  const double tolerance = std::min(tolerance::kDistance, item.tolerance);

  const SignedDistanceResult depth = signedDistance(a, b, pose, tolerance);
  EXPECT_NEAR(depth.lower, expected, slack);
  EXPECT_NEAR(depth.upper, expected, slack);
  EXPECT_LE(depth.lower, depth.upper);

  DistanceOptions options;
  options.tolerance = tolerance;
  const DistanceResult gap = distance(a, b, pose, options);
  EXPECT_NEAR(gap.lower, apart, slack);
  EXPECT_NEAR(gap.upper, apart, slack);
  EXPECT_LE(gap.lower, gap.upper);
  EXPECT_NEAR((gap.pointA - gap.pointB).norm(), gap.upper, slack);

  // Within the slack either answer is right.
  const Contact contact = collide(a, b, pose);
  if (expected > slack) {
    EXPECT_EQ(contact, Contact::Separate);
  }
  if (expected < -slack) {
    EXPECT_EQ(contact, Contact::Touching);
  }
}

}  // namespace

Shape ShapeText::shape(double scale) const {
  const auto length = [&](std::size_t i) { return scale * numbers.at(i); };
  if (kind == "box") return makeBox({length(0), length(1), length(2)});
  if (kind == "sphere") return makeSphere(length(0));
  if (kind == "cylinder") return makeCylinder(length(0), length(1));
  if (kind == "capsule") return makeCapsule(length(0), length(1));
  if (kind == "cone") return makeCone(length(0), length(1));
  if (kind == "convex") return ConvexHull::of(pointsOf(numbers, scale));
  if (kind == "triangle") {
    const std::vector<Vector3d> corners = pointsOf(numbers, scale);
    return makeTriangle(corners.at(0), corners.at(1), corners.at(2));
  }
  if (kind == "halfspace")
    return makeHalfSpace({numbers.at(0), numbers.at(1), numbers.at(2)}, length(3));
  if (kind == "flat_terrain") return flatTerrain(numbers, scale);
  if (kind == "voxels") return voxels(numbers, scale);
  throw std::invalid_argument("unknown shape '" + kind + "'");
}

ShapePairCase ShapePairCase::moved(const Eigen::Isometry3d& motion) const {
  ShapePairCase result = *this;
  result.world_from_a = motion * world_from_a;
  result.world_from_b = motion * world_from_b;
  return result;
}

ShapePairCase ShapePairCase::scaled(double by) const {
  ShapePairCase result = *this;
  result.world_from_a.translation() *= by;
  result.world_from_b.translation() *= by;
  result.signedDistance *= by;
  result.tolerance *= by;
  result.scale *= by;
  return result;
}

ShapePairCase ShapePairCase::swapped() const {
  ShapePairCase result = *this;
  std::swap(result.a, result.b);
  std::swap(result.world_from_a, result.world_from_b);
  return result;
}

std::vector<ShapePairCase> readShapePairs(const std::string& file) {
  std::ifstream stream(file);
  if (!stream) throw std::runtime_error(file + ": cannot be read");
  std::vector<ShapePairCase> cases;
  int number = 0;
  for (std::string line; std::getline(stream, line);) {
    ++number;
    if (line.empty() || line.front() == '#') continue;
    try {
      readLine(line, cases);
    } catch (const std::exception& error) {
      throw std::runtime_error(file + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  return cases;
}

std::string toText(const ShapePairCase& item) {
  std::ostringstream text;
  text.precision(17);
  const auto shape = [&](const char* key, const ShapeText& given, const Eigen::Affine3d& pose) {
    text << key << ' ' << given.kind;
    for (const double number : given.numbers) text << ' ' << number;
    text << '\n' << key << "_pose";
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 4; ++column) text << ' ' << pose(row, column);
    text << '\n';
  };
  text << "case " << item.id << "\nsource " << item.source << '\n';
  shape("a", item.a, item.world_from_a);
  shape("b", item.b, item.world_from_b);
  text << "signed_distance " << item.signedDistance << "\ntolerance " << item.tolerance << '\n';
  if (item.scale != 1.0) text << "# multiply the shapes' lengths by " << item.scale << '\n';
  return text.str();
}

void expectRight(const ShapePairCase& item) {
  expectRightInThisOrder(item);
  expectRightInThisOrder(item.swapped());
}

}  // namespace swept::test
