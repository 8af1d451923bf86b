// SPDX-License-Identifier: BSD-3-Clause
// Convex pairs near contact: collide, distance and signed distance of every kind of pair, beside
// FCL on the same inputs in the same process. Ends with a table of the least times.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <string>

#include "pair_samples.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"
#ifdef SWEPT_HAS_FCL
#include <csetjmp>
#include <csignal>

#include <fcl/fcl.h>
#endif

namespace {

using samples::Pair;
using Pairs = std::shared_ptr<std::vector<Pair>>;

constexpr std::array<const char*, 3> kQueries{"collide", "distance", "signed"};
constexpr std::size_t kPairs = 1000;

std::string nameOf(const std::string& query, const std::string& kind, const std::string& library) {
  return query + "/" + kind + "/" + library;
}

template <typename Query>
void loop(benchmark::State& state, std::size_t count, const Query& query) {
  std::size_t i = 0;
  for (auto _ : state) {
    query(i);
    if (++i == count) i = 0;
  }
}

void runSwept(benchmark::State& state, const Pairs& pairs, int query) {
  const std::vector<Pair>& p = *pairs;
  if (query == 0) {
    loop(state, p.size(), [&](std::size_t i) {
      benchmark::DoNotOptimize(swept::collide(p[i].a, p[i].b, p[i].a_from_b));
    });
  } else if (query == 1) {
    loop(state, p.size(), [&](std::size_t i) {
      benchmark::DoNotOptimize(swept::distance(p[i].a, p[i].b, p[i].a_from_b));
    });
  } else {
    loop(state, p.size(), [&](std::size_t i) {
      benchmark::DoNotOptimize(swept::signedDistance(p[i].a, p[i].b, p[i].a_from_b));
    });
  }
}

#ifdef SWEPT_HAS_FCL
using Geometry = std::shared_ptr<fcl::CollisionGeometryd>;

struct ToFcl {
  Geometry operator()(const swept::Sphere& s) const {
    return std::make_shared<fcl::Sphered>(s.radius);
  }
  Geometry operator()(const swept::Box& s) const {
    return std::make_shared<fcl::Boxd>(fcl::Vector3d(2.0 * s.halfExtents));
  }
  Geometry operator()(const swept::Cylinder& s) const {
    return std::make_shared<fcl::Cylinderd>(s.radius, 2.0 * s.halfLength);
  }
  Geometry operator()(const swept::Capsule& s) const {
    return std::make_shared<fcl::Capsuled>(s.radius, 2.0 * s.halfLength);
  }
  Geometry operator()(const swept::Cone& s) const {
    return std::make_shared<fcl::Coned>(s.radius, 2.0 * s.halfLength);
  }
  Geometry operator()(const swept::Ellipsoid& s) const {
    return std::make_shared<fcl::Ellipsoidd>(s.semiAxes);
  }
  Geometry operator()(const swept::ConvexHull& s) const {
    auto vertices = std::make_shared<const std::vector<fcl::Vector3d>>(s.vertices());
    auto faces = std::make_shared<std::vector<int>>();
    for (const Eigen::Vector3i& f : s.faces()) faces->insert(faces->end(), {3, f[0], f[1], f[2]});
    return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(s.faces().size()), faces,
                                          true);
  }
  Geometry operator()(const swept::Triangle& s) const {
    return std::make_shared<fcl::TrianglePd>(s.corners[0], s.corners[1], s.corners[2]);
  }
  Geometry operator()(const swept::Plane& s) const {
    return std::make_shared<fcl::Planed>(s.normal, s.offset);
  }
  Geometry operator()(const swept::HalfSpace& s) const {
    return std::make_shared<fcl::Halfspaced>(s.normal, s.offset);
  }
  template <typename Pieces>
  Geometry operator()(const Pieces&) const {
    throw std::invalid_argument("not convex");
  }
};

struct FclPair {
  Geometry a;
  Geometry b;
  fcl::Transform3d world_from_a;
  fcl::Transform3d world_from_b;
};

