// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/piecewise_polynomial.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "swept/core/floating_point_environment.hpp"
#include "text/numbers.hpp"
#include "trajectory/bernstein.hpp"

namespace swept {

namespace {

/// Of the larger of 1 and the value.
constexpr double kJoinTolerance = 1e-9;

/// `message`: makes the text, which takes longer than to test a curve that is right.
template <typename Message>
void requireCurve(bool holds, const Message& message) {
  if (!holds) throw std::invalid_argument("PiecewisePolynomial: " + std::string(message()));
}

void requireKnots(const std::vector<double>& knots) {
  for (std::size_t i = 0; i < knots.size(); ++i) {
    requireCurve(std::isfinite(knots[i]),
                 [&] { return "knot " + std::to_string(i) + " is not finite"; });
    requireCurve(i == 0 || knots[i] > knots[i - 1], [&] {
      return "knots must increase, but knot " + std::to_string(i) + " is " +
             detail::formatNumber(knots[i]) + " s, not above " +
             detail::formatNumber(knots[i - 1]) + " s";
    });
  }
}

void requirePiece(const Eigen::MatrixXd& piece, std::size_t index, Eigen::Index dimension) {
  const auto require = [index](bool holds, const auto& message) {
    requireCurve(
        holds, [&] { return "piece " + std::to_string(index) + " has " + std::string(message()); });
  };
  require(piece.rows() == dimension, [&] {
    return std::to_string(piece.rows()) + " values, but the first piece has " +
           std::to_string(dimension);
  });
  require(piece.cols() >= 2 && piece.cols() <= PiecewisePolynomial::kMaxDegree + 1, [&] {
    return "degree " + std::to_string(piece.cols() - 1) + ", allowed is 1 to " +
           std::to_string(PiecewisePolynomial::kMaxDegree);
  });
  require(piece.allFinite(), [] { return "a coefficient that is not finite"; });
}

void requireJoin(const Eigen::MatrixXd& before, const Eigen::MatrixXd& after, std::size_t knot) {
  const Eigen::Index last = before.cols() - 1;
  for (Eigen::Index i = 0; i < before.rows(); ++i) {
    const double from = before(i, last);
    const double to = after(i, 0);
    const double size = std::max({1.0, std::abs(from), std::abs(to)});
    requireCurve(std::abs(to - from) <= kJoinTolerance * size, [&] {
      return "value " + std::to_string(i) + " jumps from " + detail::formatNumber(from) + " to " +
             detail::formatNumber(to) + " at knot " + std::to_string(knot);
    });
  }
}

void evaluate(const Eigen::MatrixXd& piece, double u, std::span<double> q) {
  const auto count = static_cast<std::size_t>(piece.cols());
  for (Eigen::Index i = 0; i < piece.rows(); ++i) {
    detail::Bernstein left{};
    for (std::size_t k = 0; k < count; ++k) left[k] = piece(i, static_cast<Eigen::Index>(k));
    for (std::size_t step = 1; step < count; ++step)
      for (std::size_t k = 0; k + step < count; ++k) left[k] += u * (left[k + 1] - left[k]);
    q[static_cast<std::size_t>(i)] = left[0];
  }
}

Eigen::VectorXd evaluate(const Eigen::MatrixXd& piece, double u) {
  Eigen::VectorXd q(piece.rows());
  evaluate(piece, u, {q.data(), static_cast<std::size_t>(q.size())});
  return q;
}

}  // namespace

PiecewisePolynomial::PiecewisePolynomial(std::vector<double> knots,
                                         std::vector<Eigen::MatrixXd> coefficients)
    : knots_(std::move(knots)), coefficients_(std::move(coefficients)) {
  inDefaultEnvironment([this] { requireCurves(); });
}

void PiecewisePolynomial::requireCurves() const {
  requireCurve(!coefficients_.empty(), [] { return "no piece"; });
  requireCurve(knots_.size() == coefficients_.size() + 1, [this] {
    return std::to_string(knots_.size()) + " knots for " + std::to_string(coefficients_.size()) +
           " pieces, expected one more than pieces";
  });
  requireKnots(knots_);
  for (std::size_t i = 0; i < coefficients_.size(); ++i) {
    requirePiece(coefficients_[i], i, coefficients_.front().rows());
    if (i > 0) requireJoin(coefficients_[i - 1], coefficients_[i], i);
  }
}

std::size_t PiecewisePolynomial::pieceAt(double t) const {
  const auto after = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, t);
  return static_cast<std::size_t>(after - knots_.begin()) - 1;
}

namespace {

/// Where a time is in a piece, from 0 to 1.
double shareOf(const std::vector<double>& knots, std::size_t piece, double t) {
  return std::clamp((t - knots[piece]) / (knots[piece + 1] - knots[piece]), 0.0, 1.0);
}

}  // namespace

