// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/continuous/impact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "continuous/corner_paths.hpp"
#include "geometry/error_model.hpp"
#include "narrowphase/exact_sign.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/tolerances.hpp"

/// Conservative advancement with separating directions that turn.
///
/// The differences between points of the two features fill the hull of N corners D_k(t), each of
/// which moves linearly (corner_hull.hpp).
///
/// Lemma (interval). Let n(t) go linearly from n_s at t = s to n_e at t = e, neither longer than 1.
/// No n(t) is longer than 1 either, and n(t) . D_k(t) is a quadratic polynomial of t, with the
/// Bernstein coefficients n_s . D_k(s), (n_s . D_k(e) + n_e . D_k(s)) / 2 and n_e . D_k(e). Where
/// these polynomials exceed the separation for all corners, so does n(t) . x for every x in the
/// hull, and with it the distance. A polynomial with Bernstein coefficients a, b, c,
///   a (1 - r)^2 + 2 b r (1 - r) + c r^2,
/// is positive on [0, 1] if and only if a > 0, c > 0, and b >= 0 or b^2 < a c.
///
/// If n_s and n_e are the directions of the nearest points at s and e, the ends are exact, and what
/// is lost between them is of second order in e - s, also where a face turns about the nearest
/// point: n(t) turns with it. So an interval either is proven in one test, or the polynomials'
/// first root predicts how far it can be; and the time of impact is approached from before, as
/// Newton's method does, but with every step proven.
///
/// Lemma (plane). Let E(t) = D_1 - D_0 and F(t) = D_2 - D_0. N = E x F is across the whole hull, so
/// that N . x is the same cubic polynomial p(t) for each of its points. N(t) is no longer than the
/// Bernstein combination of its coefficients' lengths. So where p(t) less the separation times that
/// has positive coefficients, the features keep the separation. Nothing is lost to corners that
/// move apart from each other: this proves long intervals where almost coplanar features move about
/// next to each other.
///
/// Lemma (rounding). Let u = 2^-53 and R be the largest coordinate of the rounded D_k(0), D_k(1).
/// A difference of inputs rounds by u R; interpolation to t, (1 - t) D_k(0) + t D_k(1) with a
/// rounded 1 - t, by another 4 u R: each coordinate is within 5.1 u R of the truth, so that for a
/// vector n no longer than 1 + 8 u, n . D is within 1.74 * 5.1 u R, and rounds by 3.1 * 1.74 u R:
/// 14.3 u R in all, and the mean of two such by 1.8 u R more. Division by the length of n(t) is by
/// at most 1 + 8 u. So coefficients above (separation + 32 u R) (1 + 16 u) are proof of more than
/// the separation. Distances are those of a convex combination: 9 u R for the corners, less than
/// fifteen operations on numbers below 2 R and weights that sum to 1 within 6 u make them right
/// within 64 u R for two points of the features. With M and K the largest coordinates of E and F:
/// coordinates of these err by 12.3 u R, those of N by less than 25 u R (M + K) + 5 u M K, and
/// coefficients of p, six products of three factors, by less than 74 u R^2 (M + K) + 100 u R M K;
/// 256 u R (R (M + K) + M K) covers that and the error of the lengths of N times a separation below
/// 2 R.
///
/// Lemma (refined plane). The rounded D_k at the ends of an interval, moved linearly, are within
/// 5.1 u R a coordinate of the true ones, and so are the hulls: to keep separation + 32 u R from
/// the rounded hull is enough, whose p is det(D_0, D_1, D_2). In TwoDoubles each of the at most 18
/// products of three factors of a coefficient passes at most two products and five sums, as in
/// exact_sign.hpp: 18 * 31 u^2 R^3 < 2^-96 R^3 in all. R >= 1e-40 dwarfs what underflows. E and F
/// err by u M and u K, N by less than 14 u M K, and twice its second and third coefficients by
/// 35 u M K.
namespace swept {

namespace {

using detail::beyond;
using detail::CornerPaths;
using detail::Corners;
using detail::EdgeEdge;
using detail::lowest;
using detail::Nearness;
using detail::TwoDoubles;
using detail::VertexFace;
using Eigen::Vector3d;

/// Products of six coordinates have to stay in range.
constexpr double kLeastSize = 1e-40;
constexpr double kGreatestSize = 1e40;

/// Growth of the next interval after one that was proven.
constexpr double kGrowth = 8.0;

/// Number of tests after which planes are tried as well.
constexpr int kPatience = 4;

using RefinedVector = std::array<TwoDoubles, 3>;

/// x cross y, plus `sum`.
RefinedVector crossAdded(const RefinedVector& sum, const Vector3d& x, const Vector3d& y) {
  const auto product = [](double a, double b) { return TwoDoubles{a, 0.0} * TwoDoubles{b, 0.0}; };
  RefinedVector cross;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    cross[i] = sum[i] + (product(x[j], y[k]) + product(-x[k], y[j]));
  }
  return cross;
}

TwoDoubles dot(const Vector3d& x, const RefinedVector& y) {
  const auto term = [&](int i) { return TwoDoubles{x[i], 0.0} * y[i]; };
  return term(0) + term(1) + term(2);
}

/// Bernstein coefficients of det(D_0, D_1, D_2), the second and third times 3.
std::array<TwoDoubles, 4> determinantsOf(const Corners& start, const Corners& end) {
  const RefinedVector first = crossAdded({}, start.corner(1), start.corner(2));
  const RefinedVector middle =
      crossAdded(crossAdded({}, start.corner(1), end.corner(2)), end.corner(1), start.corner(2));
  const RefinedVector last = crossAdded({}, end.corner(1), end.corner(2));
  const Vector3d from = start.corner(0);
  const Vector3d to = end.corner(0);
  return {dot(from, first), dot(from, middle) + dot(to, first), dot(to, middle) + dot(from, last),
          dot(to, last)};
}

/// The features at one time.
struct Instant {
  double t;
  Corners corners;
  Nearness nearness;
};

template <class Features>
class ImpactSearch {
 public:
  /// `size` of the paths; all lengths in one unit.
  ImpactSearch(const CornerPaths& paths, double size, double separation, double tolerance)
      : paths_(paths), size_(size) {
    threshold_ = (separation + detail::kImpactRounding * size) * (1.0 + detail::kImpactShare);
    tolerance_ = std::max(tolerance, tolerance::kImpact * size);
    contact_ = separation + tolerance_ - detail::kImpactContact * size;
    aim_ = separation + 0.5 * tolerance_;
  }

