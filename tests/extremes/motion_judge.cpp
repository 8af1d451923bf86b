// SPDX-License-Identifier: BSD-3-Clause
#include "core/error_table_reproducer.hpp"
#include "pair_judge.hpp"
#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/continuous/motions.hpp"

namespace extremes {

namespace {

using error_table::Feature;
using error_table::length;
using error_table::real;
using error_table::Reproducer;
using error_table::rounded;
using error_table::Touch;

/// Relative to the larger solid: the tolerance that is asked for.
constexpr double kAskedOfMotions = 1e-6;

/// Relative to the world's coordinates: two poses, each rounded as tolerance::kRoundingPerJoint
/// says.
constexpr double kWorldRounding = 2.0 * swept::tolerance::kRoundingPerJoint;

/// Relative to the extent of b: the library makes its turn the nearest rotation.
constexpr double kNearestRotation = 1e-15;

/// Where b is at the start, and where it goes to.
struct Slide {
  Point start;         ///< m, from the touch
  Point displacement;  ///< m
  Real gap;            ///< m, between the support planes at the start
  Real approach;       ///< m, along the normal, of the whole motion
  Vector3d position;   ///< m, world
  Vector3d rounded;    ///< m, the displacement
};

Slide slideOf(const Sample& sample, const Real& gap, const Real& approach) {
  const Touch& touch = *sample.touch;
  const Point a = real(sample.place);
  Slide slide;
  slide.position = rounded(a + touch.shift + touch.n * gap);
  slide.rounded = rounded(touch.n * -approach);
  slide.start = real(slide.position) - a - touch.shift;
  slide.displacement = real(slide.rounded);
  slide.gap = touch.n.dot(slide.start);
  slide.approach = -touch.n.dot(slide.displacement);
  return slide;
}

/// m, the least height of a face.
double leastHeight(const Body& body) {
  double least = body.faces.empty() ? 0.0 : body.extent;
  for (const Eigen::Vector3i& f : body.faces) {
    const Vector3d u = body.points[f[1]] - body.points[f[0]];
    const Vector3d v = body.points[f[2]] - body.points[f[0]];
    const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
    least = std::min(least, u.cross(v).norm() / longest);
  }
  return least;
}

/// What is known about the contact of two that touch `aside` (m) of the touch.
struct Hit {
  Real lag;      ///< m. So much deeper than the support planes say the two do touch
  Real lasting;  ///< m. So much deeper they still do
};

std::optional<Hit> hitOf(const Sample& sample, const Real& aside) {
  const Body& a = sample.a.body;
  const Body& b = sample.b.body;
  if (a.isFlat() || b.isFlat()) return Hit{0, std::numeric_limits<double>::infinity()};
  // A ball inside touches the same point.
  const Real rolling = a.rolling + b.rolling;
  if (rolling > 0 && aside < rolling / 2) return Hit{aside * aside / rolling, rolling};
  // A corner or more of the other is above the inside of a face.
  for (const auto& [body, feature] :
       {std::pair(&a, sample.touch->featureA), std::pair(&b, sample.touch->featureB)}) {
    const double height = leastHeight(*body);
    if (feature != Feature::Face || body->radius > 0.0 || !(aside < 1e-4 * height)) continue;
    return Hit{0, sample.thickness > 0.0 ? sample.thickness : 1e-2 * height};
  }
  return std::nullopt;
}

struct Expected {
  bool hits = false;
  Real from, by;     ///< of t: the first contact is between them
  Real least;        ///< m, the gap that is left
  Real lasting;      ///< m, the contact is known to last so long, of the way along the normal
  double rounding;   ///< m
  double turning;    ///< m
  double tolerance;  ///< m
};

Outcome outcomeOf(const swept::ContinuousResult& found, const Expected& expected,
                  const Real& approach) {
  const Real near = expected.tolerance + expected.rounding;
  if (found.verdict == swept::Verdict::Undecided) {
    const Real clear = expected.hits ? expected.lasting : expected.least;
    return clear <= near ? Outcome::Undecided : Outcome::Far;
  }
  if (!expected.hits) {
    if (found.verdict == swept::Verdict::Free) return Outcome::Right;
    return expected.least <= expected.rounding ? Outcome::Undecided : Outcome::Wrong;
  }
  if (found.verdict == swept::Verdict::Free) return Outcome::Wrong;
  const Real late = (Real(found.contactBy) - expected.by) * approach;
  return late <= 2 * near ? Outcome::Right : Outcome::Far;
}

std::string describe(const Sample& sample, const Slide& slide, const Expected& expected,
                     const swept::ContinuousResult& found) {
  const auto vector = [](const Vector3d& v) { return Reproducer::numbers({v.x(), v.y(), v.z()}); };
  return Reproducer::of(sample.a.shape, sample.b.shape, sample.pose) + "  // a stays at " +
         vector(sample.place) + ", b goes from " + vector(slide.position) + " by " +
         vector(slide.rounded) + ", tolerance " + Reproducer::number(expected.tolerance) +
         ": continuousCollide gives " + std::string(swept::toString(found.verdict)) +
         ", free until " + Reproducer::number(found.freeUntil) + ", contact by " +
         Reproducer::number(found.contactBy) + "; the truth is " +
         (expected.hits ? "contact in [" + expected.from.str(25) + ", " + expected.by.str(25) + "]"
                        : "a gap of " + expected.least.str(25)) +
         "\n";
}

double spanOf(const Sample& sample) {
  return sample.span > 0.0 ? sample.span : std::max(sample.a.body.extent, sample.b.body.extent);
}

Slide drawSlide(const Sample& sample, bool hits, Random& random) {
  const double gap = spanOf(sample) * random.decades(-2.0, 0.5);
  const double end = spanOf(sample) * random.decades(-4.0, -1.0);
  if (hits) return slideOf(sample, gap, gap + end);
  const bool retreats = random.chance(0.3);
  return slideOf(sample, gap + end, retreats ? -end : gap);
}

}  // namespace

std::optional<Answer> judgeContinuous(const Sample& sample, Random& random) {
  if (!sample.touch) return std::nullopt;
  const bool hits = random.chance(0.5);
  const Slide slide = drawSlide(sample, hits, random);
  const Point n = sample.touch->n;
  const Real share = hits ? Real(slide.gap / slide.approach) : Real(0);
  const Point there = slide.start + slide.displacement * share;
  const std::optional<Hit> hit = hitOf(sample, length(there - n * n.dot(there)));
  if (!hit) return std::nullopt;
  Expected expected;
  expected.hits = hits;
  expected.from = share;
  expected.by = hits ? Real((slide.gap + hit->lag) / slide.approach) : Real(0);
  expected.least = std::min(slide.gap, Real(slide.gap - slide.approach));
  expected.lasting = std::min(hit->lasting, Real(slide.approach - slide.gap));
  expected.rounding = sample.rounding() + kWorldRounding * sample.place.norm();
  expected.turning = kNearestRotation * sample.b.body.extent;
  expected.tolerance = kAskedOfMotions * spanOf(sample);
  Isometry3d start = Isometry3d::Identity();
  start.linear() = sample.touch->linear;
  start.translation() = slide.position;
  const auto still = swept::UniformMotion::still(Isometry3d(Eigen::Translation3d(sample.place)));
  const auto moving = swept::UniformMotion::translation(start, slide.rounded);
  swept::ContinuousOptions options;
  options.tolerance = expected.tolerance;
  Answer answer;
  const swept::ContinuousResult found = timed(
      [&] {
        return swept::continuousCollide(sample.a.shape, still, sample.b.shape, moving, options);
      },
      answer.seconds);
  answer.apart = !hits;
  answer.work = found.effort.intervals + found.effort.volumeTests + found.effort.leafTests;
  answer.outcome = outcomeOf(found, expected, slide.approach);
  if (hits) {
    const Real slack = expected.turning / slide.approach;
    const Real rounding = expected.rounding / slide.approach;
    const bool seen = found.verdict == swept::Verdict::Collision;
    answer.honest = Real(found.freeUntil) <= expected.by + slack &&
                    (!seen || Real(found.contactBy) >= expected.from - rounding);
    const Real scale = slide.approach / sample.size();
    if (seen) {
      const Real error = std::max(Real(0), Real(found.contactBy - expected.by)) * scale;
      answer.error = error.convert_to<double>();
      answer.bound = Real((Real(found.contactBy) - found.freeUntil) * scale).convert_to<double>();
    }
  }
  if (!answer.honest) answer.outcome = Outcome::Wrong;
  if (answer.outcome != Outcome::Right) answer.text = describe(sample, slide, expected, found);
  return answer;
}

}  // namespace extremes
