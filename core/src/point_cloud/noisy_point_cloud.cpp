// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

#include "geometry/point_text.hpp"
#include "point_cloud/noisy_cloud_data.hpp"
#include "swept/core/collision_probability.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kSymmetry = 1e-12;  // of the largest entry
constexpr int kLeafPoints = 4;

[[noreturn]] void refuse(const std::ostringstream& message) {
  throw std::invalid_argument(message.str());
}

void requireFinite(std::span<const Vector3d> points) {
  std::ostringstream message;
  if (points.empty()) {
    message << "noisy point cloud has no points";
    refuse(message);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].allFinite()) continue;
    message << "point " << i << " of the noisy point cloud is " << detail::pointText(points[i])
            << "; allowed: finite coordinates";
    refuse(message);
  }
}

void requireAsMany(std::size_t points, std::size_t given, const char* what) {
  if (given == points) return;
  std::ostringstream message;
  message << "noisy point cloud has " << points << " points, but " << given << ' ' << what;
  refuse(message);
}

void requireLength(double length, const std::string& name) {
  if (length >= 0.0 && std::isfinite(length)) return;
  std::ostringstream message;
  message << name << " of the noisy point cloud is " << length
          << "; allowed: finite and not negative";
  refuse(message);
}

void requireCovariance(const Matrix3d& covariance, std::size_t index) {
  std::ostringstream message;
  message << "covariance " << index << " of the noisy point cloud ";
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 3; ++column) {
      if (std::isfinite(covariance(row, column))) continue;
      message << "has " << covariance(row, column) << " at (" << row << ", " << column
              << "); allowed: finite";
      refuse(message);
    }
  }
  const double most = covariance.cwiseAbs().maxCoeff();
  for (int row = 0; row < 3; ++row) {
    for (int column = row + 1; column < 3; ++column) {
      const double one = covariance(row, column);
      const double other = covariance(column, row);
      if (std::abs(one / most - other / most) <= kSymmetry || one == other) continue;
      message << "is not symmetric: " << one << " at (" << row << ", " << column << "), " << other
              << " at (" << column << ", " << row << ')';
      refuse(message);
    }
  }
  if (most == 0.0) return;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(covariance / most, Eigen::EigenvaluesOnly);
  const double least = solver.eigenvalues().minCoeff();
  if (least >= -kSymmetry) return;
  message << "is not positive semidefinite: least eigenvalue " << least * most;
  refuse(message);
}

std::shared_ptr<const detail::NoisyCloudData> withTree(detail::NoisyCloudData data) {
  const std::size_t count = data.points.size();
  data.spreads.resize(count, detail::spreadOf(data.factor(0)));
  for (std::size_t i = 1; i < data.factors.size(); ++i) {
    data.spreads[i] = detail::spreadOf(data.factors[i]);
  }
  data.tree = BvTree<Aabb>::build({data.points}, MedianSplit{}, defaultFit<Aabb>(), kLeafPoints);
  const auto& nodes = data.tree.nodes();
  data.nodeRadius.assign(nodes.size(), 0.0);
  data.nodeSpread.assign(nodes.size(), 0.0);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (!nodes[n].isLeaf()) continue;
    for (int slot = nodes[n].first; slot < nodes[n].first + nodes[n].count; ++slot) {
      const auto i = static_cast<std::size_t>(data.tree.order()[static_cast<std::size_t>(slot)]);
      data.nodeRadius[n] = std::max(data.nodeRadius[n], data.radii[i]);
      data.nodeSpread[n] = std::max(data.nodeSpread[n], data.spreads[i]);
    }
  }
  for (std::size_t n = nodes.size(); n-- > 0;) {  // children follow their parents
    if (nodes[n].isLeaf()) continue;
    const auto right = static_cast<std::size_t>(nodes[n].rightChild);
    data.nodeRadius[n] = std::max(data.nodeRadius[n + 1], data.nodeRadius[right]);
    data.nodeSpread[n] = std::max(data.nodeSpread[n + 1], data.nodeSpread[right]);
  }
  return std::make_shared<const detail::NoisyCloudData>(std::move(data));
}

}  // namespace

namespace detail {

Matrix3d factorOf(const Matrix3d& covariance) {
  const double most = covariance.cwiseAbs().maxCoeff();
  if (!(most > 0.0)) return Matrix3d::Zero();
  const Matrix3d scaled = covariance / most;
  if (scaled == Matrix3d::Identity()) return std::sqrt(most) * Matrix3d::Identity();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(0.5 * (scaled + scaled.transpose()));
  const Vector3d roots = solver.eigenvalues().cwiseMax(0.0).cwiseSqrt();
  return std::sqrt(most) * (solver.eigenvectors() * roots.asDiagonal());
}

bool isIsotropic(const Matrix3d& factor) {
  return factor == factor(0, 0) * Matrix3d::Identity();
}

double spreadOf(const Matrix3d& factor) {
  const double most = factor.cwiseAbs().maxCoeff();
  if (!(most > 0.0)) return 0.0;
  const Matrix3d scaled = factor / most;
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(scaled.transpose() * scaled,
                                                       Eigen::EigenvaluesOnly);
  constexpr double kRoundedUp = 1.0 + 1e-13;
  return most * std::sqrt(solver.eigenvalues().maxCoeff()) * kRoundedUp;
}

}  // namespace detail

NoisyPointCloud NoisyPointCloud::build(std::span<const Vector3d> points,
                                       std::span<const double> radii,
                                       std::span<const Matrix3d> covariances) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, points, radii, covariances] { return build(points, radii, covariances); });
  }
  requireFinite(points);
  requireAsMany(points.size(), radii.size(), "radii");
  requireAsMany(points.size(), covariances.size(), "covariances");
  detail::NoisyCloudData data;
  for (std::size_t i = 0; i < points.size(); ++i) {
    requireLength(radii[i], "radius " + std::to_string(i));
    requireCovariance(covariances[i], i);
    data.factors.push_back(detail::factorOf(covariances[i]));
  }
  data.points.assign(points.begin(), points.end());
  data.radii.assign(radii.begin(), radii.end());
  return NoisyPointCloud(withTree(std::move(data)));
}

NoisyPointCloud NoisyPointCloud::build(std::span<const Vector3d> points, double radius,
                                       double standardDeviation) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, points, radius, standardDeviation] {
      return build(points, radius, standardDeviation);
    });
  }
  requireFinite(points);
  requireLength(radius, "radius");
  requireLength(standardDeviation, "standard deviation");
  detail::NoisyCloudData data;
  data.points.assign(points.begin(), points.end());
  data.radii.assign(points.size(), radius);
  data.factors = {standardDeviation * Matrix3d::Identity()};
  return NoisyPointCloud(withTree(std::move(data)));
}

std::size_t NoisyPointCloud::size() const {
  return data_->points.size();
}

}  // namespace swept
