// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/polytope.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// Sine of the angle between a face's edges: thinner faces have no normal.
constexpr double kLeastSine = 1e-9;

}  // namespace

Polytope::Polytope(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b)
    : a_(a), b_(b), rotation_(a_from_b.linear()), offset_(a_from_b.translation()) {
  const double magnitude = a.extent + b.extent + offset_.cwiseAbs().sum();
  rounding_ = tolerance::kSupportRounding * magnitude + a.error + b.error;
}

Polytope::Vertex Polytope::support(const Vector3d& n) {
  ++evaluations_;
  const Vector3d onA = a_.support(-n);
  return {rotation_ * b_.support(rotation_.transpose() * n) + offset_ - onA, onA};
}

bool Polytope::start(const Simplex& simplex, Vector3d& flat) {
  for (int i = 0; i < simplex.size; ++i) {
    vertices_[vertexCount_++] = {simplex.vertices[i].difference, simplex.vertices[i].a};
  }
  const double least = 4.0 * rounding_;
  dropFlat(least);
  if (vertexCount_ == 0) vertices_[vertexCount_++] = support(Vector3d::UnitX());
  while (vertexCount_ < 4) {
    if (!widen(least, flat)) return false;
  }
  const Vector3d normal = edge(1).cross(edge(2));
  const double norm = normal.norm();
  if (norm > 0.0) flat = normal / norm;
  return makeTetrahedron();
}

/// Drops vertices that are within `least` of the plane, the line or the point of those before.
void Polytope::dropFlat(double least) {
  if (vertexCount_ == 4) {
    const Vector3d normal = edge(1).cross(edge(2));
    if (!(std::abs(normal.dot(edge(3))) > least * normal.norm())) vertexCount_ = 3;
  }
  if (vertexCount_ == 3) {
    const double longest = std::max(edge(1).norm(), edge(2).norm());
    if (!(edge(1).cross(edge(2)).norm() > least * longest)) vertexCount_ = 2;
  }
  if (vertexCount_ == 2 && !(edge(1).norm() > least)) vertexCount_ = 1;
}

