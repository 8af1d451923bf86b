// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cmath>

#include "continuous/deforming_data.hpp"
#include "continuous/deforming_workspace.hpp"
#include "continuous/meeting_features.hpp"
#include "swept/core/continuous/impact.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/triangle_pair.hpp"

/// Lemma. The distance of two triangles that do not touch is that of a corner of one from the
/// other, or of two edges: the least of fifteen distances that change continuously in time. So
/// triangles that do not touch at the start come within a separation >= 0 exactly when the first of
/// these distances does: where they first touch, one of the fifteen distances is zero.
namespace swept {

namespace {

using detail::FeatureBits;
using detail::FeatureKey;
using Mesh = DeformingMesh::Data;

/// A triangle of a mesh during the step.
class MovingTriangle {
 public:
  MovingTriangle(const Mesh& mesh, std::uint32_t slot)
      : mesh_(mesh), slot_(slot), number_(mesh.order.triangleOf[slot]) {
    const detail::VertexBlock& block = mesh.order.vertices[slot / detail::kTreeLanes];
    for (std::size_t k = 0; k < 3; ++k) vertices_[k] = block.of[k][slot % detail::kTreeLanes];
  }

  std::uint32_t slot() const { return slot_; }
  int number() const { return number_; }
  int vertex(int k) const { return vertices_[static_cast<std::size_t>(k)]; }
  int namedVertex(int k) const { return mesh_.order.vertexOf[static_cast<std::size_t>(vertex(k))]; }
  int edge(int k) const { return mesh_.surface.edge(number_, k); }

  LinearPath path(int k) const {
    const auto v = static_cast<std::size_t>(vertex(k));
    return {mesh_.from().vertices[v], mesh_.end.vertices[v]};
  }
  std::array<LinearPath, 2> edgePath(int k) const { return {path(k), path((k + 1) % 3)}; }
  std::array<LinearPath, 3> facePath() const { return {path(0), path(1), path(2)}; }
  TriangleCorners start() const { return {path(0).start, path(1).start, path(2).start}; }

 private:
  const Mesh& mesh_;
  std::uint32_t slot_;
  int number_;
  std::array<int, 3> vertices_;
};

class ImpactQuery {
 public:
  ImpactQuery(const Mesh& a, const Mesh& b, const DeformingOptions& options,
              DeformingResult& result, DeformingWorkspace::Data& scratch)
      : a_(a), b_(b), same_(&a == &b), options_(options), result_(result), scratch_(scratch) {
    impact_.separation = options.separation;
    impact_.tolerance = options.tolerance;
  }

  void run();

 private:
  /// Tested first, since nothing comes before a contact at the start.
  void lookAtStart();
  void lookAtStep();
  bool done() const { return options_.firstOnly && result_.contactBy <= 0.0; }
  TriangleImpact solved(const MovingTriangle& t, const MovingTriangle& u, unsigned features);
  const Impact& solvedFeature(const MovingTriangle& t, const MovingTriangle& u, int bit);
  unsigned orphans(const MovingTriangle& t, const MovingTriangle& u) const;
  bool haveCommonVertex(const MovingTriangle& t, const MovingTriangle& u) const;
  void report(const TriangleImpact& impact);

