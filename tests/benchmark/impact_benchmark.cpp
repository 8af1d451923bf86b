// SPDX-License-Identifier: BSD-3-Clause
// Time of impact of a vertex and a face, and of two edges: ns per query by kind of query. All have
// swept boxes that overlap.
#include <Eigen/Geometry>
#include <cstdio>
#include <random>

#include "../core/impact_samples.hpp"
#include "timing.hpp"

namespace swept::benchmark {
namespace {

using Eigen::Vector3d;
using test::ImpactQuery;
using test::ImpactTrait;
using Queries = std::vector<ImpactQuery>;

constexpr std::size_t kQueries = 100'000;

bool boxesOverlap(const ImpactQuery& q) {
  const int firsts = q.edges ? 2 : 1;
  const auto boxOf = [&](int from, int to) {
    Eigen::AlignedBox3d box;
    for (int i = from; i < to; ++i) box.extend(q.points[i].start).extend(q.points[i].end);
    return box;
  };
  const Eigen::AlignedBox3d second = boxOf(firsts, 4);
  return boxOf(0, firsts).squaredExteriorDistance(second) <=
         q.options.separation * q.options.separation;
}

class Source {
 public:
  explicit Source(bool edges) : edges_(edges) {}

  /// Corners in a cube of 2 m; one feature moves by up to `motion` along each axis relative to the
  /// other, and each corner by up to 0.3 of that on its own.
  ImpactQuery any(double motion, double separation) {
    ImpactQuery q;
    q.edges = edges_;
    q.options.separation = separation;
    do {
      const Vector3d drift = vector(motion);
      for (int i = 0; i < 4; ++i) {
        q.points[i].start = vector(1.0);
        q.points[i].end = q.points[i].start + vector(0.3 * motion);
        if (i < (edges_ ? 2 : 1)) q.points[i].end += drift;
      }
    } while (!boxesOverlap(q));
    return q;
  }

  /// Moved to within 1e-5 m of where contact begins or ends, to the side asked for.
  ImpactQuery borderline(Verdict side) {
    for (;;) {
      const ImpactQuery q = any(1.0, 0.0);
      if (test::ask(q).verdict != Verdict::Collision) continue;
      const Vector3d along = vector(1.0).normalized();
      double touching = 0.0;
      double apart = 8.0;
      while (apart - touching > 1e-5) {
        const double middle = 0.5 * (apart + touching);
        const bool free = test::ask(moved(q, middle * along)).verdict == Verdict::Free;
        (free ? apart : touching) = middle;
      }
      ImpactQuery found = moved(q, (side == Verdict::Free ? apart : touching) * along);
      if (boxesOverlap(found)) return found;
    }
  }

  /// Of the tests' kinds, with exact contact or an exact gap; those of usual size.
  ImpactQuery made(bool touching) {
    for (;;) {
      test::KnownImpact known = touching ? sampler_.inContact() : sampler_.apart();
      const auto has = [&](ImpactTrait trait) {
        return known.traits[static_cast<std::size_t>(trait)];
      };
      if (known.query.edges != edges_ || has(ImpactTrait::Huge) || has(ImpactTrait::Tiny)) continue;
      if (has(ImpactTrait::NoTolerance) || !boxesOverlap(known.query)) continue;
      known.query.options.before = 1.0;
      return known.query;
    }
  }

 private:
  Vector3d vector(double reach) {
    std::uniform_real_distribution<double> number(-reach, reach);
    return {number(random_), number(random_), number(random_)};
  }
  ImpactQuery moved(ImpactQuery q, const Vector3d& by) const {
    for (int i = 0; i < (edges_ ? 2 : 1); ++i) {
      q.points[i].start += by;
      q.points[i].end += by;
    }
    return q;
  }

  bool edges_;
  std::mt19937_64 random_{1};
  test::ImpactSampler sampler_{1};
};

void measure(const std::string& name, std::size_t count,
             const std::function<ImpactQuery()>& query) {
  Queries queries;
  for (std::size_t i = 0; i < count; ++i) queries.push_back(query());
  std::size_t collisions = 0;
  std::vector<Contestant> contestants{{"swept", [&] {
                                         collisions = 0;
                                         for (const ImpactQuery& q : queries) {
                                           if (test::ask(q).verdict != Verdict::Free) ++collisions;
                                         }
                                       }}};
  takeTurns(contestants, 5);
  const double perQuery = contestants[0].seconds / static_cast<double>(count);
  std::printf("| %s | %.0f %% | %.0f | %.2f |\n", name.c_str(),
              100.0 * static_cast<double>(collisions) / static_cast<double>(count), 1e9 * perQuery,
              1e-6 / perQuery);
  std::fflush(stdout);
}

void run() {
  std::puts("| queries | collisions | ns per query | million queries per second |");
  std::puts("|---|---|---|---|");
  for (const bool edges : {false, true}) {
    Source source(edges);
    const std::string kind = edges ? "edge-edge, " : "vertex-face, ";
    for (const double motion : {0.1, 0.5, 2.0}) {
      for (const double separation : {0.0, 1e-3}) {
        measure(kind + "random, motion " + number(motion) + ", separation " + number(separation),
                kQueries, [&] { return source.any(motion, separation); });
      }
    }
    measure(kind + "misses by 1e-5 m", kQueries / 10,
            [&] { return source.borderline(Verdict::Free); });
    measure(kind + "grazes by 1e-5 m", kQueries / 10,
            [&] { return source.borderline(Verdict::Collision); });
    measure(kind + "mostly degenerate, touching", kQueries, [&] { return source.made(true); });
    measure(kind + "mostly degenerate, beside a gap", kQueries, [&] { return source.made(false); });
  }
}

}  // namespace
}  // namespace swept::benchmark

int main() {
  swept::benchmark::run();
}
