// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/curve_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "kinematics/chord_path.hpp"
#include "rounding/error_model.hpp"
#include "trajectory/bernstein.hpp"

namespace swept::detail {

namespace {

constexpr int kMaxDegree = PiecewisePolynomial::kMaxDegree;

constexpr std::array<std::array<double, kMaxDegree + 1>, kMaxDegree + 1> binomials() {
  std::array<std::array<double, kMaxDegree + 1>, kMaxDegree + 1> table{};
  for (std::size_t n = 0; n <= kMaxDegree; ++n) {
    table[n][0] = 1.0;
    for (std::size_t k = 1; k <= n; ++k) table[n][k] = table[n - 1][k - 1] + table[n - 1][k];
  }
  return table;
}
constexpr auto kBinomials = binomials();

/// One value of a piece, as the curve has it.
struct ValuePiece {
  const double* first;  ///< coefficient
  std::ptrdiff_t step;  ///< from one coefficient to the next
  std::size_t degree;

  ValuePiece(const Eigen::MatrixXd& piece, int variable)
      : first(piece.data() + variable),
        step(piece.rows()),
        degree(static_cast<std::size_t>(piece.cols()) - 1) {}

  double coefficient(std::size_t k) const { return first[static_cast<std::ptrdiff_t>(k) * step]; }
};

/// The Taylor coefficients T_k at 1/2: the value at 1/2 + s is the sum of T_k s^k. T_k is C(d, k)
/// times the k-th difference after d - k steps of de Casteljau (Farin, section 5.3). Returns the
/// largest coefficient.
template <std::size_t kDegree>
double taylor(const ValuePiece& piece, Bernstein& terms) {
  std::array<double, kDegree + 1> level{};
  double largest = 0.0;
  for (std::size_t k = 0; k <= kDegree; ++k) {
    level[k] = piece.coefficient(k);
    largest = std::max(largest, std::abs(level[k]));
  }
  for (std::size_t order = kDegree;; --order) {
    std::array<double, kDegree + 1> differences = level;
    for (std::size_t step = 0; step < order; ++step)
      for (std::size_t k = 0; k + step < order; ++k)
        differences[k] = differences[k + 1] - differences[k];
    terms[order] = kBinomials[kDegree][order] * differences[0];
    if (order == 0) return largest;
    for (std::size_t k = 0; k < order; ++k) level[k] += 0.5 * (level[k + 1] - level[k]);
  }
}

double taylor(const ValuePiece& piece, Bernstein& terms) {
  terms.fill(0.0);
  switch (piece.degree) {
    case 1:
      return taylor<1>(piece, terms);
    case 2:
      return taylor<2>(piece, terms);
    case 3:
      return taylor<3>(piece, terms);
    case 4:
      return taylor<4>(piece, terms);
    case 5:
      return taylor<5>(piece, terms);
    case 6:
      return taylor<6>(piece, terms);
    default:
      return taylor<kMaxDegree>(piece, terms);
  }
}

/// A value and its rates at a point of a piece, and bounds over what is within `reach` of it; all
/// by the share of the piece's duration.
struct LocalBounds {
  double value, rate;
  double range, speed, acceleration;
};

/// Moves Taylor coefficients to another point, `by` away from theirs.
void moveTerms(std::size_t degree, double by, Bernstein& terms) {
  for (std::size_t first = 0; first < degree; ++first)
    for (std::size_t k = degree; k-- > first;) terms[k] += by * terms[k + 1];
}

LocalBounds boundsAround(std::size_t degree, const Bernstein& terms, double reach) {
  LocalBounds bounds{terms[0], terms[1], 0.0, 0.0, 0.0};
  for (std::size_t k = degree; k > 0; --k) {
    const auto order = static_cast<double>(k);
    const double size = std::abs(terms[k]);
    bounds.range = (bounds.range + size) * reach;
    bounds.speed = bounds.speed * reach + order * size;
    if (k > 1) bounds.acceleration = bounds.acceleration * reach + order * (order - 1.0) * size;
  }
  return bounds;
}

double lengthOf(const PiecewisePolynomial& curve, std::size_t piece) {
  return curve.knots()[piece + 1] - curve.knots()[piece];
}

/// Rates at the ends of a piece.
double rateAtBegin(const PiecewisePolynomial& curve, std::size_t piece, int variable) {
  const ValuePiece own(curve.coefficients(piece), variable);
  return static_cast<double>(own.degree) * (own.coefficient(1) - own.coefficient(0)) /
         lengthOf(curve, piece);
}

double rateAtEnd(const PiecewisePolynomial& curve, std::size_t piece, int variable) {
  const ValuePiece own(curve.coefficients(piece), variable);
  return static_cast<double>(own.degree) *
         (own.coefficient(own.degree) - own.coefficient(own.degree - 1)) / lengthOf(curve, piece);
}

/// rad or m. Values that join to within this are taken to join: what they are off is an error of
/// the curve's values.
constexpr double kLargestJoin = 1e-9;

/// What a jump of value and rate at a knot makes of all values within `duration` of it: see L17.
double joinError(const PiecewisePolynomial& curve, std::size_t knot, int variable,
                 double duration) {
  const ValuePiece before(curve.coefficients(knot - 1), variable);
  const ValuePiece after(curve.coefficients(knot), variable);
  const double jump = std::abs(after.coefficient(0) - before.coefficient(before.degree));
  const double rateBefore = rateAtEnd(curve, knot - 1, variable);
  const double rateAfter = rateAtBegin(curve, knot, variable);
  const double kink = std::abs(rateAfter - rateBefore) +
                      kValueRounding * (std::abs(rateBefore) + std::abs(rateAfter));
  return (jump + kink * duration) * kArithmeticOutward;
}

/// Whether all joints move along a piece as StraightPath has them between its ends.
bool isStraight(const KinematicModel& model, const PiecewisePolynomial& curve, std::size_t piece) {
  if (curve.degree(piece) != 1) return false;
  const Eigen::MatrixXd& ends = curve.coefficients(piece);
  for (int i = 0; i < curve.dimension(); ++i)
    if (model.cyclic[static_cast<std::size_t>(i)] != 0 &&
        !(std::abs(ends(i, 1) - ends(i, 0)) <= std::numbers::pi))
      return false;
  return true;
}

/// Whether all orientations of floating joints are along a piece as they are where another begins.
bool keepsOrientations(const KinematicModel& model, const PiecewisePolynomial& curve,
                       std::size_t piece, std::size_t other) {
  for (const MovingBody& body : model.bodies) {
    if (body.type != JointType::Floating || body.variable >= model.dimension) continue;
    const auto orientation = curve.coefficients(piece).middleRows(body.variable + 3, 4);
    const Eigen::Vector4d kept = curve.coefficients(other).block<4, 1>(body.variable + 3, 0);
    if (!(orientation.colwise() - kept).isZero(0.0)) return false;
  }
  return true;
}

}  // namespace

CurveRun runFrom(const KinematicModel& model, const PiecewisePolynomial& curve, std::size_t first,
                 std::size_t most, CurveScratch& scratch) {
  CurveRun run{.first = first, .last = first + 1, .straight = isStraight(model, curve, first)};
  const auto dimension = static_cast<std::size_t>(curve.dimension());
  std::vector<double>& joins = scratch.joins;
  joins.assign(dimension, 0.0);
  if (run.straight || !keepsOrientations(model, curve, first, first)) return run;
  const std::size_t end = std::min(curve.pieces(), first + most);
  const double duration = curve.knots()[end] - curve.knots()[first];
  for (; run.last < end; ++run.last) {
    bool joined = !isStraight(model, curve, run.last) &&
                  keepsOrientations(model, curve, run.last, first) &&
                  chordFrom(model, curve, run.last, 1).last == run.last;
    for (std::size_t i = 0; i < dimension && joined; ++i)
      joined = joins[i] + joinError(curve, run.last, static_cast<int>(i), duration) <= kLargestJoin;
    if (!joined) return run;
    for (std::size_t i = 0; i < dimension; ++i)
      joins[i] += joinError(curve, run.last, static_cast<int>(i), duration);
  }
  return run;
}

CurvePath::CurvePath(const KinematicModel& model, const PiecewisePolynomial& curve,
                     const CurveRun& run, double clock, CurveScratch& scratch)
    : model_(model),
      curve_(curve),
      run_(run),
      begin_(curve.knots()[run.first]),
      width_(curve.knots()[run.last] - begin_),
      clock_(clock),
      timeError_(kTimeRounding * (std::abs(begin_) + width_)),
      scratch_(scratch) {
  compileValues(scratch);
  const auto robot = static_cast<std::size_t>(
      model.firstObstacle > 0 ? model.firstObstacle : static_cast<int>(model.bodies.size()));
  for (std::size_t i = 1; i < robot; ++i)
    if (model.bodies[i].type == JointType::Prismatic)
      slidesWithin_ = slidesWithin_ && staysWithin(model.bodies[i]);
}

/// Whether a prismatic joint's value is within its limits all along. A value that only touches a
/// limit is: its coefficients are divided until they are within, or a value is not.
bool CurvePath::staysWithin(const MovingBody& body) const {
  constexpr int kMostDivisions = 48;
  double rounding = 0.0;  // m, of the divisions: see L17
  const auto leaves = [&](double value) {
    const double place = body.multiplier * value + body.offset;
    return !(place >= body.lower + rounding && place <= body.upper - rounding);
  };
  struct Part {
    Bernstein coefficients;
    int divisions;
  };
  // Of each division, one half waits.
  std::array<Part, kMostDivisions + 2> parts;
  for (std::size_t piece = run_.first; piece < run_.last; ++piece) {
    const ValuePiece own(curve_.coefficients(piece), body.variable);
    const std::size_t count = own.degree + 1;
    Part& whole = parts[0] = {{}, 0};
    double largest = 0.0;
    for (std::size_t k = 0; k < count; ++k) {
      whole.coefficients[k] = own.coefficient(k);
      largest = std::max(largest, std::abs(whole.coefficients[k]));
    }
    rounding = 2.0 * kDouble * kMostDivisions * static_cast<double>(own.degree) *
               std::abs(body.multiplier) * largest;
    for (std::size_t waiting = 1; waiting > 0;) {
      const Part part = parts[--waiting];
      const std::span<const double> coefficients(part.coefficients.data(), count);
      if (std::ranges::none_of(coefficients, leaves)) continue;
      if (leaves(coefficients.front()) || leaves(coefficients.back()) ||
          part.divisions == kMostDivisions)
        return false;
      Part& first = parts[waiting++] = {{}, part.divisions + 1};
      Part& rest = parts[waiting++] = {{}, part.divisions + 1};
      divide(coefficients, 0.5, std::span(first.coefficients).first(count),
             std::span(rest.coefficients).first(count));
    }
  }
  return true;
}

CurvePath::Window CurvePath::windowOf(double t, double half) const {
  Window window;
  window.middle = begin_ + t * width_;
  window.half = half * width_ + timeError_;
  const std::vector<double>& knots = curve_.knots();
  const auto pieceOf = [&](double time) {
    const auto inner = knots.begin() + static_cast<std::ptrdiff_t>(run_.first) + 1;
    const auto end = knots.begin() + static_cast<std::ptrdiff_t>(run_.last);
    return run_.first + static_cast<std::size_t>(std::upper_bound(inner, end, time) - inner);
  };
  window.center = pieceOf(window.middle);
  const double low = window.middle - window.half;
  const double high = window.middle + window.half;
  window.first = low >= knots[window.center] ? window.center : pieceOf(low);
  window.last = high < knots[window.center + 1] ? window.center : pieceOf(high);
  return window;
}

void CurvePath::compileValues(CurveScratch& scratch) const {
  const auto dimension = static_cast<std::size_t>(curve_.dimension());
  scratch.values.resize((run_.last - run_.first) * dimension);
  for (std::size_t piece = run_.first; piece < run_.last; ++piece) {
    const Eigen::MatrixXd& coefficients = curve_.coefficients(piece);
    const double length = lengthOf(curve_, piece);
    for (std::size_t i = 0; i < dimension; ++i) {
      const ValuePiece own(coefficients, static_cast<int>(i));
      CurveValue& value = scratch.values[(piece - run_.first) * dimension + i];
      value.rounding = curveRounding(own.degree, taylor(own, value.terms));
      const LocalBounds whole = boundsAround(own.degree, value.terms, 0.5 + timeError_ / length);
      value.low = whole.value - whole.range - value.rounding.value;
      value.high = whole.value + whole.range + value.rounding.value;
      value.speed = (whole.speed + value.rounding.rate) / length;
      value.acceleration = (whole.acceleration + value.rounding.acceleration) / (length * length);
    }
  }
}

CurvePath::ValueMotion CurvePath::around(int variable, const Window& window) const {
  ValueMotion motion;
  motion.low = std::numeric_limits<double>::infinity();
  motion.high = -motion.low;
  const std::vector<double>& knots = curve_.knots();
  const bool inside = window.first == window.last;
  const auto include = [&motion](double low, double high, double speed, double acceleration) {
    motion.low = std::min(motion.low, low);
    motion.high = std::max(motion.high, high);
    motion.speed = std::max(motion.speed, speed);
    motion.acceleration = std::max(motion.acceleration, acceleration);
  };
  for (std::size_t piece = window.first; piece <= window.last; ++piece) {
    const CurveValue& own = valueOf(piece, variable);
    motion.error = std::max(motion.error, own.rounding.value);
    if (piece > window.first && piece < window.last) {
      include(own.low, own.high, own.speed, own.acceleration);
      continue;
    }
    const auto degree = static_cast<std::size_t>(curve_.degree(piece));
    const double length = knots[piece + 1] - knots[piece];
    const double low =
        inside ? window.middle - window.half : std::max(window.middle - window.half, knots[piece]);
    const double high = inside ? window.middle + window.half
                               : std::min(window.middle + window.half, knots[piece + 1]);
    const double middle = inside ? window.middle : 0.5 * (low + high);
    const double reach = (inside ? window.half : 0.5 * (high - low) + timeError_) / length;
    Bernstein terms = own.terms;
    moveTerms(degree, (middle - knots[piece]) / length - 0.5, terms);
    const LocalBounds part = boundsAround(degree, terms, reach);
    const double range = part.range + own.rounding.value;
    include(part.value - range, part.value + range, (part.speed + own.rounding.rate) / length,
            (part.acceleration + own.rounding.acceleration) / (length * length));
    if (!inside) continue;
    motion.value = part.value;
    motion.rate = part.rate / length;
  }
  const CurveValue& center = valueOf(window.center, variable);
  const double length = knots[window.center + 1] - knots[window.center];
  if (!inside) {
    const auto degree = static_cast<std::size_t>(curve_.degree(window.center));
    Bernstein terms = center.terms;
    moveTerms(degree, (window.middle - knots[window.center]) / length - 0.5, terms);
    motion.value = terms[0];
    motion.rate = terms[1] / length;
  }
  const double join = scratch_.joins[static_cast<std::size_t>(variable)];
  motion.low -= join;
  motion.high += join;
  motion.error += join + 2.0 * timeError_ * motion.speed;
  const double half = window.half - timeError_;  // of what was asked about
  if (half > 0.0)
    motion.acceleration =
        (motion.acceleration * window.half + 2.0 * center.rounding.rate / length) * window.half /
        (half * half);
  return motion;
}

bool CurvePath::linearize(double t, double half, std::span<JointMotion> joints) const {
  if (!slidesWithin_) return false;
  const Window window = windowOf(t, half);
  for (std::size_t i = 1; i < joints.size(); ++i) {
    const MovingBody& body = model_.bodies[i];
    JointMotion& joint = joints[i];
    joint = {};
    if (body.type == JointType::Fixed) continue;
    joint.anchor = t;
    switch (body.type) {
      case JointType::Revolute:
      case JointType::Continuous:
        turn(around(body.variable, window), body.multiplier, body.offset, body.axis, joint);
        break;
      case JointType::Prismatic:
        slide(body, around(body.variable, window), joint);
        break;
      case JointType::Planar:
        slideFreely(body, window, joint);
        turn(around(body.variable + 2, window), 1.0, 0.0, body.planarBasis.col(2), joint);
        break;
      case JointType::Floating: {
        if (isLine()) {
          if (!compileJoint(model_, body, endOfLine(0), endOfLine(1), joint)) return false;
          break;
        }
        slideFreely(body, window, joint);
        const Eigen::MatrixXd& piece = curve_.coefficients(window.center);
        const Eigen::Vector4d orientation = piece.block<4, 1>(body.variable + 3, 0);
        if (!hasDirection(orientation.data())) return false;
        joint.rotation = Eigen::Quaterniond(orientation).normalized();
        break;
      }
      case JointType::Fixed:
        break;
    }
  }
  return true;
}

void CurvePath::turn(const ValueMotion& own, double multiplier, double offset,
                     const Eigen::Vector3d& axis, JointMotion& joint) const {
  const double factor = std::abs(multiplier) * kArithmeticOutward;
  joint.angle = multiplier * own.value + offset;
  joint.angleRate = multiplier * own.rate * width_;
  joint.spin = joint.angleRate * axis;
  joint.spinSpeed = factor * own.speed * width_;
  joint.spinAcceleration = factor * own.acceleration * width_ * width_;
  const double first = multiplier * own.low + offset;
  const double last = multiplier * own.high + offset;
  joint.lowAngle = std::min(first, last);
  joint.highAngle = std::max(first, last);
  // The part beyond kOrdinary counts as an error of the angle.
  const double terms = factor * std::max(std::abs(own.low), std::abs(own.high)) + std::abs(offset);
  joint.largestAngle = kOrdinary + terms + factor * own.error / kValueRounding;
}

void CurvePath::slide(const MovingBody& body, const ValueMotion& own, JointMotion& joint) const {
  const double factor = std::abs(body.multiplier) * kArithmeticOutward;
  const auto placeOf = [&](double value) { return body.multiplier * value + body.offset; };
  joint.translation = placeOf(own.value) * body.axis;
  joint.rate = body.multiplier * own.rate * width_ * body.axis;
  joint.speed = factor * own.speed * width_;
  joint.acceleration = factor * own.acceleration * width_ * width_;
  // It stays within its limits, whatever these bounds say.
  joint.low = std::clamp(std::min(placeOf(own.low), placeOf(own.high)), body.lower, body.upper);
  joint.high = std::clamp(std::max(placeOf(own.low), placeOf(own.high)), body.lower, body.upper);
  const double terms =
      factor * std::max(std::abs(own.low), std::abs(own.high)) + std::abs(body.offset);
  joint.slideError = factor * own.error + kValueRounding * terms;
}

/// The translation of a planar or floating joint.
void CurvePath::slideFreely(const MovingBody& body, const Window& window,
                            JointMotion& joint) const {
  const int values = body.type == JointType::Planar ? 2 : 3;
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  Eigen::Vector3d rate = place;
  Eigen::Vector3d speeds = place;
  Eigen::Vector3d accelerations = place;
  Eigen::Vector3d farthest = place;
  for (int k = 0; k < values; ++k) {
    const ValueMotion own = around(body.variable + k, window);
    place[k] = own.value;
    rate[k] = own.rate;
    speeds[k] = own.speed;
    accelerations[k] = own.acceleration;
    farthest[k] = std::max(std::abs(own.low), std::abs(own.high));
    joint.slideError += own.error;
  }
  if (body.type == JointType::Planar) {
    place = body.planarBasis * place;
    rate = body.planarBasis * rate;
  }
  joint.translation = place;
  joint.rate = rate * width_;
  joint.speed = speeds.norm() * width_ * kArithmeticOutward;
  joint.acceleration = accelerations.norm() * width_ * width_ * kArithmeticOutward;
  joint.maxTranslation = farthest.norm() * kArithmeticOutward;
}

void CurvePath::interpolate(double t, std::span<double> q) const {
  const double time = t == 1.0 ? begin_ + width_ : begin_ + t * width_;
  const auto dimension = static_cast<std::size_t>(curve_.dimension());
  curve_.position(time, q.first(dimension));
  if (isLine()) interpolateOrientations(model_, endOfLine(0), endOfLine(1), t, q);
  if (q.size() > dimension) q[dimension] = clock_ + time;
}

}  // namespace swept::detail
