// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

/// Least values of a function of a direction, in double precision: to rounding where the function
/// is smooth or has a kink at the least.
namespace error_table {

using Eigen::Vector3d;

template <class F>
double goldenSection(double low, double high, const F& f) {
  const double ratio = std::numbers::phi - 1.0;
  double x = high - ratio * (high - low);
  double y = low + ratio * (high - low);
  double fx = f(x);
  double fy = f(y);
  for (int i = 0; i < 80; ++i) {
    if (fx < fy) {
      high = std::exchange(y, x);
      fy = fx;
      x = high - ratio * (high - low);
      fx = f(x);
    } else {
      low = std::exchange(x, y);
      fx = fy;
      y = low + ratio * (high - low);
      fy = f(y);
    }
  }
  return fx < fy ? x : y;
}

/// Calls `visit` with the local minima over the circle center + cos u + sin v, but those proven to
/// be above `interest` by the Lipschitz constant of f.
template <class F, class Visitor>
void leastOnCircle(const Vector3d& center, const Vector3d& u, const Vector3d& v, double lipschitz,
                   double interest, const F& f, const Visitor& visit) {
  constexpr int kSteps = 48;
  const double step = 2.0 * std::numbers::pi / kSteps;
  const auto at = [&](double angle) -> Vector3d {
    return center + std::cos(angle) * u + std::sin(angle) * v;
  };
  std::array<double, kSteps> sampled;
  for (int i = 0; i < kSteps; ++i) sampled[i] = f(at(i * step));
  for (int i = 0; i < kSteps; ++i) {
    const double before = sampled[(i + kSteps - 1) % kSteps];
    if (sampled[i] > before || sampled[i] > sampled[(i + 1) % kSteps]) continue;
    if (sampled[i] - lipschitz * step > interest) continue;
    visit(at(
        goldenSection((i - 1) * step, (i + 1) * step, [&](double angle) { return f(at(angle)); })));
  }
}

/// Compass search on the sphere, with the least of the quadratic through its points.
template <class F>
Vector3d descend(Vector3d n, const F& f) {
  double value = f(n);
  for (double h = 0.1; h > 1e-9; h *= 0.5) {
    for (int round = 0; round < 12; ++round) {
      const Vector3d u = n.unitOrthogonal();
      const Vector3d v = n.cross(u);
      Vector3d next = n;
      double least = value;
      const auto at = [&](double x, double y) {
        const Vector3d p = (n + x * u + y * v).normalized();
        const double found = f(p);
        if (found < least) {
          least = found;
          next = p;
        }
        return found;
      };
      const double right = at(h, 0.0), left = at(-h, 0.0), up = at(0.0, h), down = at(0.0, -h);
      const double corner = at(h, h), opposite = at(-h, -h);
      const double xx = right + left - 2.0 * value, yy = up + down - 2.0 * value;
      const double xy = 0.5 * (corner + opposite - right - left - up - down) + value;
      const double gx = 0.5 * (right - left), gy = 0.5 * (up - down);
      const double determinant = xx * yy - xy * xy;
      if (determinant > 0.0) {
        at(-h * (yy * gx - xy * gy) / determinant, -h * (xx * gy - xy * gx) / determinant);
      }
      at(h, -h);
      at(-h, h);
      if (!(least < value)) break;
      value = least;
      n = next;
    }
  }
  return n;
}

/// The least of directions spread over the sphere, no two of them close to each other.
template <class F>
std::vector<Vector3d> promising(std::size_t most, const F& f) {
  constexpr int kSamples = 400;
  std::vector<std::pair<double, Vector3d>> sampled;
  for (int i = 0; i < kSamples; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / kSamples;
    const double angle = 2.0 * std::numbers::pi * std::numbers::phi * i;
    const double across = std::sqrt(1.0 - z * z);
    const Vector3d n(across * std::cos(angle), across * std::sin(angle), z);
    sampled.emplace_back(f(n), n);
  }
  std::sort(sampled.begin(), sampled.end(), [](auto& l, auto& r) { return l.first < r.first; });
  std::vector<Vector3d> found;
  for (const auto& sample : sampled) {
    const Vector3d& n = sample.second;
    const bool isNew = std::none_of(found.begin(), found.end(),
                                    [&](const Vector3d& other) { return other.dot(n) > 0.93; });
    if (isNew) found.push_back(n);
    if (found.size() == most) break;
  }
  return found;
}

}  // namespace error_table
