// SPDX-License-Identifier: BSD-3-Clause
#include "pair_judge.hpp"

#include "core/error_table_reproducer.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"

namespace extremes {

namespace {

using error_table::Reproducer;

/// Relative to the size: the tolerance that queries are asked for.
constexpr double kAsked = 1e-13;

/// Likewise: depths of meshes come from their parts, and are not asked for more closely.
constexpr double kMeshDepth = 1e-11;

double relative(const Sample& sample, const Real& length) {
  const double size = sample.size();
  return size > 0.0 ? (length / size).convert_to<double>() : 0.0;
}

std::string describe(const Sample& sample, const std::string& found) {
  return Reproducer::of(sample.a.shape, sample.b.shape, sample.pose) + "  // " + found +
         "; the truth is in [" + sample.truth.lower.str(25) + ", " + sample.truth.upper.str(25) +
         "]\n";
}

std::string textOf(const char* query, double lower, double upper) {
  return std::string(query) + " gives [" + Reproducer::number(lower) + ", " +
         Reproducer::number(upper) + "]";
}

/// How far `value` is from where the truth may be.
Real off(double value, const Truth& truth) {
  return std::max({Real(0), Real(value - truth.upper), Real(truth.lower - value)});
}

/// `tolerance`: m, within which an interval need not tell on which side of zero the truth is.
template <class Result>
Answer judgeInterval(const Result& found, const Truth& truth, const Sample& sample,
                     double tolerance) {
  Answer answer;
  answer.work = found.iterations;
  if (!(std::isfinite(found.lower) && std::isfinite(found.upper) && found.lower <= found.upper)) {
    answer.outcome = Outcome::Wrong;
    answer.honest = false;
    return answer;
  }
  answer.bound = relative(sample, Real(found.upper) - Real(found.lower));
  answer.error = relative(sample, off(found.upper, truth));
  // The points that witness a distance are rounded; a depth is proven on both sides.
  const Real rounded = truth.upper < -sample.rounding() ? Real(0) : Real(sample.rounding());
  answer.honest = Real(found.lower) <= truth.upper && Real(found.upper) >= truth.lower - rounded;
  if (!answer.honest) {
    answer.outcome = Outcome::Wrong;
    return answer;
  }
  const bool told = truth.lower > 0   ? found.lower > 0.0
                    : truth.upper < 0 ? found.upper < 0.0
                                      : found.upper <= tolerance;
  const Real nearest = std::max({Real(0), truth.lower, Real(-truth.upper)});
  if (!told) answer.outcome = nearest <= tolerance ? Outcome::Undecided : Outcome::Far;
  return answer;
}

}  // namespace

Answer judgeCollide(const Sample& sample) {
  Answer answer;
  const swept::Contact found = timed(
      [&] { return swept::collide(sample.a.shape, sample.b.shape, sample.pose); }, answer.seconds);
  const Truth& truth = sample.truth;
  answer.apart = truth.lower > 0;
  const Real nearest = std::max({Real(0), truth.lower, Real(-truth.upper)});
  const bool within = nearest <= sample.rounding();
  switch (found) {
    case swept::Contact::Separate:
      answer.outcome = truth.upper > 0 ? Outcome::Right : Outcome::Wrong;
      answer.honest = truth.upper > 0;
      break;
    case swept::Contact::Touching:
      if (truth.lower > 0) answer.outcome = within ? Outcome::Undecided : Outcome::Wrong;
      break;
    case swept::Contact::Unknown:
      answer.outcome = within ? Outcome::Undecided : Outcome::Far;
      break;
  }
  if (answer.outcome != Outcome::Right) {
    answer.text =
        describe(sample, "collide gives Contact " + std::to_string(static_cast<int>(found)));
  }
  return answer;
}

Answer judgeDistance(const Sample& sample) {
  swept::DistanceOptions options;
  options.tolerance = kAsked * sample.size();
  double seconds = 0.0;
  const swept::DistanceResult found =
      timed([&] { return swept::distance(sample.a.shape, sample.b.shape, sample.pose, options); },
            seconds);
  const Real zero = 0;
  Truth apart{std::max(zero, sample.truth.lower), std::max(zero, sample.truth.upper)};
  Answer answer = judgeInterval(found, apart, sample, options.tolerance + sample.rounding());
  answer.seconds = seconds;
  answer.apart = sample.truth.lower > 0;
  if (answer.outcome != Outcome::Right) {
    answer.text = describe(sample, textOf("distance", found.lower, found.upper));
  }
  return answer;
}

Answer judgeSignedDistance(const Sample& sample) {
  const double tolerance = kAsked * sample.size();
  const bool mesh = std::holds_alternative<swept::TriangleMesh>(sample.a.shape) ||
                    std::holds_alternative<swept::TriangleMesh>(sample.b.shape);
  double seconds = 0.0;
  const swept::SignedDistanceResult found = timed(
      [&] { return swept::signedDistance(sample.a.shape, sample.b.shape, sample.pose, tolerance); },
      seconds);
  Answer answer =
      judgeInterval(found, sample.truth, sample,
                    sample.rounding() + (mesh ? kMeshDepth * sample.size() : tolerance));
  answer.seconds = seconds;
  answer.apart = sample.truth.lower > 0;
  if (answer.outcome != Outcome::Right) {
    answer.text = describe(sample, textOf("signedDistance", found.lower, found.upper));
  }
  return answer;
}

}  // namespace extremes