/// FCL's own query for a shape against a bare triangle: its solvers', since collide() has none.
template <typename Solver, typename Body>
void triangleQuery(const FclPair& pair, int query) {
  const Solver solver;
  const auto& t = static_cast<const fcl::TrianglePd&>(*pair.b);
  const auto& body = static_cast<const Body&>(*pair.a);
  if (query == 0) {
    benchmark::DoNotOptimize(solver.shapeTriangleIntersect(
        body, pair.world_from_a, t.a, t.b, t.c, pair.world_from_b, nullptr, nullptr, nullptr));
  } else {
    double distance = 0.0;
    fcl::Vector3d p;
    fcl::Vector3d q;
    solver.shapeTriangleDistance(body, pair.world_from_a, t.a, t.b, t.c, pair.world_from_b,
                                 &distance, &p, &q);
    benchmark::DoNotOptimize(distance);
  }
}

template <typename Solver>
void triangleQuery(const FclPair& pair, int query) {
  const fcl::NODE_TYPE type = pair.a->getNodeType();
  if (type == fcl::GEOM_SPHERE) return triangleQuery<Solver, fcl::Sphered>(pair, query);
  if (type == fcl::GEOM_BOX) return triangleQuery<Solver, fcl::Boxd>(pair, query);
  if (type == fcl::GEOM_CYLINDER) return triangleQuery<Solver, fcl::Cylinderd>(pair, query);
  if (type == fcl::GEOM_CAPSULE) return triangleQuery<Solver, fcl::Capsuled>(pair, query);
  if (type == fcl::GEOM_CONE) return triangleQuery<Solver, fcl::Coned>(pair, query);
  if (type == fcl::GEOM_ELLIPSOID) return triangleQuery<Solver, fcl::Ellipsoidd>(pair, query);
  if (type == fcl::GEOM_CONVEX) return triangleQuery<Solver, fcl::Convexd>(pair, query);
  throw std::invalid_argument("no triangle query");
}

void fclQuery(const FclPair& pair, int query, fcl::GJKSolverType solver) {
  if (pair.b->getNodeType() == fcl::GEOM_TRIANGLE) {
    if (query == 2) throw std::invalid_argument("no signed triangle query");
    if (solver == fcl::GST_LIBCCD) {
      triangleQuery<fcl::detail::GJKSolver_libccdd>(pair, query);
    } else {
      triangleQuery<fcl::detail::GJKSolver_indepd>(pair, query);
    }
    return;
  }
  if (query == 0) {
    fcl::CollisionRequestd request;
    request.gjk_solver_type = solver;
    fcl::CollisionResultd result;
    benchmark::DoNotOptimize(fcl::collide(pair.a.get(), pair.world_from_a, pair.b.get(),
                                          pair.world_from_b, request, result));
    return;
  }
  fcl::DistanceRequestd request(false, query == 2);
  request.gjk_solver_type = solver;
  fcl::DistanceResultd result;
  benchmark::DoNotOptimize(fcl::distance(pair.a.get(), pair.world_from_a, pair.b.get(),
                                         pair.world_from_b, request, result));
}

sigjmp_buf afterAbort;

/// Debian's FCL is built with assertions, some of which fail inside GJK and EPA: such inputs are
/// left out of FCL's list.
bool survives(const FclPair& pair, int query, fcl::GJKSolverType solver) {
  struct sigaction jump = {};
  jump.sa_handler = [](int) { siglongjmp(afterAbort, 1); };
  jump.sa_flags = SA_NODEFER;
  struct sigaction before = {};
  sigaction(SIGABRT, &jump, &before);
  sigaction(SIGSEGV, &jump, nullptr);
  bool survived = false;
  if (sigsetjmp(afterAbort, 1) == 0) {
    try {
      fclQuery(pair, query, solver);
      survived = true;
    } catch (const std::exception&) {
      survived = false;
    }
  }
  sigaction(SIGABRT, &before, nullptr);
  sigaction(SIGSEGV, &before, nullptr);
  return survived;
}