/// Adds a support point off the affine hull of the vertices so far.
bool Polytope::widen(double least, Vector3d& flat) {
  std::array<Vector3d, 3> directions{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  int count = 3;
  if (vertexCount_ == 2) {
    const Vector3d along = edge(1).normalized();
    directions[0] = along.unitOrthogonal();
    directions[1] = along.cross(directions[0]);
    count = 2;
  } else if (vertexCount_ == 3) {
    directions[0] = edge(1).cross(edge(2)).normalized();
    count = 1;
  }
  for (int i = 0; i < count; ++i) {
    for (const double sign : {1.0, -1.0}) {
      const Vector3d n = sign * directions[i];
      const Vertex found = support(n);
      if (!(n.dot(found.difference - point(0)) > least)) continue;
      vertices_[vertexCount_++] = found;
      return true;
    }
    flat = directions[i];
  }
  return false;
}

bool Polytope::makeTetrahedron() {
  center_ = 0.25 * (point(0) + point(1) + point(2) + point(3));
  if (edge(1).cross(edge(2)).dot(edge(3)) > 0.0) std::swap(vertices_[1], vertices_[2]);
  constexpr std::array<std::array<int, 3>, 4> kCorners{
      {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
  constexpr std::array<std::array<int, 3>, 4> kNeighbors{
      {{1, 3, 2}, {2, 3, 0}, {0, 3, 1}, {1, 2, 0}}};
  faceSlots_ = 4;
  for (int i = 0; i < 4; ++i) {
    if (!makeFace(kCorners[i], faces_[i], distances_[i])) return false;
    faces_[i].neighbor = kNeighbors[i];
  }
  return true;
}

bool Polytope::makeFace(const std::array<int, 3>& corners, Face& face, double& distance) const {
  const Vector3d& p = point(corners[0]);
  const Vector3d e = point(corners[1]) - p;
  const Vector3d f = point(corners[2]) - p;
  const Vector3d normal = e.cross(f);
  const double squared = normal.squaredNorm();
  if (!(squared > kLeastSine * kLeastSine * e.squaredNorm() * f.squaredNorm())) return false;
  face.vertex = corners;
  face.normal = normal * (1.0 / std::sqrt(squared));
  face.visit = 0;
  // A thin face's normal may be turned so far that its corners have different heights.
  distance = std::min(face.normal.dot(p), std::min(face.normal.dot(point(corners[1])),
                                                   face.normal.dot(point(corners[2]))));
  return face.normal.dot(center_) < distance;
}

int Polytope::nearestFace() const {
  int best = 0;
  for (int i = 1; i < faceSlots_; ++i) {
    if (distances_[i] < distances_[best]) best = i;
  }
  return best;
}

Simplex Polytope::triangle(int face) const {
  Simplex simplex;
  for (const int k : faces_[face].vertex) {
    const Vertex& v = vertices_[k];
    simplex.vertices[simplex.size++] = {v.difference, v.onA, v.onA + v.difference, 0.0};
  }
  return simplex;
}

bool Polytope::expand(const Vertex& added, int from) {
  // A vertex in the plane of a face beside the hole may lie on the line of their common edge, and
  // the fan would get a face without area. It is better to replace faces in whose plane it lies,
  // too.
  return expand(added, from, 0.0) || expand(added, from, -4.0 * rounding_);
}

bool Polytope::expand(const Vertex& added, int from, double above) {
  if (vertexCount_ == kMaxVertices) return false;
  if (!seeAround(added.difference, from, above) || !borderIsOneLoop()) return false;
  if (faceSlots_ - freeCount_ + borderCount_ > kMaxFaces) return false;
  vertices_[vertexCount_] = added;
  if (!makeFan(vertexCount_)) return false;
  ++vertexCount_;
  return true;
}

/// Walks over the faces that the point sees, always to the next edge in turn, so that the border
/// comes out in order. None of them may be seen from the centre.
bool Polytope::seeAround(const Vector3d& point, int from, double above) {
  ++visit_;
  visibleCount_ = 0;
  borderCount_ = 0;
  struct Step {
    int face;
    int edge;
    int left;  ///< edges still to cross
  };
  std::array<Step, kMaxFaces> stack;
  int depth = 0;
  const auto sees = [&](int face) {
    return faces_[face].normal.dot(point) > distances_[face] + above;
  };
  bool hidden = true;  // from the centre
  const auto enter = [&](int face, int edge, int left) {
    if (above < 0.0) hidden &= faces_[face].normal.dot(center_) < distances_[face] + above;
    faces_[face].visit = visit_;
    visible_[visibleCount_++] = face;
    stack[depth++] = {face, edge, left};
  };
  if (!sees(from)) return false;
  enter(from, 0, 3);
  while (depth > 0) {
    Step& step = stack[depth - 1];
    if (step.left == 0) {
      --depth;
      continue;
    }
    const int face = step.face;
    const int edge = step.edge;
    step.edge = (edge + 1) % 3;
    --step.left;
    const int across = faces_[face].neighbor[edge];
    if (faces_[across].visit == visit_) continue;
    int entry = 0;
    while (entry < 2 && faces_[across].neighbor[entry] != face) ++entry;
    // Two faces may share two edges; the one that starts where ours ends is the right one.
    const int end = faces_[face].vertex[(edge + 1) % 3];
    for (int k = 0; k < 3; ++k) {
      if (faces_[across].neighbor[k] == face && faces_[across].vertex[k] == end) entry = k;
    }
    if (sees(across)) {
      enter(across, (entry + 1) % 3, 2);
    } else {
      if (borderCount_ == kMaxFaces) return false;
      border_[borderCount_++] = {across, entry, faces_[face].vertex[edge], end};
    }
  }
  return hidden && borderCount_ >= 3;
}

bool Polytope::borderIsOneLoop() const {
  for (int i = 0; i < borderCount_; ++i) {
    if (border_[i].to != border_[(i + 1) % borderCount_].from) return false;
  }
  return true;
}

int Polytope::takeSlot() {
  return freeCount_ > 0 ? free_[--freeCount_] : faceSlots_++;
}

/// Makes the new faces before it drops the old ones.
bool Polytope::makeFan(int apex) {
  const int slots = faceSlots_;
  const int freeBefore = freeCount_;
  bool whole = true;
  int made = 0;
  for (; made < borderCount_ && whole; ++made) {
    const int slot = takeSlot();
    fan_[made] = slot;
    whole = makeFace({border_[made].from, border_[made].to, apex}, faces_[slot], distances_[slot]);
  }
  if (!whole) {
    for (int i = 0; i < made; ++i) distances_[fan_[i]] = kGone;
    faceSlots_ = slots;
    freeCount_ = freeBefore;
    return false;
  }
  for (int i = 0; i < borderCount_; ++i) {
    const int next = fan_[(i + 1) % borderCount_];
    const int previous = fan_[(i + borderCount_ - 1) % borderCount_];
    faces_[fan_[i]].neighbor = {border_[i].face, next, previous};
    faces_[border_[i].face].neighbor[border_[i].edge] = fan_[i];
  }
  for (int i = 0; i < visibleCount_; ++i) {
    distances_[visible_[i]] = kGone;
    free_[freeCount_++] = visible_[i];
  }
  return true;
}

}  // namespace swept::detail