  Impact until(double before);

 private:
  void look(double t, Instant& instant) const;
  /// The features at t, or at `last` if that is sooner.
  void lookBefore(double t, double after, const Instant& last, Instant& instant) const;
  bool missesOnAxis(const Corners& end) const {
    return beyond(paths_.start.x, end.x, threshold_) || beyond(paths_.start.y, end.y, threshold_) ||
           beyond(paths_.start.z, end.z, threshold_);
  }
  bool separated(const Instant& from, const Instant& to);
  bool separatedByPlane(const Instant& from, const Instant& to) const;
  bool separatedByRefinedPlane(const Instant& from, const Instant& to,
                               const std::array<double, 4>& lengths) const;
  bool proven(const Instant& from, const Instant& to, bool patient) {
    return separated(from, to) || (patient && separatedByPlane(from, to));
  }
  double contactTime(const Instant& from) const;
  double shorter(const Instant& from, const Instant& to, int failures) const;
  bool inContact(const Instant& instant) const { return instant.nearness.distance <= contact_; }

  const CornerPaths& paths_;
  double size_;
  double threshold_;  ///< a proof must exceed this
  double tolerance_;
  double contact_;                   ///< distances of at most this are contact
  double aim_;                       ///< the distance that steps aim at
  std::array<double, 4> fromAtEnd_;  ///< heights of the later corners along the earlier normal
  std::array<double, 4> toAtStart_;  ///< heights of the earlier corners along the later normal
};

template <class Features>
void ImpactSearch<Features>::look(double t, Instant& instant) const {
  instant.t = t;
  interpolate(paths_, t, instant.corners);
  instant.nearness = Features::nearest(instant.corners);
  const Nearness& found = instant.nearness;
  if (found.distance <= contact_) return;
  // A direction that proves half of the distance is good enough to continue with.
  if (!(lowest(found.heights) - threshold_ >= 0.5 * (found.distance - threshold_))) {
    instant.nearness = Features::nearestOfAnyShape(instant.corners);
  }
}

template <class Features>
void ImpactSearch<Features>::lookBefore(double t, double after, const Instant& last,
                                        Instant& instant) const {
  if (!(t > after)) t = std::nextafter(after, 2.0);
  if (t < last.t) {
    look(t, instant);
  } else {
    instant = last;
  }
}

/// A proof for [from.t, to.t]: the lemma's cases b >= 0 and b^2 < a c, and the directions at both
/// ends.
template <class Features>
bool ImpactSearch<Features>::separated(const Instant& from, const Instant& to) {
  const std::array<double, 4>& a = from.nearness.heights;
  const std::array<double, 4>& c = to.nearness.heights;
  fromAtEnd_ = to.corners.heights(from.nearness.normal);
  toAtStart_ = from.corners.heights(to.nearness.normal);
  const bool freeAtStart = lowest(a) > threshold_;
  const bool freeAtEnd = lowest(c) > threshold_;
  if (freeAtStart && lowest(fromAtEnd_) > threshold_) return true;
  if (freeAtEnd && lowest(toAtStart_) > threshold_) return true;
  if (!(freeAtStart && freeAtEnd)) return false;
  bool all = true;
  for (int k = 0; k < 4; ++k) {
    const double b = 0.5 * (fromAtEnd_[k] + toAtStart_[k]) - threshold_;
    // The products round by less than six roundings.
    all &= b >= 0.0 || b * b < (1.0 - 1e-14) * ((a[k] - threshold_) * (c[k] - threshold_));
  }
  return all;
}

template <class Features>
bool ImpactSearch<Features>::separatedByPlane(const Instant& from, const Instant& to) const {
  const Vector3d start = from.corners.corner(0);
  const Vector3d end = to.corners.corner(0);
  const Vector3d startE = from.corners.corner(1) - start;
  const Vector3d startF = from.corners.corner(2) - start;
  const Vector3d endE = to.corners.corner(1) - end;
  const Vector3d endF = to.corners.corner(2) - end;
  const Vector3d first = startE.cross(startF);
  const Vector3d middle = startE.cross(endF) + endE.cross(startF);  // twice the coefficient
  const Vector3d last = endE.cross(endF);

  const double reachE = startE.cwiseAbs().cwiseMax(endE.cwiseAbs()).maxCoeff();
  const double reachF = startF.cwiseAbs().cwiseMax(endF.cwiseAbs()).maxCoeff();
  const double rounding =
      detail::kImpactVolume * size_ * (size_ * (reachE + reachF) + reachE * reachF);
  const double error = detail::kImpactArea * reachE * reachF;
  const double ends[2] = {threshold_ * (first.norm() + error), threshold_ * (last.norm() + error)};
  const double halfway = threshold_ * (middle.norm() + error);
  const std::array<double, 4> lengths{ends[0], ends[0] + halfway, halfway + ends[1], ends[1]};
  const std::array<double, 4> cubic{first.dot(start), middle.dot(start) + first.dot(end),
                                    middle.dot(end) + last.dot(start), last.dot(end)};
  const double side = cubic[0] < 0.0 ? -1.0 : 1.0;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 4; ++k) least = std::min(least, side * cubic[k] - lengths[k]);
  if (least > 3.0 * rounding) return true;
  return least > -3.0 * rounding && separatedByRefinedPlane(from, to, lengths);
}

