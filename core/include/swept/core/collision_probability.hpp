// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "swept/core/shapes.hpp"

namespace swept {

namespace detail {
struct NoisyCloudData;
}

/// Balls whose centres are known up to noise, as a depth camera measures them.
///
/// The true centre of ball i is points[i] + n_i, where n_i is Gaussian with mean zero and
/// covariances[i], independent of all others. A covariance may be zero (the point is known) or of
/// lower rank (the point is known across some directions, as along a camera's ray). Immutable;
/// copies share the data.
///
/// The cloud stores factors F of the covariances. F F^T equals the given matrix up to 1e-14 of its
/// largest entry, and the queries use F F^T as the noise.
class NoisyPointCloud {
 public:
  /// Points in m, radii in m, covariances in m^2, in the order given and in the cloud's frame.
  /// Throws std::invalid_argument, naming the index and the value, unless there is at least one
  /// point, the spans are equally long, everything is finite, radii are not negative, and
  /// covariances are symmetric and positive semidefinite (both up to 1e-12 of the largest entry).
  static NoisyPointCloud build(std::span<const Eigen::Vector3d> points,
                               std::span<const double> radii,
                               std::span<const Eigen::Matrix3d> covariances);
  /// One radius (m) for all points, and noise of the same standard deviation (m) in all directions.
  /// Throws likewise.
  static NoisyPointCloud build(std::span<const Eigen::Vector3d> points, double radius,
                               double standardDeviation);

  /// Number of points, at least one.
  std::size_t size() const;
  /// For the queries.
  const detail::NoisyCloudData& data() const { return *data_; }

 private:
  explicit NoisyPointCloud(std::shared_ptr<const detail::NoisyCloudData> data)
      : data_(std::move(data)) {}
  std::shared_ptr<const detail::NoisyCloudData> data_;
};

/// The accuracy wanted, and the effort allowed.
struct CollisionProbabilityOptions {
  /// Probability. The query stops when upper - lower is at most this. Between two clouds, where
  /// that may be out of reach, it also stops when three standard errors are at most this. Zero or
  /// NaN: it uses all the effort.
  double accuracy = 0.01;
  int maxLooks = 1 << 18;    ///< distances from points to the other body, or to another ball
  int maxSamples = 1 << 16;  ///< samples of groups of points, between two clouds
  std::uint64_t seed = 1;    ///< of these samples; the same seed gives the same bits
};

/// The effort of a query.
struct ProbabilityEffort {
  int nodes = 0;  ///< of the hierarchies: boxes (or pairs of boxes) bounded against the other body
  int near = 0;   ///< points (or pairs of points) that no box settled
  int looks = 0;  ///< distances from a point to the other body, or to another ball
  int samples = 0;  ///< samples of groups of points that depend on each other
};

/// The probability that two bodies touch, at the true positions of noisy points.
struct CollisionProbability {
  /// Estimate, within the bounds. Its error is at most the accuracy if the bounds are that close.
  double probability = 0.5;
  /// lower <= true probability <= upper, proven as distances are: rounding of the geometry
  /// included, that of the normal distribution's values up to kProbabilityRounding.
  double lower = 0.0;
  double upper = 1.0;  ///< includes the tails of far points, up to 1e-9 together
  /// Standard error of `probability` as an estimate from samples; 0 without samples. It widens no
  /// bound and proves nothing.
  double standardError = 0.0;
  ProbabilityEffort effort;  ///< spent, whether or not the accuracy was reached
};

/// Probability. The bounds of each point or pair are widened by this, for the roundings of erfc,
/// exp and of the sums over some thousand cells. If it were smaller, rounding could make the bounds
/// wrong.
inline constexpr double kProbabilityRounding = 1e-12;

/// The probability that some ball of the cloud touches `b`, at the true centres. Touching is
/// contact, and closed components of a mesh are solid, as everywhere.
///
/// Points are independent, so the probability is 1 - prod(1 - p_i). Each p_i is the integral of a
/// Gaussian over the points at most the radius away from `b`. Balls and half-spaces that are proven
/// to be inside or outside that set bound it from both sides. Without noise the answer is that of
/// collide(): 0 or 1 exactly, [0, 1] if that is Unknown.
///
/// `a_from_b` is the pose of b in the cloud's frame; a non-finite pose gives [0, 1]. Memory grows
/// with the number of points near b.
///
/// Pan, Chitta, Manocha: Probabilistic Collision Detection between Noisy Point Clouds using Robust
/// Classification, ISRR 2011, also give the points of two noisy clouds collision probabilities.
/// They treat the clouds as samples of two bodies and learn to tell these apart. Here the balls are
/// the body, and the probability is that of the event above.
CollisionProbability collisionProbability(const NoisyPointCloud& a, const Shape& b,
                                          const Eigen::Isometry3d& a_from_b,
                                          const CollisionProbabilityOptions& options = {});

/// The probability that some ball of `a` touches some ball of `b`, with the noise of both.
/// `a_from_b` is the pose of b in a's frame.
///
/// Pairs of points that may meet form a graph, whose connected groups are independent. A group of
/// one pair is integrated as above, or has a closed form. In a larger group, pairs depend on each
/// other. Pairs without a common point are independent, and bound the probability from below. For
/// an upper bound, the pairs are split into sets of such pairs, and the sets are added up. If these
/// bounds are farther apart than the accuracy, positions are sampled to get an estimate. Memory
/// grows with the number of pairs that may meet.
CollisionProbability collisionProbability(const NoisyPointCloud& a, const NoisyPointCloud& b,
                                          const Eigen::Isometry3d& a_from_b,
                                          const CollisionProbabilityOptions& options = {});

/// Whether a probability is above a threshold.
enum class Exceeds : std::uint8_t {
  Undecided,  ///< within the accuracy of the threshold, or the effort is spent
  No,         ///< proven: the probability is at most the threshold
  Yes,        ///< proven: it is greater
};

/// The answer, and the bounds that gave it.
struct ThresholdResult {
  Exceeds answer = Exceeds::Undecided;  ///< Undecided unless a bound proves it
  double lower = 0.0;                   ///< as in CollisionProbability
  double upper = 1.0;                   ///< likewise
  ProbabilityEffort effort;             ///< spent until the bounds decided
};

/// Whether the probability exceeds a threshold. Stops as soon as the bounds decide, much sooner
/// than collisionProbability(). It draws no samples, since they prove nothing. A NaN as threshold
/// gives Undecided.
ThresholdResult probabilityExceeds(const NoisyPointCloud& a, const Shape& b,
                                   const Eigen::Isometry3d& a_from_b, double threshold,
                                   const CollisionProbabilityOptions& options = {});
/// The same for two clouds, with the noise of both.
ThresholdResult probabilityExceeds(const NoisyPointCloud& a, const NoisyPointCloud& b,
                                   const Eigen::Isometry3d& a_from_b, double threshold,
                                   const CollisionProbabilityOptions& options = {});

}  // namespace swept
