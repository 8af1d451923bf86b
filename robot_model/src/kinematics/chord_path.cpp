// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/chord_path.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "rounding/error_model.hpp"
#include "trajectory/bernstein.hpp"

namespace swept::detail {

namespace {

/// rad or m. A curve that deviates by more is none that was made to be straight.
constexpr double kLargestDeviation = 1e-9;

/// rad. Well below half a turn, where the shorter way is either one.
constexpr double kWidestTurn = 3.0;

/// The configurations at the ends of a piece.
using Configuration = Eigen::Map<const Eigen::VectorXd>;

Configuration beginOf(const PiecewisePolynomial& curve, std::size_t piece) {
  return {curve.coefficients(piece).data(), curve.dimension()};
}

Configuration endOf(const PiecewisePolynomial& curve, std::size_t piece) {
  return {curve.coefficients(piece).col(curve.degree(piece)).data(), curve.dimension()};
}

/// The pieces [first, last) of a curve beside the straight motion between their ends.
class Straightness {
 public:
  Straightness(const PiecewisePolynomial& curve, std::size_t first, std::size_t last)
      : curve_(curve), begin_(beginOf(curve, first)), end_(endOf(curve, last - 1)) {
    (end_ - begin_).cwiseAbs().maxCoeff(&leading_);
  }

  /// Whether all coefficients of a piece are on the motion, none before `share`, which becomes that
  /// of the piece's end. A piece in which the robot stays is not.
  bool has(std::size_t piece, double& share) {
    const Eigen::MatrixXd& coefficients = curve_.coefficients(piece);
    const double before = share;
    for (Eigen::Index k = 0; k < coefficients.cols(); ++k) {
      const double own = (coefficients(leading_, k) - begin_[leading_]) / change(leading_);
      if (!(own >= share && own <= 1.0)) return false;
      share = own;
      for (Eigen::Index i = 0; i < begin_.size(); ++i) {
        const double value = coefficients(i, k);
        const double off = std::abs(value - (begin_[i] + own * change(i))) +
                           kValueRounding * (std::abs(value) + std::abs(begin_[i]));
        if (!(off <= kLargestDeviation)) return false;
        deviation_ = std::max(deviation_, off);
      }
    }
    return share > before;
  }

  int leading() const { return static_cast<int>(leading_); }
  double deviation() const { return deviation_; }

 private:
  double change(Eigen::Index value) const { return end_[value] - begin_[value]; }