/// The same with coefficients that hardly round. `lengths`: what they must exceed.
template <class Features>
bool ImpactSearch<Features>::separatedByRefinedPlane(const Instant& from, const Instant& to,
                                                     const std::array<double, 4>& lengths) const {
  const std::array<TwoDoubles, 4> cubic = determinantsOf(from.corners, to.corners);
  const double rounding = 0x1p-95 * size_ * size_ * size_;
  const double side = cubic[0].high < 0.0 ? -1.0 : 1.0;
  bool all = true;
  for (int k = 0; k < 4; ++k) {
    all &= side * cubic[k].high > (lengths[k] + rounding) * (1.0 + detail::kImpactShare);
  }
  return all;
}

/// When the nearest points would meet at their present speed of approach.
template <class Features>
double ImpactSearch<Features>::contactTime(const Instant& from) const {
  const Nearness& near = from.nearness;
  const Vector3d velocity =
      paths_.end.combination(near.weights) - paths_.start.combination(near.weights);
  const double rate = near.normal.dot(velocity);
  if (!(rate < 0.0)) return std::numeric_limits<double>::infinity();
  return from.t - (near.distance - aim_) / rate;
}

/// An end of the interval that is more likely to be proven: the first root of the polynomials, or
/// the range that one of the two directions proves alone. Only the latter is certain to be proven,
/// so it remains after repeated failures.
template <class Features>
double ImpactSearch<Features>::shorter(const Instant& from, const Instant& to, int failures) const {
  const std::array<double, 4>& a = from.nearness.heights;
  const std::array<double, 4>& c = to.nearness.heights;
  double turning = 1.0;
  double fixed = 1.0;
  double later = lowest(toAtStart_) > aim_ ? 1.0 : 0.0;
  for (int k = 0; k < 4; ++k) {
    const double start = std::max(a[k] - aim_, 0.25 * (a[k] - threshold_));
    const double b = 0.5 * (fromAtEnd_[k] + toAtStart_[k]) - aim_;
    const double end = c[k] - aim_;
    const double discriminant = b * b - start * end;
    if ((b < 0.0 || end < 0.0) && discriminant >= 0.0) {
      turning = std::min(turning, start / (start - b + std::sqrt(discriminant)));
    }
    const double loss = a[k] - fromAtEnd_[k];
    if (loss > 0.0) fixed = std::min(fixed, 0.5 * (a[k] - threshold_) / loss);
    if (end < 0.0) later = std::min(later, (toAtStart_[k] - aim_) / (toAtStart_[k] - c[k]));
  }
  double part = std::max(turning, std::max(fixed, later));
  if (failures > 2) part = std::max(fixed, std::min(part, 0.5));
  if (failures > 6) part = fixed;
  if (!(part < 1.0)) part = 0.5;
  return from.t + part * (to.t - from.t);
}

