// SPDX-License-Identifier: BSD-3-Clause
#include "report/executed_curves.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "output/text_output.hpp"
#include "robot/cyclic_values.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept {
namespace {

/// rad or m. What is shorter is no motion.
constexpr double kShortest = 1e-9;

/// The way points that differ from the ones before.
Eigen::MatrixXd distinctPoints(const Eigen::MatrixXd& points) {
  Eigen::MatrixXd kept(points.rows(), points.cols());
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < points.cols(); ++i)
    if (count == 0 || (points.col(i) - kept.col(count - 1)).norm() > kShortest)
      kept.col(count++) = points.col(i);
  if (count < 2)
    throw std::invalid_argument("a curve needs two way points that differ, but the path has " +
                                std::to_string(points.cols()) + " and " + std::to_string(count) +
                                " of them differ");
  kept.conservativeResize(Eigen::NoChange, count);
  return kept;
}

/// Writes one piece after the other. t is the length.
class PieceWriter {
 public:
  explicit PieceWriter(Eigen::VectorXd begin) : at_(std::move(begin)) {}

  void line(const Eigen::VectorXd& to) {
    const double length = (to - at_).norm();
    if (length <= kShortest) return;
    Eigen::MatrixXd piece(at_.size(), 2);
    piece.col(0) = at_;
    piece.col(1) = to;
    add(std::move(piece), length);
  }

  /// The cubic between two points of a circle that are an angle (rad) apart, from `at` on. The
  /// tangents at both are as long as the radius. (M. Goldapp, Approximation of circular arcs by
  /// cubic polynomials, 1991.)
  void arc(const Eigen::VectorXd& tangent, const Eigen::VectorXd& to,
           const Eigen::VectorXd& tangentAtEnd, double angle) {
    const double reach = 4.0 / 3.0 * std::tan(0.25 * angle);
    Eigen::MatrixXd piece(at_.size(), 4);
    piece.col(0) = at_;
    piece.col(1) = at_ + reach * tangent;
    piece.col(2) = to - reach * tangentAtEnd;
    piece.col(3) = to;
    add(std::move(piece), angle * tangent.norm());
  }

  PiecewisePolynomial curve() { return {std::move(knots_), std::move(pieces_)}; }

 private:
  void add(Eigen::MatrixXd piece, double length) {
    at_ = piece.col(piece.cols() - 1);
    knots_.push_back(knots_.back() + length);
    pieces_.push_back(std::move(piece));
  }

  Eigen::VectorXd at_;
  std::vector<double> knots_{0.0};
  std::vector<Eigen::MatrixXd> pieces_;
};

/// How far the cubic over an angle (rad) is from its circle: it is outside of it, by no more than
/// this.
double arcError(double radius, double angle) {
  const double quarter = 0.25 * angle;
  return radius * 4.0 / 27.0 * std::pow(std::sin(quarter), 6) / std::pow(std::cos(quarter), 2);
}

int cubicsOf(double radius, double angle) {
  int count = 1;
  while (angle > 0.5 * std::numbers::pi * count || arcError(radius, angle / count) > kArcError)
    ++count;
  return count;
}

/// A corner of a path; directions have unit length.
struct Corner {
  Eigen::VectorXd point, before, after;
  double half = 0.0;  ///< of the shorter of both straight motions

  /// Adds the motion to its arc, and the arc.
  void blend(double deviation, PieceWriter& writer) const {
    constexpr double kStraight = 0.999999;  // as in MoveIt
    if (std::abs(before.dot(after)) > kStraight) {
      writer.line(point);
      return;
    }
    const double sine = 0.5 * (after - before).norm(), cosine = 0.5 * (after + before).norm();
    const double angle = 2.0 * std::atan2(sine, cosine);
    const double length = std::min(half, deviation * sine / (1.0 - cosine));
    const double radius = length * cosine / sine;
    const Eigen::VectorXd center =
        point + (after - before).normalized() * std::hypot(radius, length);
    writer.line(point - length * before);
    const Eigen::VectorXd outward = radius * (point - length * before - center).normalized();
    const Eigen::VectorXd forward = radius * before;
    const int count = cubicsOf(radius, angle);
    Eigen::VectorXd tangent = forward;
    for (int i = 1; i <= count; ++i) {
      const double turned = angle * i / count;
      const Eigen::VectorXd next = std::cos(turned) * forward - std::sin(turned) * outward;
      writer.arc(tangent, center + std::cos(turned) * outward + std::sin(turned) * forward, next,
                 angle / count);
      tangent = next;
    }
  }
};

