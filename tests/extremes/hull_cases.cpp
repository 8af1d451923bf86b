// SPDX-License-Identifier: BSD-3-Clause
#include "core/error_table_shapes.hpp"
#include "sample.hpp"

namespace extremes {

namespace {

using namespace error_table;

/// On an ellipsoid: each is a vertex. Four are a simplex about the origin.
std::vector<Vector3d> spread(Random& random, int count) {
  if (count == 4) {
    const double s = random.uniform(0.5, 1.0);
    return {{s, s, s}, {-s, -s, s}, {-s, s, -s}, {s, -s, -s}};
  }
  const double high = random.uniform(0.3, 1.0);
  const Vector3d axes(1.0, random.uniform(0.3, 1.0), high);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) points.push_back(axes.cwiseProduct(random.direction()));
  return points;
}

/// Each several times.
std::vector<Vector3d> repeated(Random& random) {
  std::vector<Vector3d> points = spread(random, 12);
  for (int i = 0; i < 60; ++i) points.push_back(points[random.below(12)]);
  return points;
}

/// Corners of a box, and points on its edges and faces, to the last bit.
std::vector<Vector3d> collinear(Random& random) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 200; ++i) {
    Vector3d p;
    for (int k = 0; k < 3; ++k) p[k] = 0.125 * (random.below(17) - 8);
    p[random.below(3)] = random.sign();
    if (random.chance(0.5)) p[random.below(3)] = random.sign();
    points.push_back(p);
  }
  for (int k = 0; k < 8; ++k) {
    points.emplace_back(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0);
  }
  return points;
}

/// In one plane to the last bit.
std::vector<Vector3d> flat(Random& random) {
  std::vector<Vector3d> points;
  for (int i = 0; i < 30; ++i) {
    const double y = random.uniform(-1, 1);
    points.emplace_back(random.uniform(-1, 1), y, 0);
  }
  return points;
}

/// Against a ball, a capsule or a half-space, whose depths are known, and one another.
template <class Draw>
PairCase hulls(const std::string& name, double workLimit, const Draw& draw) {
  return {name, "ordinary hulls", workLimit, [draw](Random& random, int i) {
            const bool apart = i % 2 == 0;
            Wanted wanted;
            wanted.shapes = {Form::Sphere, Form::Capsule, Form::HalfSpace};
            Solid a = hullOf(draw(random));
            Solid b =
                apart && random.chance(0.5) ? hullOf(draw(random)) : drawOne(random, wanted, 1.0);
            if (random.chance(0.5)) std::swap(a, b);
            const Touch touch = drawTouch(a.body, b.body, random);
            const Real gap = random.decades(-9.0, 0.0);
            if (apart) return apartAt(std::move(a), std::move(b), touch, gap);
            if (a.body.isFlat() || b.body.isFlat()) {
              return apartAt(std::move(a), std::move(b), touch, -gap);
            }
            const double rolling = 0.95 * (a.body.rolling + b.body.rolling);
            return overlapAt(std::move(a), std::move(b), touch, gap * rolling);
          }};
}

PairCase ofCount(const std::string& name, double workLimit, int count, int kept) {
  // Drawn once: what is asked about is the query, not how hulls are made.
  std::vector<std::vector<Vector3d>> drawn;
  Random random(static_cast<std::uint64_t>(count));
  for (int i = 0; i < kept; ++i) drawn.push_back(spread(random, count));
  return hulls(name, workLimit, [drawn](Random& r) {
    return drawn[static_cast<std::size_t>(r.below(drawn.size()))];
  });
}

}  // namespace

std::vector<PairCase> hullCases() {
  return {ofCount("ordinary hulls", 1.0, 40, 10),
          ofCount("hulls, 4 corners", 2.0, 4, 10),
          ofCount("hulls, 1 000 corners", 4.0, 1000, 3),
          ofCount("hulls, 10 000 corners", 4.0, 10000, 2),
          hulls("hulls, repeated points", 4.0, repeated),
          hulls("hulls, points on edges and faces", 4.0, collinear),
          hulls("hulls in one plane", 4.0, flat)};
}

}  // namespace extremes
