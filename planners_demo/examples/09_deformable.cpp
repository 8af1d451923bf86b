// SPDX-License-Identifier: BSD-3-Clause
// When does a deforming surface first touch another one? A sheet, held at its rim, sags onto a
// table, frame by frame; between frames its vertices move straight. Exits 0 if the frame, and the
// time in it, agree with a calculation by hand.
#include <cmath>
#include <iostream>

#include "swept/core/continuous/deforming_mesh.hpp"
#include "swept/core/height_field.hpp"

using Eigen::Vector3d;

constexpr double kTable = -0.35;  // m

double sag(int frame) {
  return 0.01 * frame * frame;
}  // m, of the sheet's middle

std::vector<Vector3d> sheet(int frame) {
  std::vector<Vector3d> vertices;
  for (int i = 0; i <= 20; ++i)
    for (int j = 0; j <= 20; ++j) {
      const double x = 0.1 * i - 1.0, y = 0.1 * j - 1.0;
      vertices.emplace_back(x, y, -sag(frame) * (1.0 - x * x) * (1.0 - y * y));
    }
  return vertices;
}

int main() {
  std::vector<Eigen::Vector3i> triangles;  // two per cell of the grid
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) {
      const int k = 21 * i + j;
      triangles.push_back({k, k + 21, k + 22});
      triangles.push_back({k, k + 22, k + 1});
    }
  swept::DeformingMesh cloth = swept::DeformingMesh::build(sheet(0), triangles);
  const std::vector<Vector3d> corners{{-2, -2, kTable}, {2, -2, kTable}, {0, 3, kTable}};
  const auto table = swept::DeformingMesh::build(corners, std::vector<Eigen::Vector3i>{{0, 1, 2}});

  swept::DeformingWorkspace workspace;
  swept::DeformingResult result;
  int frame = 0;
  do {
    cloth.moveTo(sheet(++frame));
    collideContinuous(cloth, table, {.firstOnly = true}, result, workspace);
    std::cout << "frame " << frame << ": " << toString(result.verdict) << '\n';
  } while (result.verdict == swept::Verdict::Free && frame < 10);

  // The middle is at -0.25 m in frame 5 and would be at -0.36 m in frame 6.
  const double expected = 0.10 / 0.11;
  std::cout << "proven free until " << result.freeUntil << " of that frame, in contact at "
            << result.contactBy << ", expected at " << expected << '\n';
  return frame == 6 && result.verdict == swept::Verdict::Collision &&
                 result.freeUntil <= expected && expected <= result.contactBy + 1e-5 &&
                 result.contactBy - result.freeUntil < 1e-4
             ? 0
             : 1;
}