  const Mesh& a_;
  const Mesh& b_;
  bool same_;
  const DeformingOptions& options_;
  DeformingResult& result_;
  DeformingWorkspace::Data& scratch_;
  ImpactOptions impact_;
};

bool ImpactQuery::haveCommonVertex(const MovingTriangle& t, const MovingTriangle& u) const {
  return same_ && shareVertex(a_.surface.triangle(t.number()), a_.surface.triangle(u.number()));
}

/// For two triangles with a common vertex: the features that no other pair covers.
unsigned ImpactQuery::orphans(const MovingTriangle& t, const MovingTriangle& u) const {
  const auto isCorner = [](int v, const MovingTriangle& of) {
    return v == of.vertex(0) || v == of.vertex(1) || v == of.vertex(2);
  };
  unsigned bits = 0;
  for (int i = 0; i < 3; ++i) {
    if (!isCorner(t.vertex(i), u) && a_.surface.isOrphan(t.namedVertex(i), u.number()))
      bits |= 1U << FeatureBits::firstCorner(i);
    if (!isCorner(u.vertex(i), t) && a_.surface.isOrphan(u.namedVertex(i), t.number()))
      bits |= 1U << FeatureBits::secondCorner(i);
    for (int j = 0; j < 3; ++j) {
      const int p = t.vertex(i), q = t.vertex((i + 1) % 3);
      const int r = u.vertex(j), s = u.vertex((j + 1) % 3);
      if (p == r || p == s || q == r || q == s) continue;
      if (a_.surface.areOrphans(t.edge(i), u.edge(j))) bits |= 1U << FeatureBits::edges(i, j);
    }
  }
  return bits;
}

const Impact& ImpactQuery::solvedFeature(const MovingTriangle& t, const MovingTriangle& u,
                                         int bit) {
  const auto counted = [this](const Impact& impact) {
    ++result_.effort.features;
    return impact;
  };
  if (bit >= FeatureBits::firstCorner(0)) {
    const bool ofFirst = bit < FeatureBits::secondCorner(0);
    const MovingTriangle& vertexOf = ofFirst ? t : u;
    const MovingTriangle& face = ofFirst ? u : t;
    const int k = (bit - FeatureBits::firstCorner(0)) % 3;
    const int side = ofFirst || same_ ? 0 : 1;
    return scratch_.cache.find(FeatureKey::vertexFace(side, vertexOf.vertex(k), face.slot()), [&] {
      return counted(vertexFaceImpact(vertexOf.path(k), face.facePath(), impact_));
    });
  }
  const int i = bit / 3, j = bit % 3;
  const int e = t.edge(i), f = u.edge(j);
  const bool swapped = same_ && f < e;
  return scratch_.cache.find(swapped ? FeatureKey::edges(f, e) : FeatureKey::edges(e, f), [&] {
    return counted(edgeEdgeImpact(t.edgePath(i), u.edgePath(j), impact_));
  });
}

TriangleImpact ImpactQuery::solved(const MovingTriangle& t, const MovingTriangle& u,
                                   unsigned features) {
  TriangleImpact found{t.number(), u.number(), Verdict::Free, 1.0, 1.0};
  for (; features != 0; features &= features - 1) {
    const Impact& impact = solvedFeature(t, u, std::countr_zero(features));
    if (impact.verdict == Verdict::Free) continue;
    found.freeUntil = std::min(found.freeUntil, impact.freeUntil);
    if (impact.verdict == Verdict::Collision) {
      found.verdict = Verdict::Collision;
      found.contactBy = std::min(found.contactBy, impact.contactBy);
    } else if (found.verdict == Verdict::Free) {
      found.verdict = Verdict::Undecided;
    }
  }
  return found;
}

void ImpactQuery::report(const TriangleImpact& impact) {
  if (impact.verdict == Verdict::Free) return;
  TriangleImpact named = impact;
  if (same_ && named.first > named.second) std::swap(named.first, named.second);
  result_.freeUntil = std::min(result_.freeUntil, named.freeUntil);
  const bool first = named.verdict == Verdict::Collision &&
                     (result_.verdict != Verdict::Collision || named.contactBy < result_.contactBy);
  if (first) {
    result_.verdict = Verdict::Collision;
    result_.contactBy = named.contactBy;
  } else if (result_.verdict == Verdict::Free) {
    result_.verdict = Verdict::Undecided;
  }
  if (!options_.firstOnly) {
    result_.impacts.push_back(named);
  } else if (first) {
    result_.impacts.assign(1, named);
    impact_.before = named.contactBy;
  }
}

void ImpactQuery::lookAtStart() {
  for (std::size_t p = 0; p < scratch_.pairs.size() && !done(); ++p) {
    const MovingTriangle t(a_, scratch_.pairs[p].first);
    const MovingTriangle u(b_, scratch_.pairs[p].second);
    if (haveCommonVertex(t, u)) {
      if (scratch_.features[p] != 0)
        scratch_.features[p] = static_cast<std::uint16_t>(scratch_.features[p] & orphans(t, u));
    } else if (trianglesTouch(t.start(), u.start())) {
      scratch_.features[p] = 0;
      report({t.number(), u.number(), Verdict::Collision, 0.0, 0.0});
    }
  }
}

void ImpactQuery::lookAtStep() {
  for (std::size_t p = 0; p < scratch_.pairs.size() && !done(); ++p) {
    if (scratch_.features[p] == 0) continue;
    const MovingTriangle t(a_, scratch_.pairs[p].first);
    const MovingTriangle u(b_, scratch_.pairs[p].second);
    report(solved(t, u, scratch_.features[p]));
  }
}

void ImpactQuery::run() {
  const double reach = std::max({a_.from().reach, a_.end.reach, b_.from().reach, b_.end.reach});
  const float margin = detail::meetingMargin(options_.separation, reach);
  const detail::MovingTree first{&a_.order, &a_.from(), &a_.end};
  const detail::MovingTree second{&b_.order, &b_.from(), &b_.end};
  scratch_.pairs.clear();
  scratch_.cache.clear();
  detail::findMeetingPairs(first, second, same_, margin, scratch_.open, scratch_.pairs);
  detail::findMeetingFeatures(first, second, margin, scratch_.pairs, scratch_.features);
  result_.effort.candidates = static_cast<std::int64_t>(scratch_.pairs.size());
  result_.verdict = Verdict::Free;
  result_.freeUntil = 1.0;
  lookAtStart();
  lookAtStep();
  std::sort(result_.impacts.begin(), result_.impacts.end());
}

void impacts(const Mesh& a, const Mesh& b, const DeformingOptions& options, DeformingResult& result,
             DeformingWorkspace& workspace) {
  result.verdict = Verdict::Undecided;
  result.freeUntil = 0.0;
  result.contactBy = 1.0;
  result.impacts.clear();
  result.effort = {};
  if (!std::isfinite(options.separation) || !std::isfinite(options.tolerance)) return;
  DeformingOptions usable = options;
  usable.separation = std::max(0.0, options.separation);
  usable.tolerance = std::max(0.0, options.tolerance);
  ImpactQuery(a, b, usable, result, workspace.data()).run();
}

}  // namespace

void selfCollideContinuous(const DeformingMesh& mesh, const DeformingOptions& options,
                           DeformingResult& result, DeformingWorkspace& workspace) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return selfCollideContinuous(mesh, options, result, workspace); });
  }
  impacts(mesh.data(), mesh.data(), options, result, workspace);
}

void collideContinuous(const DeformingMesh& a, const DeformingMesh& b,
                       const DeformingOptions& options, DeformingResult& result,
                       DeformingWorkspace& workspace) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return collideContinuous(a, b, options, result, workspace); });
  }
  impacts(a.data(), b.data(), options, result, workspace);
}

}  // namespace swept
