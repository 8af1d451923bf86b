// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "sample.hpp"

namespace extremes {

using namespace error_table;

namespace {

/// A way out along a direction, in double precision, and the direction in 50 digits.
struct Candidate {
  Point normal;
  double overlap;
};

class WaysOut {
 public:
  WaysOut(const Body& a, const Body& b, const Isometry3d& pose)
      : turn_(pose.linear()), pose_(pose), a_(a), b_(b) {
    for (const Vector3d& p : a.points) scale_ = std::max(scale_, p.norm());
    for (const Vector3d& p : b.points) moved_.push_back(pose * p);
    for (const Vector3d& p : moved_) scale_ = std::max(scale_, p.norm());
  }

  Real least() {
    for (const Eigen::Vector3i& f : a_.faces) add(normalOf(a_, f));
    for (const Eigen::Vector3i& f : b_.faces) add(turn_.normal(normalOf(b_, f)));
    for (const Body::Edge& u : a_.edges) {
      const Point along = edgeOf(a_, u);
      for (const Body::Edge& v : b_.edges) add(along.cross(turn_ * edgeOf(b_, v)));
    }
    double nearest = std::numeric_limits<double>::infinity();
    for (const Candidate& c : candidates_) nearest = std::min(nearest, c.overlap);
    // Flat, or on a line: nothing is between it and the outside.
    Real best = candidates_.empty() ? 0 : std::numeric_limits<double>::infinity();
    for (const Candidate& c : candidates_) {
      if (c.overlap < nearest + 1e-12 * scale_) best = std::min(best, exactly(c.normal));
    }
    return best;
  }

 private:
  static Point edgeOf(const Body& body, const Body::Edge& edge) {
    return real(body.points[edge.to]) - real(body.points[edge.from]);
  }
  static Point normalOf(const Body& body, const Eigen::Vector3i& f) {
    const Point p = real(body.points[f[0]]);
    return (real(body.points[f[1]]) - p).cross(real(body.points[f[2]]) - p);
  }

  void add(const Point& n) {
    if (n.dot(n) == 0) return;
    const Point exact = unit(n);
    const Vector3d near = rounded(exact);
    double aLow = std::numeric_limits<double>::infinity(), aHigh = -aLow, bLow = aLow,
           bHigh = -aLow;
    for (const Vector3d& p : a_.points) {
      aLow = std::min(aLow, near.dot(p));
      aHigh = std::max(aHigh, near.dot(p));
    }
    for (const Vector3d& p : moved_) {
      bLow = std::min(bLow, near.dot(p));
      bHigh = std::max(bHigh, near.dot(p));
    }
    candidates_.push_back({exact, aHigh - bLow});
    candidates_.push_back({exact * Real(-1), bHigh - aLow});
  }

  Real exactly(const Point& n) const {
    const Real infinity = std::numeric_limits<double>::infinity();
    const Point back = turn_.transposed(n);
    Real high = -infinity;
    Real low = infinity;
    for (const Vector3d& p : a_.points) high = std::max(high, n.dot(real(p)));
    for (const Vector3d& p : b_.points) low = std::min(low, back.dot(real(p)));
    return high - low - n.dot(real(Vector3d(pose_.translation())));
  }

  ExactTurn turn_;
  const Isometry3d& pose_;
  const Body& a_;
  const Body& b_;
  std::vector<Vector3d> moved_;
  double scale_ = 0.0;
  std::vector<Candidate> candidates_;
};

}  // namespace

Real depthOf(const Body& a, const Body& b, const Isometry3d& pose) {
  return WaysOut(a, b, pose).least();
}

}  // namespace extremes