void runFcl(benchmark::State& state, const Pairs& pairs, int query, fcl::GJKSolverType solver) {
  std::vector<FclPair> kept;
  for (const Pair& p : *pairs) {
    kept.push_back(
        {std::visit(ToFcl{}, p.a), std::visit(ToFcl{}, p.b), p.world_from_a, p.world_from_b});
    if (!survives(kept.back(), query, solver)) kept.pop_back();
    if (kept.empty() && &p - pairs->data() > 20) break;
  }
  if (kept.size() < pairs->size() / 2) {
    state.SkipWithError("fails on most inputs");
    return;
  }
  state.counters["failed"] = static_cast<double>(pairs->size() - kept.size());
  loop(state, kept.size(), [&](std::size_t i) { fclQuery(kept[i], query, solver); });
}
#endif

/// Keeps the least time per benchmark and prints kind x query at the end.
class TableReporter : public benchmark::ConsoleReporter {
 public:
  TableReporter() : ConsoleReporter(OO_None) {}
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      const std::string name = run.run_name.function_name;
      const double time = run.GetAdjustedCPUTime();
      const auto [at, fresh] = least_.emplace(name, time);
      if (!fresh) at->second = std::min(at->second, time);
    }
  }
  void Finalize() override {
    std::printf("| pair | query | swept, ns | FCL libccd, ns | FCL indep, ns | swept / best |\n");
    std::printf("|---|---|---|---|---|---|\n");
    for (const auto& [name, time] : least_) {
      const std::string suffix = "/swept";
      if (!name.ends_with(suffix)) continue;
      const std::string stem = name.substr(0, name.size() - suffix.size());
      const std::size_t slash = stem.find('/');
      const double ccd = timeOf(stem + "/fcl-libccd");
      const double indep = timeOf(stem + "/fcl-indep");
      std::printf("| %s | %s | %.0f | %s | %s | %s |\n", stem.substr(slash + 1).c_str(),
                  stem.substr(0, slash).c_str(), time, cell("%.0f", ccd).c_str(),
                  cell("%.0f", indep).c_str(), cell("%.2g", time / std::min(ccd, indep)).c_str());
    }
  }

 private:
  double timeOf(const std::string& name) const {
    const auto at = least_.find(name);
    return at == least_.end() ? std::numeric_limits<double>::infinity() : at->second;
  }
  /// A library that was not measured has no time, and is no peer.
  static std::string cell(const char* format, double value) {
    if (!std::isfinite(value) || value == 0.0) return "-";
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
  }
  std::map<std::string, double> least_;
};

void registerPair(const std::string& kindA, const std::string& kindB) {
  const std::string kind = kindA + "-" + kindB;
  const auto pairs = std::make_shared<std::vector<Pair>>(
      samples::Generator(static_cast<unsigned>(std::hash<std::string>{}(kind)))
          .pairs(kindA, kindB, kPairs));
  for (int query = 0; query < 3; ++query) {
    const auto add = [&](const std::string& library, auto run) {
      benchmark::RegisterBenchmark(nameOf(kQueries[query], kind, library).c_str(), run)
          ->MinTime(0.02);
    };
    add("swept", [=](benchmark::State& state) { runSwept(state, pairs, query); });
#ifdef SWEPT_HAS_FCL
    add("fcl-libccd",
        [=](benchmark::State& state) { runFcl(state, pairs, query, fcl::GST_LIBCCD); });
    add("fcl-indep", [=](benchmark::State& state) { runFcl(state, pairs, query, fcl::GST_INDEP); });
#endif
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::array<std::string, 10> kinds{"sphere",    "box",  "cylinder", "capsule", "cone",
                                          "ellipsoid", "hull", "triangle", "plane",   "halfspace"};
  for (std::size_t i = 0; i < 8; ++i) {
    for (std::size_t j = i; j < kinds.size(); ++j) registerPair(kinds[i], kinds[j]);
  }
  benchmark::Initialize(&argc, argv);
  TableReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  return 0;
}
