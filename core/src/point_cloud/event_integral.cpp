// SPDX-License-Identifier: BSD-3-Clause
#include "point_cloud/event_integral.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "point_cloud/gaussian.hpp"
#include "swept/core/axis_frame.hpp"
#include "swept/core/collision_probability.hpp"

namespace swept::detail {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Range of u and v; 5e-12 of the probability is beyond, which only the upper bound includes.
constexpr std::array<double, 6> kCuts{-7.0, -2.2, -0.75, 0.75, 2.2, 7.0};

/// Cap on the number of cells, some ten megabytes: smaller cells gain little, and splits need not
/// cost looks.
constexpr std::size_t kMostCells = 1 << 15;

constexpr int kLooksAlong = 4;        // at gaps of a cell's middle line, each time
constexpr double kSettled = 0.1;      // of a cell's gap: such gaps of its line are left alone
constexpr double kLeastWidth = 1e-9;  // of the spread: narrower cells are not split

bool narrower(const LineCell& a, const LineCell& b) {
  return a.gap() < b.gap();
}

}  // namespace

EventIntegral::EventIntegral(const Noise& noise, LookAt look)
    : noise_(noise), look_(std::move(look)), depth_(2.0 * noise.spread) {
  const Finding first = lookAt(noise_.mean, nullptr);
  boundByFirst(first);
}

bool EventIntegral::refine() {
  if (!hasDigits(noise_.spread)) return false;
  if (cells_.empty()) makeCells();
  LineCell cell = pop();
  if (!(cell.gap() > 0.0) || cells_.size() >= kMostCells) {
    push(std::move(cell));
    return false;
  }
  const double narrow = kLeastWidth * noise_.spread;
  if (!cell.looked || (width(cell, 0) <= narrow && width(cell, 1) <= narrow)) {
    const double before = cell.gap();
    const bool again = cell.looked;
    lookAlong(cell);
    const bool gained = !again || cell.gap() < before;
    push(std::move(cell));
    updateRange();
    return gained;
  }
  split(cell);
  updateRange();
  return true;
}

Finding EventIntegral::lookAt(const Vector3d& position, LineCell* cell) {
  ++looks_;
  Finding finding = look_(position);
  if (!finding.proof) return finding;
  const Certificate proof = finding.proof->shrunk(noise_.rounding);
  if (proof.form == Certificate::Form::Ball && !(proof.number > 0.0)) return finding;
  (cell != nullptr ? cell->certificates : common_).push_back(proof);
  return finding;
}

// A ball around the mean contains all but the tail of the noise, a half-space all but the tail of
// its component along the normal.
void EventIntegral::boundByFirst(const Finding& first) {
  first_.estimate = first.clearance <= 0.0 ? 1.0 : 0.0;
  if (!common_.empty()) {
    const Certificate& proof = common_.front();
    double tail = 1.0;
    if (proof.form == Certificate::Form::HalfSpace) {
      const Vector3d normal = noise_.factor.transpose() * proof.vector;
      const double along = std::hypot(normal.x(), normal.y(), normal.z());
      const double beyond = proof.vector.dot(noise_.mean) - proof.number;
      tail = along > 0.0 ? normalCdf(-beyond / along) : (beyond >= 0.0 ? 0.0 : 1.0);
    } else {
      const double apart = (noise_.mean - proof.vector).norm();
      tail = tailBeyond((proof.number - apart) / noise_.spread);
    }
    (proof.occurs ? first_.lower : first_.upper) = proof.occurs ? 1.0 - tail : tail;
  }
  first_.lower = std::max(0.0, first_.lower - kProbabilityRounding);
  first_.upper = std::min(1.0, first_.upper + kProbabilityRounding);
  const double along = (noise_.factor.transpose() * first.outward).norm();
  if (along > 0.0) first_.estimate = normalCdf(-first.clearance / along);
  first_.estimate = std::clamp(first_.estimate, first_.lower, first_.upper);
  range_ = first_;
}

/// The mean of the nearby normals of the boundary: lines along it cross all of it steeply. Lines
/// along a wall would show little, since no ball on one side of it contains much of them.
void EventIntegral::makeFrame() {
  constexpr double kAround = 1.2;       // standard deviations
  constexpr double kLeastSlope = 1e-3;  // of the spread: a boundary along which the noise is
  Vector3d along = Vector3d::Zero();
  for (int i = 0; i < 7; ++i) {
    const Vector3d z = i == 6 ? Vector3d::Zero()
                              : Vector3d((i % 2 == 0 ? kAround : -kAround) * Vector3d::Unit(i / 2));
    const Finding finding = lookAt(noise_.mean + noise_.factor * z, nullptr);
    const Vector3d normal = noise_.factor.transpose() * finding.outward;
    const double slope = normal.norm();
    if (!(slope > kLeastSlope * noise_.spread)) continue;
    along += normalDensity(finding.clearance / slope) / slope * normal;
  }
  if (!(along.norm() > kLeastSlope)) {
    Eigen::Index largest = 0;
    noise_.factor.colwise().norm().maxCoeff(&largest);
    along = Vector3d::Unit(largest);
  }
  const Matrix3d turn = axisFrame(along);
  // u and v are the noise's axes besides w: if there is no noise along an axis, its lines are all
  // the same.
  Matrix3d axes = noise_.factor * turn;
  const double square = axes.col(0).squaredNorm() - axes.col(1).squaredNorm();
  const double angle = 0.5 * std::atan2(2.0 * axes.col(0).dot(axes.col(1)), square);
  axes *= Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
  frame_ = {noise_.mean, axes, noise_.isConvex};
}

