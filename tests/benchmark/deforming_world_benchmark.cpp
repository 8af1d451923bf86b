// SPDX-License-Identifier: BSD-3-Clause
// A curtain that sways before an arm (rook7), 2 thousand to 2 million triangles: what its next
// frame takes as a mesh and as a version of the checker, beside FCL's refit and a build of
// everything. An argument N stops at N triangles.
#include <cmath>
#include <cstdlib>

#include "fcl_peer.hpp"
#include "models_dir.hpp"
#include "number_argument.hpp"
#include "swept/robot_model/checker.hpp"
#include "timing.hpp"

namespace swept::benchmark {
namespace {

using Eigen::Vector3d;

constexpr int kTurns = 5;

class Curtain {
 public:
  explicit Curtain(int cells) : cells_(cells) {
    for (int i = 0; i < cells; ++i) {
      for (int j = 0; j < cells; ++j) {
        const int a = i * (cells + 1) + j;
        triangles_.emplace_back(a, a + 1, a + cells + 1);
        triangles_.emplace_back(a + 1, a + cells + 2, a + cells + 1);
      }
    }
  }

  const std::vector<TriangleMesh::Triangle>& triangles() const { return triangles_; }

  /// m. 1 m wide and high, in folds that travel along it.
  std::vector<Vector3d> at(int frame) const {
    std::vector<Vector3d> vertices;
    for (int i = 0; i <= cells_; ++i) {
      for (int j = 0; j <= cells_; ++j) {
        const double y = i / static_cast<double>(cells_), z = j / static_cast<double>(cells_);
        const double fold = std::sin(30.0 * y + 0.3 * frame) + 0.2 * std::sin(90.0 * y);
        vertices.emplace_back(0.6 + 0.05 * (1.2 - z) * fold, y - 0.5, z);
      }
    }
    return vertices;
  }

 private:
  int cells_;
  std::vector<TriangleMesh::Triangle> triangles_;
};

WorldBody bodyOf(const TriangleMesh& mesh) {
  return {.name = "curtain", .parts = {{mesh, Eigen::Isometry3d::Identity()}}};
}

/// The least time of the turns, s; `run` is told the number of the turn.
template <typename Run>
double least(const Run& run) {
  double seconds = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < kTurns; ++turn) {
    const double start = cpuSeconds();
    run(turn);
    seconds = std::min(seconds, cpuSeconds() - start);
  }
  return seconds;
}

double fclRefit([[maybe_unused]] const Curtain& curtain,
                [[maybe_unused]] const std::vector<std::vector<Vector3d>>& frames) {
#ifdef SWEPT_HAS_FCL
  const auto model = fclModel<fcl::OBBRSSd>({frames[0], curtain.triangles()});
  return least([&](int turn) {
    model->beginReplaceModel();
    model->replaceSubModel(frames[turn]);
    model->endReplaceModel(true, true);
  });
#else
  return std::nan("");
#endif
}

void row(const MarkdownTable& table, const Checker& empty, int cells) {
  const Curtain curtain(cells);
  std::vector<std::vector<Vector3d>> frames;
  for (int frame = 0; frame < kTurns; ++frame) frames.push_back(curtain.at(frame));
  std::vector<TriangleMesh> built, moved;
  const double build = least(
      [&](int turn) { built.push_back(TriangleMesh::build(frames[turn], curtain.triangles())); });
  const double move = least([&](int turn) { moved.push_back(built[0].moved(frames[turn])); });
  const Checker first = empty.withBody(bodyOf(built[0]));
  const double version = least([&](int turn) { (void)first.withReplaced(bodyOf(moved[turn])); });
  const double fcl = fclRefit(curtain, frames);
  const auto count = static_cast<double>(curtain.triangles().size());
  table.row({std::to_string(curtain.triangles().size()), number(1e9 * build / count),
             number(1e9 * move / count), number(1e9 * fcl / count), number(move / fcl, 2),
             number(1e3 * version), number(1e3 * (move + version))});
}

void report(std::size_t most) {
  const std::string rook7 = modelsDir() + "/robots/rook7/rook7";
  const auto robot = Robot::load(rook7 + ".urdf", rook7 + ".srdf");
  World world;
  world.add("table", makeBox({0.6, 0.6, 0.05}),
            Eigen::Isometry3d(Eigen::Translation3d(0, -0.7, 0)));
  const Checker empty(robot, robot->groups().front().name,
                      std::make_shared<const World>(std::move(world)));
  const MarkdownTable table({"triangles", "build, ns each", "moved, ns each", "FCL refit, ns each",
                             "moved / FCL", "new version, ms", "frame to checker, ms"});
  for (const int cells : {32, 100, 316, 1000}) {
    const int triangles = 2 * cells * cells;
    if (static_cast<std::size_t>(triangles) <= most) row(table, empty, cells);
  }
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  const auto most = argc > 1 ? swept::benchmark::countOf(argv[1], SIZE_MAX) : SIZE_MAX;
  if (!most || *most < 2048 || argc > 2) {
    std::fputs("usage: deforming_world_benchmark [N], triangles, N from 2048\n", stderr);
    return 2;
  }
  swept::benchmark::report(*most);
}
