// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/curve_on_clock.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

#include "rounding/error_model.hpp"
#include "trajectory/bernstein.hpp"

namespace swept::detail {

namespace {

/// Coefficients of a piece over a part of it, [from, to] of its length, at another degree.
Eigen::MatrixXd restricted(const Eigen::MatrixXd& piece, double from, double to, int degree) {
  const auto count = static_cast<std::size_t>(piece.cols());
  Eigen::MatrixXd result(piece.rows(), degree + 1);
  Bernstein whole{};
  Bernstein unused{};
  Bernstein rest{};
  Bernstein part{};
  for (Eigen::Index row = 0; row < piece.rows(); ++row) {
    for (std::size_t k = 0; k < count; ++k) whole[k] = piece(row, static_cast<Eigen::Index>(k));
    const auto first = [count](Bernstein& all) { return std::span(all).first(count); };
    divide(first(whole), from, first(unused), first(rest));
    divide(first(rest), from < 1.0 ? (to - from) / (1.0 - from) : 1.0, first(part), first(unused));
    // Raised by one degree at a time (Farin, section 6.1).
    for (auto d = count; d <= static_cast<std::size_t>(degree); ++d) {
      part[d] = part[d - 1];
      for (std::size_t k = d - 1; k > 0; --k) {
        // What is constant stays so to the last bit.
        part[k] += static_cast<double>(k) / static_cast<double>(d) * (part[k - 1] - part[k]);
      }
    }
    for (Eigen::Index k = 0; k <= degree; ++k) result(row, k) = part[static_cast<std::size_t>(k)];
  }
  return result;
}

/// The times between two, ends included, ascending. Times that rounding alone may tell apart become
/// one.
std::vector<double> knotsBetween(std::span<const CurveOnClock> parts, double begin, double end) {
  std::vector<double> times;
  for (const CurveOnClock& part : parts) part.addKnots(begin, end, times);
  std::ranges::sort(times);
  const double same = kSameTime * end;
  std::vector<double> knots{begin};
  for (const double time : times)
    if (time - knots.back() > same && end - time > same) knots.push_back(time);
  knots.push_back(end);
  return knots;
}

}  // namespace

void CurveOnClock::addKnots(double from, double to, std::vector<double>& times) const {
  const std::vector<double>& knots = curve_->knots();
  const auto onClockOf = [this](double time) { return onClock(time); };
  const auto first = std::ranges::upper_bound(knots, from, {}, onClockOf);
  const auto last = std::ranges::lower_bound(first, knots.end(), to, {}, onClockOf);
  std::ranges::transform(first, last, std::back_inserter(times), onClockOf);
}

double CurveOnClock::ownMiddle(double begin, double end) const {
  return (begin + 0.5 * (end - begin) - start_) / slowdown_;
}

bool CurveOnClock::isAtRest(double begin, double end) const {
  const double own = ownMiddle(begin, end);
  return own < curve_->begin() || own > curve_->end();
}

std::size_t CurveOnClock::pieceOf(double begin, double end) const {
  return curve_->pieceAt(ownMiddle(begin, end));
}

int CurveOnClock::degree(double begin, double end) const {
  return isAtRest(begin, end) ? 1 : curve_->degree(pieceOf(begin, end));
}

void CurveOnClock::write(double begin, double end, Eigen::MatrixXd& piece) const {
  const auto degree = static_cast<int>(piece.cols()) - 1;
  Eigen::MatrixXd own;
  if (isAtRest(begin, end)) {
    const bool before = ownMiddle(begin, end) < curve_->begin();
    const Eigen::MatrixXd& last = curve_->coefficients(before ? 0 : curve_->pieces() - 1);
    own = last.col(before ? 0 : last.cols() - 1).replicate(1, degree + 1);
  } else {
    const std::size_t index = pieceOf(begin, end);
    const double from = onClock(curve_->knots()[index]);
    const double width = onClock(curve_->knots()[index + 1]) - from;
    const auto share = [&](double time) { return std::clamp((time - from) / width, 0.0, 1.0); };
    own = restricted(curve_->coefficients(index), share(begin), share(end), degree);
  }
  for (std::size_t v = 0; v < places_.size(); ++v)
    piece.row(places_[v]) = own.row(static_cast<Eigen::Index>(v));
}

PiecewisePolynomial combined(std::span<const CurveOnClock> parts, const Eigen::VectorXd& rest,
                             double begin, double end) {
  std::vector<double> knots = knotsBetween(parts, begin, end);
  std::vector<Eigen::MatrixXd> pieces;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    int degree = 1;
    for (const CurveOnClock& part : parts)
      degree = std::max(degree, part.degree(knots[k], knots[k + 1]));
    Eigen::MatrixXd piece = rest.replicate(1, degree + 1);
    for (const CurveOnClock& part : parts) part.write(knots[k], knots[k + 1], piece);
    pieces.push_back(std::move(piece));
  }
  return {std::move(knots), std::move(pieces)};
}

}  // namespace swept::detail
