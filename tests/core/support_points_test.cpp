// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/support_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace swept::detail {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using Points = std::vector<Vector3d>;

struct Body {
  std::string name;
  Points points;  ///< at most 1 in magnitude
};

Vector3d somewhere(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Vector3d v;
  for (double& coordinate : v) coordinate = normal(random);
  return v;
}

/// Round, slender, flat and edged ones, with as many ties as these have.
std::vector<Body> bodies(int count) {
  std::mt19937_64 random(count);
  const auto edge = static_cast<int>(std::cbrt(count)) + 1;
  const auto angle = [&](int i) { return 2.0 * std::numbers::pi * i / count; };
  const auto along = [&](int i) { return 2.0 * i / count - 1.0; };
  const auto round = [&] { return Vector3d(somewhere(random).normalized()); };
  const auto body = [&](const char* name, const std::function<Vector3d(int)>& point) {
    Body made{name, {}};
    for (int i = 0; i < count; ++i) made.points.push_back(point(i));
    return made;
  };
  return {
      body("ball", [&](int) { return round(); }),
      body("flat ellipsoid",
           [&](int) { return round().cwiseProduct(Vector3d(1.0, 0.3, 0.03)).eval(); }),
      body("cylinder",
           [&](int i) {
             const double end = i % 2 == 0 ? 0.9 : -0.9;
             return Vector3d(0.5 * std::cos(angle(i)), 0.5 * std::sin(angle(i)), end);
           }),
      body("disc", [&](int i) { return Vector3d(0.0, std::cos(angle(i)), std::sin(angle(i))); }),
      body("curve",
           [&](int i) {
             return Vector3d(along(i), 1e-3 * std::pow(along(i), 2), 1e-4 * std::pow(along(i), 3));
           }),
      body("rounded box",
           [&](int) {
             const Vector3d corner = Vector3d(0.9, 0.6, 0.3).cwiseProduct(round().cwiseSign());
             return (corner + 0.05 * round()).eval();
           }),
      body("lattice",
           [&](int i) {
             const Vector3i at(i % edge, i / edge % edge, i / edge / edge);
             return (at.cast<double>() / edge).eval();
           }),
      body("line", [&](int i) { return (along(i) * Vector3d(1.0, -1.0, 0.5)).eval(); }),
      body("one point", [](int) { return Vector3d(0.25, -0.5, 1.0); }),
  };
}

/// Anywhere, along and near axes and diagonals, and through edges and corners of cells.
Points directions(std::mt19937_64& random) {
  Points all;
  for (int i = 0; i < 300; ++i) all.push_back(somewhere(random));
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        const Vector3d d(x, y, z);
        if (d.isZero()) continue;
        for (double off : {0.0, 1e-300, 1e-16, 1e-12, 1e-6})
          all.push_back(d + off * somewhere(random));
      }
    }
  }
  for (int side : {1, 2, 4, 8, 16, 32}) {
    for (int i = 0; i < 20; ++i) {
      const int row = static_cast<int>(random() % (side + 1));
      const int column = static_cast<int>(random() % (side + 1));
      Vector3d d = Vector3d::Constant(random() % 2 == 0 ? 1.0 : -1.0);
      const int axis = static_cast<int>(random() % 3);
      d[(axis + 1) % 3] = 2.1 * row / side - 1.0;
      d[(axis + 2) % 3] = 2.1 * column / side - 1.0;
      all.push_back(d);
    }
  }
  return all;
}

TEST(SupportPoints, AreTheFarthestOfAll) {
  std::mt19937_64 random(1);
  int fromShortLists = 0, asked = 0;
  for (int count : {1, 2, 9, 128, 129, 200, 1000, 5000}) {
    const Points along = directions(random);
    for (const Body& body : bodies(count)) {
      for (double size : {1.0, 1e-300, 1e-9, 1e6, 1e300}) {
        const double exact = std::ldexp(1.0, std::ilogb(size));
        Points points;
        for (const Vector3d& p : body.points) points.push_back(exact * p);
        const SupportPoints support(points, 1.0 / exact);
        for (const Vector3d& d : along) {
          const Vector3d found = support.farthest(d);
          double most = -std::numeric_limits<double>::infinity();
          bool given = false;
          for (const Vector3d& p : points) {
            // Scaled without rounding.
            most = std::max(most, (p / exact).dot(d));
            given = given || p == found;
          }
          EXPECT_TRUE(given) << body.name;
          EXPECT_GE((found / exact).dot(d), most - 2e-15 * d.norm())
              << body.name << " of " << count << " along " << d.transpose();
          ++asked;
          if (support.read(d) < points.size() / 4) ++fromShortLists;
        }
        if (count > 1000) break;  // one size of what takes long
      }
    }
  }
  EXPECT_GT(fromShortLists, asked / 10);
}

TEST(SupportPoints, OfRoundBodiesReadFewAndListNoneOften) {
  std::mt19937_64 random(2);
  for (int count : {200, 1000, 10000}) {
    for (const Body& body : bodies(count)) {
      const SupportPoints support(body.points, 1.0);
      EXPECT_LE(support.listed(), 8U * body.points.size()) << body.name;
      if (body.name != "ball" && body.name != "rounded box") continue;
      std::size_t read = 0;
      for (int i = 0; i < 1000; ++i) read += support.read(somewhere(random));
      EXPECT_LE(read, 48'000U) << body.name << " of " << count;
    }
  }
}

TEST(SupportPoints, OfDirectionsThatAreNoneAreAnyPoint) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const Points ball = bodies(1000).front().points;
  const SupportPoints support(ball, 1.0);
  for (const Vector3d& d :
       {Vector3d(0.0, 0.0, 0.0), Vector3d(kNan, 0.0, 0.0), Vector3d(1.0, kNan, 2.0),
        Vector3d(kInfinity, -kInfinity, 0.0), Vector3d(kNan, kNan, kNan)}) {
    EXPECT_NE(std::find(ball.begin(), ball.end(), support.farthest(d)), ball.end());
  }
}

}  // namespace
}  // namespace swept::detail