/// A column for the velocity at each way point. `times`: between two of them.
Eigen::MatrixXd splineVelocities(const Eigen::MatrixXd& points, const Eigen::VectorXd& times) {
  const Eigen::Index inner = points.cols() - 2;
  Eigen::MatrixXd velocities = Eigen::MatrixXd::Zero(points.rows(), points.cols());
  if (inner == 0) return velocities;
  // The acceleration is the same on both sides of each inner way point.
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(inner, inner);
  Eigen::MatrixXd right(inner, points.rows());
  for (Eigen::Index i = 0; i < inner; ++i) {
    const double before = times[i], after = times[i + 1];
    system(i, i) = 2.0 / before + 2.0 / after;
    if (i + 1 < inner) system(i, i + 1) = system(i + 1, i) = 1.0 / after;
    right.row(i) = 3.0 * ((points.col(i + 1) - points.col(i)) / (before * before) +
                          (points.col(i + 2) - points.col(i + 1)) / (after * after))
                             .transpose();
  }
  velocities.middleCols(1, inner) = system.llt().solve(right).transpose();
  return velocities;
}

}  // namespace

Eigen::MatrixXd continuousWayPoints(const Robot& robot, const Group& group,
                                    const ConfigurationList& path) {
  Eigen::MatrixXd points(static_cast<Eigen::Index>(group.variables.size()),
                         static_cast<Eigen::Index>(path.size()));
  for (std::size_t i = 0; i < path.size(); ++i) {
    for (std::size_t j = 0; j < group.variables.size(); ++j) {
      const Variable& variable = robot.variables()[static_cast<std::size_t>(group.variables[j])];
      const auto row = static_cast<Eigen::Index>(j), column = static_cast<Eigen::Index>(i);
      if (isOrientation(robot, variable) && path[i][j] != path[0][j])
        throw std::invalid_argument(variable.name + " changes to way point " + std::to_string(i) +
                                    ": an orientation turns by a slerp, which no polynomial "
                                    "follows");
      points(row, column) =
          i > 0 && variable.cyclic
              ? points(row, column - 1) + detail::cyclicDifference(path[i - 1][j], path[i][j])
              : path[i][j];
    }
  }
  return points;
}

PiecewisePolynomial polyline(const Eigen::MatrixXd& points) {
  const Eigen::MatrixXd kept = distinctPoints(points);
  PieceWriter writer(kept.col(0));
  for (Eigen::Index i = 1; i < kept.cols(); ++i) writer.line(kept.col(i));
  return writer.curve();
}

PiecewisePolynomial circularBlends(const Eigen::MatrixXd& points, double deviation) {
  if (!(deviation > 0.0))
    throw std::invalid_argument("the deviation of blends is " + exactNumber(deviation) +
                                ", allowed is above 0");
  const Eigen::MatrixXd kept = distinctPoints(points);
  PieceWriter writer(kept.col(0));
  for (Eigen::Index i = 1; i + 1 < kept.cols(); ++i) {
    const Eigen::VectorXd before = kept.col(i) - kept.col(i - 1);
    const Eigen::VectorXd after = kept.col(i + 1) - kept.col(i);
    const Corner corner{.point = kept.col(i),
                        .before = before.normalized(),
                        .after = after.normalized(),
                        .half = 0.5 * std::min(before.norm(), after.norm())};
    corner.blend(deviation, writer);
  }
  writer.line(kept.col(kept.cols() - 1));
  return writer.curve();
}

PiecewisePolynomial cubicSpline(const Eigen::MatrixXd& points) {
  const Eigen::MatrixXd kept = distinctPoints(points);
  const Eigen::Index parts = kept.cols() - 1;
  const Eigen::VectorXd times =
      (kept.rightCols(parts) - kept.leftCols(parts)).colwise().norm().transpose();
  const Eigen::MatrixXd velocities = splineVelocities(kept, times);
  std::vector<double> knots{0.0};
  std::vector<Eigen::MatrixXd> pieces;
  for (Eigen::Index i = 0; i < parts; ++i) {
    Eigen::MatrixXd piece(kept.rows(), 4);
    piece.col(0) = kept.col(i);
    piece.col(1) = kept.col(i) + times[i] / 3.0 * velocities.col(i);
    piece.col(2) = kept.col(i + 1) - times[i] / 3.0 * velocities.col(i + 1);
    piece.col(3) = kept.col(i + 1);
    knots.push_back(knots.back() + times[i]);
    pieces.push_back(std::move(piece));
  }
  return {std::move(knots), std::move(pieces)};
}

}  // namespace swept