void EventIntegral::makeCells() {
  makeFrame();
  const auto cutsOf = [this](int axis) {
    std::vector<double> cuts(kCuts.begin(), kCuts.end());
    const bool same = frame_.axes.col(axis).norm() <= kLeastWidth * noise_.spread;
    if (same) cuts = {kCuts.front(), kCuts.back()};
    return cuts;
  };
  const std::vector<double> u = cutsOf(0);
  const std::vector<double> v = cutsOf(1);
  for (std::size_t i = 0; i + 1 < u.size(); ++i) {
    for (std::size_t j = 0; j + 1 < v.size(); ++j) {
      LineCell cell = LineCell::of({u[i], v[j]}, {u[i + 1], v[j + 1]});
      cell.certificates = common_;
      bound(frame_, cell);
      push(std::move(cell));
    }
  }
  updateRange();
}

/// m, extent of the probable part of the cell along an axis.
double EventIntegral::width(const LineCell& cell, int axis) const {
  const auto k = static_cast<std::size_t>(axis);
  return std::sqrt(cell.variance[k]) * frame_.axes.col(axis).norm();
}

void EventIntegral::lookAlong(LineCell& cell) {
  cell.looked = true;
  for (int i = 0; i < kLooksAlong; ++i) {
    const LineGap gap = widestGap(frame_, cell);
    const double enough = i == 0 ? 0.0 : kSettled * cell.gap();
    if (!(gap.mass * cell.mass > enough)) break;
    Finding finding;
    const Vector3d position = approach(cell, gap.where, finding);
    const double length = (gap.where.to - gap.where.from) * frame_.way().norm();
    const double wide = std::max(width(cell, 0), width(cell, 1));
    lookBesides(cell, position, finding, std::max(2.0 * wide, 0.5 * length));
  }
  bound(frame_, cell);
}

/// Queries a position in a gap of the middle line, and another where the boundary seems to cross
/// it.
Vector3d EventIntegral::approach(LineCell& cell, const Interval& gap, Finding& finding) {
  const Vector3d origin = frame_.line(cell.mean[0], cell.mean[1]);
  const Vector3d way = frame_.way();
  double w = 0.0;
  if (std::isfinite(gap.from) && std::isfinite(gap.to)) {
    w = 0.5 * (gap.from + gap.to);
  } else {
    w = std::clamp(0.0, gap.from + 1.0, std::max(gap.from + 1.0, gap.to - 1.0));
  }
  finding = lookAt(origin + w * way, &cell);
  const double slope = finding.outward.dot(way);
  const double crossing = w - finding.clearance / slope;
  if (crossing > gap.from && crossing < gap.to &&
      std::abs(finding.clearance) > 0.05 * std::max(width(cell, 0), width(cell, 1))) {
    w = crossing;
    finding = lookAt(origin + w * way, &cell);
  }
  return origin + w * way;
}

/// Balls that touch the boundary from both sides, next to a position: the larger they are, the more
/// of the lines around know where they cross it. Only if the boundary is `within` (m).
void EventIntegral::lookBesides(LineCell& cell, const Vector3d& position, const Finding& finding,
                                double within) {
  if (!(finding.outward.squaredNorm() > 0.0) || !(std::abs(finding.clearance) < within)) return;
  const Vector3d boundary = position - finding.clearance * finding.outward;
  cell.boundary = BoundaryGuess{boundary, finding.outward};
  const Finding deep = lookAt(boundary - depth_ * finding.outward, &cell);
  const bool fits = deep.clearance < -0.9 * depth_;
  depth_ = fits ? 2.0 * depth_ : std::max(-0.9 * deep.clearance, 0.4 * depth_);
  depth_ = std::clamp(depth_, 1e-3 * noise_.spread, 16.0 * noise_.spread);
  const bool isCutOff = finding.proof && !finding.proof->occurs &&
                        finding.proof->form == Certificate::Form::HalfSpace;
  if (!isCutOff) lookAt(boundary + 4.0 * noise_.spread * finding.outward, &cell);
}

std::array<LineCell, 2> EventIntegral::halves(const LineCell& cell, std::size_t axis) const {
  std::array<double, 2> to = cell.to;
  std::array<double, 2> from = cell.from;
  to[axis] = from[axis] = cell.mean[axis];
  std::array<LineCell, 2> parts{LineCell::of(cell.from, to), LineCell::of(from, cell.to)};
  for (LineCell& part : parts) {
    part.certificates = cell.certificates;
    part.boundary = cell.boundary;
    bound(frame_, part);
  }
  return parts;
}

void EventIntegral::split(const LineCell& cell) {
  const std::size_t wide = width(cell, 0) >= width(cell, 1) ? 0 : 1;
  for (LineCell& part : halves(cell, wide)) push(std::move(part));
}

void EventIntegral::push(LineCell cell) {
  least_ += cell.least;
  most_ += cell.most;
  estimate_ += cell.estimate;
  cells_.push_back(std::move(cell));
  std::push_heap(cells_.begin(), cells_.end(), narrower);
}

LineCell EventIntegral::pop() {
  std::pop_heap(cells_.begin(), cells_.end(), narrower);
  LineCell cell = std::move(cells_.back());
  cells_.pop_back();
  least_ -= cell.least;
  most_ -= cell.most;
  estimate_ -= cell.estimate;
  return cell;
}

void EventIntegral::updateRange() {
  const double beyond = 4.0 * normalCdf(kCuts.front());
  range_.lower = std::max(first_.lower, least_ - kProbabilityRounding);
  range_.upper = std::min(first_.upper, most_ + beyond + kProbabilityRounding);
  range_.estimate = std::clamp(estimate_, range_.lower, range_.upper);
}

}  // namespace swept::detail