template <class Features>
Impact ImpactSearch<Features>::until(double before) {
  Corners end;
  interpolate(paths_, before, end);
  if (missesOnAxis(end)) return {Verdict::Free, before, 1.0};

  Instant here;
  look(0.0, here);
  if (inContact(here)) return {Verdict::Collision, 0.0, 0.0};
  Instant last;
  look(before, last);
  double speed = 0.0;
  for (int k = 0; k < 4; ++k) {
    speed = std::max(speed, (paths_.end.corner(k) - paths_.start.corner(k)).squaredNorm());
  }
  speed = std::sqrt(speed);

  Instant next = last;
  int failures = 0;
  for (int tests = 0; tests < tolerance::kMaxImpactTests; ++tests) {
    const bool patient = tests >= kPatience;
    if (proven(here, next, patient)) {
      if (next.t == before) return {Verdict::Free, before, 1.0};
      if (inContact(next)) return {Verdict::Collision, next.t, next.t};
      const double longer = next.t + kGrowth * (next.t - here.t);
      here = next;
      failures = 0;
      const double contact = contactTime(here);
      if (contact >= before && proven(here, last, patient)) return {Verdict::Free, before, 1.0};
      lookBefore(std::min(contact, longer), here.t, last, next);
    } else {
      if (inContact(next) && (next.t - here.t) * speed <= tolerance_) {
        return {Verdict::Collision, here.t, next.t};
      }
      ++failures;
      lookBefore(shorter(here, next, failures), here.t, last, next);
    }
  }
  return {Verdict::Undecided, here.t, 1.0};
}

template <class Features, class Fill>
Impact impactOf(const Fill& fill, const ImpactOptions& options) {
  double separation = std::max(0.0, options.separation);
  double tolerance = std::max(0.0, options.tolerance);
  if (!std::isfinite(options.separation + 0.0 * options.tolerance + 0.0 * options.before)) {
    return {};
  }
  const double before = std::clamp(options.before, 0.0, 1.0);
  CornerPaths paths;
  fill(paths, 1.0);
  double size = sizeOf(paths);
  if (!(size >= kLeastSize && size <= kGreatestSize)) {
    double scale = 1.0;
    if (!std::isfinite(size)) {
      // Either an input is not finite, or a difference overflowed.
      scale = 0.0625;
      fill(paths, scale);
      size = sizeOf(paths);
      if (!std::isfinite(size)) return {};
    }
    const double most = std::max(size, scale * separation);
    if (most > 0.0) {
      const double more = std::ldexp(1.0, -std::clamp(std::ilogb(most), -1000, 1000));
      rescale(paths.start, more);
      rescale(paths.end, more);
      size *= more;
      separation *= scale * more;
      tolerance *= scale * more;
    }
  }
  return ImpactSearch<Features>(paths, size, separation, tolerance).until(before);
}

}  // namespace

Impact vertexFaceImpact(const LinearPath& vertex, const std::array<LinearPath, 3>& face,
                        const ImpactOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return vertexFaceImpact(vertex, face, options); });
  }
  const auto fill = [&](CornerPaths& paths, double scale) {
    for (int k = 0; k < 4; ++k) setCorner(paths, k, vertex, face[k % 3], scale);
  };
  return impactOf<VertexFace>(fill, options);
}

Impact edgeEdgeImpact(const std::array<LinearPath, 2>& first,
                      const std::array<LinearPath, 2>& second, const ImpactOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return edgeEdgeImpact(first, second, options); });
  }
  const auto fill = [&](CornerPaths& paths, double scale) {
    for (int k = 0; k < 4; ++k) setCorner(paths, k, first[k % 2], second[k / 2], scale);
  };
  return impactOf<EdgeEdge>(fill, options);
}

}  // namespace swept
