// SPDX-License-Identifier: BSD-3-Clause
// How cost grows with the number of triangles: two bumpy spheres at contact, 1 thousand to 1
// million triangles each. An argument N stops at N triangles.
#include <cmath>
#include <cstdlib>

#include "fcl_peer.hpp"
#include "number_argument.hpp"
#include "swept/core/bvh/bvh_model.hpp"
#include "swept/core/distance.hpp"
#include "timing.hpp"
#include "workloads.hpp"

namespace swept::benchmark {
namespace {

using Eigen::Isometry3d;

constexpr int kPoses = 20;

Shape surface(const Soup& soup) {
  return TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Surface);
}

/// Half of them free, half touching, within a ten-thousandth of a radius of contact.
std::vector<Isometry3d> posesNearContact(const Shape& mesh) {
  const auto touches = [&](const Isometry3d& pose) {
    return collide(mesh, mesh, pose) != Contact::Separate;
  };
  std::mt19937_64 random(3);
  std::vector<Isometry3d> poses;
  for (int i = 0; i < kPoses; ++i) {
    Bracket bracket{randomPose(random, Eigen::Vector3d::Zero()), Isometry3d::Identity()};
    bracket.touching.linear() = bracket.free.linear();
    const Eigen::Vector3d along = direction(random);
    bracket.free.translation() = 2.5 * along;
    bracket.touching.translation() = 1.5 * along;
    bracket = bisect(bracket, 14, touches);
    poses.push_back(i % 2 == 0 ? bracket.free : bracket.touching);
  }
  return poses;
}

struct Cost {
  double seconds = std::numeric_limits<double>::infinity();
  double bytes = 0.0;
};

/// The least of some turns, and what the result holds.
template <typename Make>
Cost costOf(int turns, const Make& make) {
  Cost cost;
  for (int turn = 0; turn < turns; ++turn) {
    const double before = heapBytes(), start = cpuSeconds();
    const auto made = make();
    cost.seconds = std::min(cost.seconds, cpuSeconds() - start);
    cost.bytes = heapBytes() - before;
  }
  return cost;
}

template <typename Volume>
BvhModel<Volume> modelOf(const Soup& soup) {
  BvhModel<Volume> model;
  model.begin(soup.vertices.size(), soup.triangles.size());
  model.addMesh(soup.vertices, soup.triangles);
  model.end();
  return model;
}

template <typename Volume>
double refitSeconds(int turns, const Soup& soup) {
  BvhModel<Volume> model = modelOf<Volume>(soup);
  double least = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < turns; ++turn) {
    const double start = cpuSeconds();
    model.beginReplace();
    model.replaceVertices(0, soup.vertices);
    model.endReplace(Refresh::Refit);
    least = std::min(least, cpuSeconds() - start);
  }
  return least;
}

#ifdef SWEPT_HAS_FCL
double fclRefitSeconds(int turns, const Soup& soup) {
  const auto model = fclModel<fcl::OBBRSSd>(soup);
  double least = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < turns; ++turn) {
    const double start = cpuSeconds();
    model->beginReplaceModel();
    model->replaceSubModel(soup.vertices);
    model->endReplaceModel(true, true);
    least = std::min(least, cpuSeconds() - start);
  }
  return least;
}
#endif

/// A column of times against triangle counts.
struct Series {
  std::string name;
  std::vector<double> seconds;
};

/// Slope of the least-squares line through the logarithms.
double exponent(const std::vector<double>& counts, const std::vector<double>& seconds) {
  double n = 0.0, sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < seconds.size(); ++i) {
    const double x = std::log(counts[i]), y = std::log(seconds[i]);
    ++n;
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

void print(const char* what, const std::vector<double>& counts, const std::vector<Series>& columns,
           double unit, bool perTriangle) {
  std::printf("\n%s\n\n", what);
  std::vector<std::string> head{"triangles"};
  for (const Series& column : columns) head.push_back(column.name);
  const MarkdownTable table(head);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    std::vector<std::string> cells{std::to_string(std::lround(counts[i]))};
    for (const Series& column : columns)
      cells.push_back(number(column.seconds[i] / (unit * (perTriangle ? counts[i] : 1.0))));
    table.row(cells);
  }
  if (counts.size() < 2) return;
  std::vector<std::string> last{"exponent"};
  for (const Series& column : columns) last.push_back(number(exponent(counts, column.seconds), 2));
  table.row(last);
}