  const PiecewisePolynomial& curve_;
  const Configuration begin_;
  const Configuration end_;
  Eigen::Index leading_ = 0;
  double deviation_ = 0.0;
};

/// Whether the robot is at rest at the end of a piece.
bool stopsAfter(const PiecewisePolynomial& curve, std::size_t piece) {
  const Eigen::MatrixXd& coefficients = curve.coefficients(piece);
  const Eigen::Index last = curve.degree(piece);
  return coefficients.col(last) == coefficients.col(last - 1);
}

/// Whether the joints can take part: see chordFrom().
bool jointsTakePart(const KinematicModel& model, const PiecewisePolynomial& curve,
                    std::size_t piece) {
  const Eigen::MatrixXd& coefficients = curve.coefficients(piece);
  for (const MovingBody& body : model.bodies) {
    if (body.type == JointType::Floating && body.variable < model.dimension) {
      const auto orientation = coefficients.middleRows(body.variable + 3, 4);
      if (!(orientation.colwise() - orientation.col(0)).isZero(0.0)) return false;
    } else if (body.type == JointType::Prismatic) {
      const auto values = body.multiplier * coefficients.row(body.variable).array() + body.offset;
      if (!(values.minCoeff() >= body.lower && values.maxCoeff() <= body.upper)) return false;
    }
  }
  return true;
}

bool turnsLittle(const KinematicModel& model, const PiecewisePolynomial& curve, const Chord& chord,
                 std::size_t last) {
  const Configuration begin = beginOf(curve, chord.first);
  const Configuration end = endOf(curve, last);
  for (Eigen::Index i = 0; i < begin.size(); ++i)
    if (model.cyclic[static_cast<std::size_t>(i)] != 0 &&
        !(std::abs(end[i] - begin[i]) <= kWidestTurn))
      return false;
  return true;
}

}  // namespace

Chord chordFrom(const KinematicModel& model, const PiecewisePolynomial& curve, std::size_t first,
                std::size_t most) {
  Chord chord{.first = first, .last = first};
  // Places of moving obstacles depend on the time.
  if (model.fullDimension > model.dimension) return chord;
  const std::size_t end = std::min(curve.pieces(), first + most);
  // Each piece beside the motion to its own end, which shows early where the way bends.
  while (chord.last < end && curve.degree(chord.last) > 1) {
    double share = 0.0;
    if (!Straightness(curve, first, chord.last + 1).has(chord.last, share) ||
        !turnsLittle(model, curve, chord, chord.last) || !jointsTakePart(model, curve, chord.last))
      break;
    ++chord.last;
    if (stopsAfter(curve, chord.last - 1)) break;
  }
  // All of them beside the motion to the last one's end.
  for (; chord.last > first; --chord.last) {
    Straightness straight(curve, first, chord.last);
    double share = 0.0;
    std::size_t piece = first;
    while (piece < chord.last && straight.has(piece, share)) ++piece;
    if (piece < chord.last) continue;
    chord.leading = straight.leading();
    chord.deviation = straight.deviation();
    break;
  }
  return chord;
}

double timeOnChord(const PiecewisePolynomial& curve, const Chord& chord, double share) {
  const double begin = beginOf(curve, chord.first)[chord.leading];
  const double end = endOf(curve, chord.last - 1)[chord.leading];
  const double change = end - begin;
  // Where the curve begins at rest, its value stays the same for a while.
  const double rounding = kValueRounding * (std::abs(begin) + std::abs(end)) / std::abs(change);
  const auto isBefore = [&](double value) { return (value - begin) / change + rounding < share; };
  std::size_t piece = chord.first;
  while (piece + 1 < chord.last && isBefore(endOf(curve, piece)[chord.leading])) ++piece;
  const auto coefficients = curve.coefficients(piece).row(chord.leading);
  Bernstein whole;
  Bernstein before;
  Bernstein after;
  const auto count = static_cast<std::size_t>(coefficients.size());
  std::ranges::copy(coefficients, whole.begin());
  double low = 0.0;
  double high = 1.0;
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    divide(std::span(whole).first(count), middle, std::span(before).first(count),
           std::span(after).first(count));
    (isBefore(after[0]) ? low : high) = middle;
  }
  const std::vector<double>& knots = curve.knots();
  const double time = knots[piece] + low * (knots[piece + 1] - knots[piece]);
  return std::max(knots[chord.first],
                  time - kTimeRounding * (std::abs(time) + knots[piece + 1] - knots[piece]));
}

bool ChordPath::linearize(double t, double half, std::span<JointMotion> joints) const {
  if (!straight_.linearize(t, half, joints)) return false;
  for (std::size_t i = 1; i < joints.size(); ++i) {
    const MovingBody& body = model_.bodies[i];
    JointMotion& joint = joints[i];
    const double off = deviation_ * kArithmeticOutward * std::abs(body.multiplier);
    switch (body.type) {
      case JointType::Revolute:
      case JointType::Continuous:
        joint.lowAngle -= off;
        joint.highAngle += off;
        joint.largestAngle += kOrdinary + off / kValueRounding;
        break;
      case JointType::Prismatic:
        joint.low = std::max(joint.low - off, body.lower);
        joint.high = std::min(joint.high + off, body.upper);
        joint.slideError += off;
        break;
      case JointType::Planar:
        joint.largestAngle += kOrdinary + off / kValueRounding;
        [[fallthrough]];
      case JointType::Floating:
        joint.maxTranslation += 3.0 * off;
        joint.slideError += 3.0 * off;
        break;
      case JointType::Fixed:
        break;
    }
  }
  return true;
}

}  // namespace swept::detail
