// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdio>
#include <limits>
#include <set>
#include <vector>

#include "deform_fcl.hpp"
#include "deform_scenes.hpp"
#include "swept/core/continuous/deforming_mesh.hpp"
#include "swept/core/traversal/mesh_self_collision.hpp"
#include "swept/core/triangle_pair.hpp"

/// Who finds the pairs that meet during a step.
namespace swept::benchmark {

using PairSet = std::set<TrianglePair>;

/// A step of one mesh, for slow answers.
struct StepTruth {
  std::vector<Eigen::Vector3i> triangles;
  Points from, to;
  PairSet atStart;
  PairSet inside;  ///< seen in some sample, but not at the start

  TriangleCorners corners(int triangle, double t) const {
    TriangleCorners c;
    for (int k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(triangles[static_cast<std::size_t>(triangle)][k]);
      c[static_cast<std::size_t>(k)] = (1.0 - t) * from[v] + t * to[v];
    }
    return c;
  }
  bool haveCommonVertex(const TrianglePair& pair) const {
    for (const int v : triangles[static_cast<std::size_t>(pair.first)]) {
      if ((triangles[static_cast<std::size_t>(pair.second)].array() == v).any()) return true;
    }
    return false;
  }
  /// Proven by steps as long as the distance allows at the largest relative speed.
  bool keepApart(const TrianglePair& pair, double gap) const {
    double speed = 0.0;
    for (const int v : triangles[static_cast<std::size_t>(pair.first)]) {
      for (const int w : triangles[static_cast<std::size_t>(pair.second)]) {
        const auto i = static_cast<std::size_t>(v), j = static_cast<std::size_t>(w);
        speed = std::max(speed, (to[i] - from[i] - to[j] + from[j]).norm());
      }
    }
    for (double t = 0.0;;) {
      const double apart = triangleDistance(corners(pair.first, t), corners(pair.second, t)).lower;
      if (apart <= gap) return false;
      if (t >= 1.0 || speed * (1.0 - t) < apart - gap) return true;
      t = std::min(1.0, t + 0.999 * apart / speed);
    }
  }
};

/// `samples` moments, each tested exactly for all pairs by another traversal than the one judged.
inline StepTruth sampledTruth(const DeformScene& scene, int frame, int samples) {
  StepTruth truth{scene.allTriangles(), scene.allAt(frame), scene.allAt(frame + 1), {}, {}};
  BvhModel<Aabb> model;
  model.begin();
  model.addMesh(truth.from, truth.triangles);
  model.end();
  MeshCollisionResult result;
  for (int i = 0; i <= samples; ++i) {
    const double t = static_cast<double>(i) / samples;
    Points points = truth.from;
    for (std::size_t v = 0; v < points.size(); ++v)
      points[v] = (1.0 - t) * truth.from[v] + t * truth.to[v];
    model.beginReplace();
    model.replaceVertices(0, points);
    model.endReplace();
    selfCollideMesh(model, {std::numeric_limits<std::size_t>::max()}, result);
    for (const TrianglePair& pair : result.pairs) {
      if (i == 0) truth.atStart.insert(pair);
      if (!truth.atStart.contains(pair)) truth.inside.insert(pair);
    }
  }
  return truth;
}

/// Prints how many pairs a library missed, and how many it invented.
inline std::size_t judge(const char* name, const StepTruth& truth, const PairSet& reported) {
  std::size_t missed = 0, missedAtStart = 0, unseen = 0, apart = 0;
  for (const TrianglePair& pair : truth.inside) missed += reported.contains(pair) ? 0 : 1;
  for (const TrianglePair& pair : truth.atStart) missedAtStart += reported.contains(pair) ? 0 : 1;
  for (const TrianglePair& pair : reported) {
    if (truth.inside.contains(pair) || truth.atStart.contains(pair)) continue;
    ++unseen;
    apart += !truth.haveCommonVertex(pair) && truth.keepApart(pair, 1e-5) ? 1 : 0;
  }
  std::printf("| %s | %zu | %zu | %zu | %zu |\n", name, missed, missedAtStart, unseen, apart);
  return missed + missedAtStart + apart;
}

/// Whether ours is right in one step.
inline bool judgeStep(const DeformScene& scene, int frame, int samples) {
  const StepTruth truth = sampledTruth(scene, frame, samples);
  std::printf(
      "\nStep %d: %zu pairs touch at the start, %d samples see %zu more that meet inside.\n\n"
      "| | missed inside | missed at the start | not seen by the samples | of these, "
      "provably 10 um apart |\n|---|---|---|---|---|\n",
      frame, truth.atStart.size(), samples, truth.inside.size());
  DeformingMesh mesh = DeformingMesh::build(truth.from, truth.triangles);
  mesh.moveTo(truth.to);
  DeformingWorkspace workspace;
  DeformingResult result;
  selfCollideContinuous(mesh, {}, result, workspace);
  PairSet reported;
  for (const TriangleImpact& impact : result.impacts)
    reported.insert({impact.first, impact.second});
  const bool good = judge("swept", truth, reported) == 0;
#ifdef SWEPT_HAS_FCL
  const auto ask = [&]<typename Volume>(const char* name) {
    FclDeforming<Volume> peer({truth.from, truth.triangles});
    peer.moveTo(truth.from);
    peer.moveTo(truth.to);
    PairSet pairs;
    for (const TrianglePair& pair : peer.meeting(peer))
      pairs.insert({std::min(pair.first, pair.second), std::max(pair.first, pair.second)});
    judge(name, truth, pairs);
  };
  ask.operator()<fcl::AABBd>("FCL AABB");
  ask.operator()<fcl::KDOP<double, 16>>("FCL k-DOP16");
#endif
  std::fflush(stdout);
  return good;
}

}  // namespace swept::benchmark