void PiecewisePolynomial::position(double t, ConfigurationSpan q) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([this, t, q] { position(t, q); });
  }
  if (std::ssize(q) != dimension())
    throw std::invalid_argument("PiecewisePolynomial: a position has " +
                                std::to_string(dimension()) + " values, not " +
                                std::to_string(q.size()));
  const std::size_t piece = pieceAt(t);
  evaluate(coefficients_[piece], shareOf(knots_, piece, t), q);
}

Eigen::VectorXd PiecewisePolynomial::position(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([this, t] { return position(t); });
  }
  const std::size_t piece = pieceAt(t);
  return evaluate(coefficients_[piece], shareOf(knots_, piece, t));
}

Eigen::VectorXd PiecewisePolynomial::velocity(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([this, t] { return velocity(t); });
  }
  const std::size_t piece = pieceAt(t);
  const double length = knots_[piece + 1] - knots_[piece];
  return evaluate(detail::derivative(coefficients_[piece], length), shareOf(knots_, piece, t));
}

Eigen::VectorXd PiecewisePolynomial::acceleration(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([this, t] { return acceleration(t); });
  }
  const std::size_t piece = pieceAt(t);
  const double length = knots_[piece + 1] - knots_[piece];
  return evaluate(detail::derivative(detail::derivative(coefficients_[piece], length), length),
                  shareOf(knots_, piece, t));
}

namespace {

/// The blossom of a B-spline's piece (L. Ramshaw, Blossoming, 1987): its value at `arguments`, from
/// the control points that count between knots[span] and knots[span + 1].
Eigen::VectorXd blossom(int degree, const std::vector<double>& knots,
                        const Eigen::MatrixXd& controlPoints, std::size_t span,
                        std::span<const double> arguments) {
  const auto d = static_cast<std::size_t>(degree);
  Eigen::MatrixXd points =
      controlPoints.middleCols(static_cast<Eigen::Index>(span - d), degree + 1);
  for (std::size_t r = 1; r <= d; ++r) {
    for (std::size_t j = d; j >= r; --j) {
      const double low = knots[span - d + j];
      const double high = knots[span + 1 + j - r];
      const double share = (arguments[r - 1] - low) / (high - low);
      const auto column = static_cast<Eigen::Index>(j);
      // What is constant stays so to the last bit.
      points.col(column) =
          points.col(column - 1) + share * (points.col(column) - points.col(column - 1));
    }
  }
  return points.col(degree);
}

}  // namespace

PiecewisePolynomial PiecewisePolynomial::bSpline(int degree, const std::vector<double>& knots,
                                                 const Eigen::MatrixXd& controlPoints) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, degree] { return bSpline(degree, knots, controlPoints); });
  }
  requireCurve(degree >= 1 && degree <= kMaxDegree, [degree] {
    return "degree " + std::to_string(degree) + ", allowed is 1 to " + std::to_string(kMaxDegree);
  });
  const auto d = static_cast<std::size_t>(degree);
  const auto count = static_cast<std::size_t>(controlPoints.cols());
  requireCurve(count > d, [&] {
    return std::to_string(count) + " control points, needed are at least " +
           std::to_string(degree + 1);
  });
  requireCurve(knots.size() == count + d + 1, [&] {
    return std::to_string(knots.size()) + " knots, expected " + std::to_string(count + d + 1);
  });
  requireCurve(std::ranges::is_sorted(knots) &&
                   std::ranges::all_of(knots, [](double knot) { return std::isfinite(knot); }),
               [] { return "the knots descend or are not finite"; });
  std::vector<double> breaks;
  std::vector<Eigen::MatrixXd> pieces;
  std::size_t repeated = 1;
  for (std::size_t span = d; span < count; ++span) {
    const double low = knots[span];
    const double high = knots[span + 1];
    repeated = span > d && low == knots[span - 1] ? repeated + 1 : 1;
    requireCurve(repeated <= d || breaks.empty(), [low, degree] {
      return "knot " + detail::formatNumber(low) + " s repeats more often than the degree " +
             std::to_string(degree) + ": the curve would jump";
    });
    if (low == high) continue;
    if (breaks.empty()) breaks.push_back(low);
    breaks.push_back(high);
    Eigen::MatrixXd piece(controlPoints.rows(), degree + 1);
    std::array<double, kMaxDegree> arguments{};
    for (int k = 0; k <= degree; ++k) {
      for (int i = 0; i < degree; ++i) arguments[static_cast<std::size_t>(i)] = i < k ? high : low;
      piece.col(k) = blossom(degree, knots, controlPoints, span, std::span(arguments).first(d));
    }
    pieces.push_back(std::move(piece));
  }
  return {std::move(breaks), std::move(pieces)};
}

}  // namespace swept