class Growth {
 public:
  void measure(int count) {
    const Soup soup = bumpySphere(count, 1.0);
    const double triangles = static_cast<double>(soup.triangles.size());
    counts_.push_back(triangles);
    const int turns = triangles > 2e5 ? 2 : 5;
    queries(soup, triangles > 2e5 ? 3 : 7);

    const Cost mesh = costOf(turns, [&] { return surface(soup); });
    const Cost aabb = costOf(turns, [&] { return modelOf<Aabb>(soup); });
    const Cost obb = costOf(turns, [&] { return modelOf<Obb>(soup); });
    add(builds_, "TriangleMesh", mesh.seconds);
    add(builds_, "BvhModel AABB", aabb.seconds);
    add(builds_, "BvhModel OBB", obb.seconds);
    add(bytes_, "TriangleMesh", mesh.bytes);
    add(bytes_, "BvhModel AABB", aabb.bytes);
    add(bytes_, "BvhModel OBB", obb.bytes);
    add(refits_, "BvhModel AABB", refitSeconds<Aabb>(turns, soup));
    add(refits_, "BvhModel OBB", refitSeconds<Obb>(turns, soup));
#ifdef SWEPT_HAS_FCL
    const Cost peer = costOf(turns, [&] { return fclModel<fcl::OBBRSSd>(soup); });
    add(builds_, "FCL OBBRSS", peer.seconds);
    add(bytes_, "FCL OBBRSS", peer.bytes);
    add(refits_, "FCL OBBRSS", fclRefitSeconds(turns, soup));
#endif
  }

  void printAll() const {
    print("Query, us", counts_, queries_, 1e-6, false);
    print("Build, ns per triangle", counts_, builds_, 1e-9, true);
    print("Refit, ns per triangle", counts_, refits_, 1e-9, true);
    print("Memory, bytes per triangle", counts_, bytes_, 1.0, true);
  }

 private:
  static void add(std::vector<Series>& columns, const std::string& name, double seconds) {
    for (Series& column : columns) {
      if (column.name != name) continue;
      column.seconds.push_back(seconds);
      return;
    }
    columns.push_back({name, {seconds}});
  }

  void queries(const Soup& soup, int turns) {
    const Shape mesh = surface(soup);
    const std::vector<Isometry3d> poses = posesNearContact(mesh);
    std::vector<Contestant> contestants;
    contestants.push_back({"collide", [&] {
                             for (const Isometry3d& pose : poses) collide(mesh, mesh, pose);
                           }});
    contestants.push_back({"distance", [&] {
                             for (const Isometry3d& pose : poses) distance(mesh, mesh, pose);
                           }});
#ifdef SWEPT_HAS_FCL
    const auto model = fclModel<fcl::OBBRSSd>(soup);
    const FclPair pair{model, model};
    contestants.push_back({"FCL OBBRSS collide", [&] {
                             for (const Isometry3d& pose : poses) pair.contacts(pose, 1, false);
                           }});
    contestants.push_back({"FCL OBBRSS distance", [&] {
                             for (const Isometry3d& pose : poses) pair.distance(pose);
                           }});
#endif
    takeTurns(contestants, turns);
    for (const Contestant& contestant : contestants)
      add(queries_, contestant.name, contestant.seconds / kPoses);
  }

  std::vector<double> counts_;
  std::vector<Series> queries_, builds_, refits_, bytes_;
};

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  const auto most = argc > 1 ? swept::benchmark::countOf(argv[1], 100'000'000) : 1'100'000;
  if (!most || *most < 1000 || argc > 2) {
    std::fputs("usage: scaling_benchmark [N], triangles, N from 1000 to 1e8\n", stderr);
    return 2;
  }
  swept::benchmark::Growth growth;
  for (int count = 1000; count <= static_cast<int>(*most); count *= 4) growth.measure(count);
  growth.printAll();
  return EXIT_SUCCESS;
}
