// SPDX-License-Identifier: BSD-3-Clause
#include "point_cloud/quadratic_form.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "swept/core/collision_probability.hpp"

namespace swept::detail {

namespace {

using Eigen::Array3d;

constexpr std::size_t kTerms = 256;
constexpr double kLeastRatio =
    1e-3;                            // of variances: what is closer to singular has no short series
constexpr double kExponent = 600.0;  // beyond, the first weight would underflow

/// Chi-square distributions of 3, 5, 7, ... degrees of freedom at x, one after the other.
class ChiSquare {
 public:
  explicit ChiSquare(double x)
      : x_(x),
        value_(std::erf(std::sqrt(0.5 * x))),
        term_(std::sqrt(2.0 * x / std::numbers::pi) * std::exp(-0.5 * x)) {
    next();
  }
  double value() const { return std::max(0.0, value_); }
  void next() {  // each has one term of the incomplete gamma function's series less
    value_ -= term_;
    degrees_ += 2.0;
    term_ *= x_ / degrees_;
  }

 private:
  double x_;
  double value_;
  double term_;
  double degrees_ = 1.0;
};

/// The weights of the series; each depends on all before it.
class Weights {
 public:
  Weights(const Array3d& variances, const Array3d& shifts)
      : share_(variances.minCoeff() / variances), shifts_(shifts) {
    weights_[0] = std::exp(-0.5 * shifts.sum()) * std::sqrt(share_.prod());
  }
  double next() {
    if (count_ > 0) {
      const auto k = static_cast<double>(count_);
      const Array3d before = powers_;
      powers_ *= 1.0 - share_;
      moments_[count_] = 0.5 * (powers_.sum() + k * (shifts_ * share_ * before).sum());
      double sum = 0.0;
      for (std::size_t r = 0; r < count_; ++r) sum += moments_[count_ - r] * weights_[r];
      weights_[count_] = sum / k;
    }
    return weights_[count_++];
  }

 private:
  Array3d share_;   ///< least variance over each
  Array3d shifts_;  ///< squared means over variances
  Array3d powers_ = Array3d::Ones();
  std::array<double, kTerms> moments_{};
  std::array<double, kTerms> weights_{};
  std::size_t count_ = 0;
};

}  // namespace

ProbabilityRange withinBall(const Eigen::Vector3d& mean, const Eigen::Matrix3d& covariance,
                            double radius, double rounding) {
  const double size = covariance.cwiseAbs().maxCoeff();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance / size);
  const Array3d variances = size * solver.eigenvalues().array();
  const double least = variances.minCoeff();
  if (!(least > kLeastRatio * variances.maxCoeff())) return {};
  const Array3d shifts = (solver.eigenvectors().transpose() * mean).array().square() / variances;
  if (!(shifts.sum() < kExponent)) return {};

  Weights weights(variances, shifts);
  ChiSquare chiSquare(radius / least * radius);
  double sum = 0.0;
  double left = 1.0;
  for (std::size_t k = 0; k < kTerms && left * chiSquare.value() > kProbabilityRounding; ++k) {
    const double weight = weights.next();
    sum += weight * chiSquare.value();
    left -= weight;
    chiSquare.next();
  }
  const double error = 10.0 * kProbabilityRounding + rounding / std::sqrt(least);
  const double rest = std::max(0.0, left) * chiSquare.value();
  ProbabilityRange range;
  range.lower = std::clamp(sum - error, 0.0, 1.0);
  range.upper = std::clamp(sum + rest + error, 0.0, 1.0);
  range.estimate = std::clamp(sum + 0.5 * rest, range.lower, range.upper);
  return range;
}

}  // namespace swept::detail
