// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "geometry/convex_combination.hpp"
#include "geometry/orientation.hpp"

namespace swept::detail {

/// The face through which a ray from inside a hull leaves.
struct HullExit {
  std::array<int, 3> corners;  ///< indices of points
  int looks = 0;               ///< planes and faces that the ray was compared with
};

/// Quickhull (Barber, Dobkin, Huhdanpaa 1996), with one difference: the faces that a new point sees
/// are decided exactly, so they always form a disc and faces never have to be merged. Points that
/// are not certainly ahead of a face are skipped; the caller measures their loss.
class Quickhull {
 public:
  /// `start` are four points, meant to span a volume. Coordinates are at most 1 in magnitude.
  Quickhull(std::span<const Eigen::Vector3d> points, const std::array<int, 4>& start)
      : points_(points), next_(points.size(), kNone), faceFrom_(points.size(), kNone) {
    addTetrahedron(start);
    // Adding a point removes the face it is ahead of, so each face is processed once.
    for (std::size_t face = 0; face < faces_.size() && consistent_; ++face) {
      if (faces_[face].alive && faces_[face].farthest != kNone)
        addFarthestOf(static_cast<int>(face));
    }
  }

  /// False if the start has no volume, or the arithmetic was not exact after all (underflow). The
  /// surface is then unusable.
  bool consistent() const { return consistent_; }

  /// Closed triangulated surface, outward oriented: indices of points.
  std::vector<std::array<int, 3>> surface() const {
    std::vector<std::array<int, 3>> out;
    for (const Face& face : faces_) {
      if (face.alive) out.push_back(face.corners);
    }
    return out;
  }

  /// The face through which the ray from `inside`, a point within the start, along `offset` leaves
  /// the surface. Rounding may mislead: the answer is a guess.
  ///
  /// It goes from a face of the start to the faces that replaced it, until a face still exists.
  /// These form a fan around the added point; halving finds the ray's turn around that point in the
  /// fan's order. A walk from face to face would take the root of their number, or half of them in
  /// a fan.
  HullExit exitOf(const Eigen::Vector3d& inside, const Eigen::Vector3d& offset) const {
    HullExit found;
    int face = startTowards(inside, offset);
    found.looks = 4;
    while (!faces_[face].alive) face = partTowards(faces_[face], inside, offset, found.looks);
    found.corners = faces_[nearby(face, inside, offset, found.looks)].corners;
    return found;
  }

 private:
  static constexpr int kNone = -1;

  struct Face {
    std::array<int, 3> corners;
    std::array<int, 3> neighbors;
    OrientedPlane plane;
    int firstAhead = kNone;  ///< points certainly ahead, linked through next_
    int farthest = kNone;    ///< of them
    double farthestHeight = 0.0;
    int firstPart = kNone;  ///< of the fan that took its place
    int partCount = 0;
    bool alive = true;
    bool seen = false;
  };
  struct HorizonEdge {
    int from;
    int to;
    int beyond;  ///< the face that stays
  };

  int addFace(int a, int b, int c) {
    faces_.push_back(
        {{a, b, c}, {kNone, kNone, kNone}, OrientedPlane(points_[a], points_[b], points_[c])});
    return static_cast<int>(faces_.size()) - 1;
  }

  void addTetrahedron(std::array<int, 4> corners) {
    auto [a, b, c, d] = corners;
    const int side = exactOrientation(points_[a], points_[b], points_[c], points_[d]);
    consistent_ = side != 0;
    if (side > 0) std::swap(a, b);
    addFace(a, b, c);
    addFace(b, a, d);
    addFace(c, b, d);
    addFace(a, c, d);
    faces_[0].neighbors = {1, 2, 3};
    faces_[1].neighbors = {0, 3, 2};
    faces_[2].neighbors = {0, 1, 3};
    faces_[3].neighbors = {0, 2, 1};
    for (std::size_t point = 0; point < points_.size(); ++point) assign(static_cast<int>(point), 0);
  }

  /// Puts the point on the list of one face, from `firstFace` on, that it is certainly ahead of.
  void assign(int point, std::size_t firstFace) {
    for (std::size_t i = firstFace; i < faces_.size(); ++i) {
      Face& face = faces_[i];
      const double height = face.plane.height(points_[point]);
      if (!(height > face.plane.bound())) continue;
      next_[point] = face.firstAhead;
      face.firstAhead = point;
      if (height > face.farthestHeight) {
        face.farthestHeight = height;
        face.farthest = point;
      }
      return;
    }
  }

  bool sees(int point, const Face& face) const {
    const double height = face.plane.height(points_[point]);
    if (height > face.plane.bound()) return true;
    if (height < -face.plane.bound()) return false;
    return exactOrientation(points_[face.corners[0]], points_[face.corners[1]],
                            points_[face.corners[2]], points_[point]) > 0;
  }

  void collectHorizon(int point, int firstFace) {
    visible_.assign(1, firstFace);
    horizon_.clear();
    faces_[firstFace].seen = true;
    for (std::size_t i = 0; i < visible_.size(); ++i) {
      const Face& face = faces_[visible_[i]];
      for (int edge = 0; edge < 3; ++edge) {
        Face& neighbor = faces_[face.neighbors[edge]];
        if (neighbor.seen) continue;
        if (sees(point, neighbor)) {
          neighbor.seen = true;
          visible_.push_back(face.neighbors[edge]);
        } else {
          horizon_.push_back(
              {face.corners[edge], face.corners[(edge + 1) % 3], face.neighbors[edge]});
        }
      }
    }
  }

  /// Orders the horizon's edges one after the other. They form one closed loop through distinct
  /// vertices if the decisions are exact.
  bool orderHorizon() {
    for (const HorizonEdge& edge : horizon_) faceFrom_[edge.from] = kNone;
    for (std::size_t i = 0; i < horizon_.size(); ++i) {
      if (faceFrom_[horizon_[i].from] != kNone) return false;
      faceFrom_[horizon_[i].from] = static_cast<int>(i);
    }
    loop_.clear();
    int vertex = horizon_.front().from;
    do {
      const int edge = faceFrom_[vertex];
      if (edge == kNone || loop_.size() == horizon_.size()) return false;
      loop_.push_back(horizon_[edge]);
      vertex = horizon_[edge].to;
    } while (vertex != horizon_.front().from);
    horizon_.swap(loop_);
    return horizon_.size() == loop_.size();
  }

  void addFarthestOf(int firstFace) {
    const int apex = faces_[firstFace].farthest;
    collectHorizon(apex, firstFace);
    consistent_ = horizon_.size() >= 3 && orderHorizon();
    if (!consistent_) return;

    const std::size_t firstNew = faces_.size();
    for (const HorizonEdge& edge : horizon_) {
      const int face = addFace(edge.from, edge.to, apex);
      faceFrom_[edge.from] = face;
      faces_[face].neighbors[0] = edge.beyond;
      Face& beyond = faces_[edge.beyond];
      const auto corner = std::find(beyond.corners.begin(), beyond.corners.end(), edge.to);
      beyond.neighbors[static_cast<std::size_t>(corner - beyond.corners.begin())] = face;
    }
    for (std::size_t i = firstNew; i < faces_.size(); ++i) {
      const int following = faceFrom_[faces_[i].corners[1]];
      faces_[i].neighbors[1] = following;
      faces_[following].neighbors[2] = static_cast<int>(i);
    }
    for (const HorizonEdge& edge : horizon_) faceFrom_[edge.from] = kNone;

    for (int removed : visible_) {
      faces_[removed].alive = false;
      faces_[removed].firstPart = static_cast<int>(firstNew);
      faces_[removed].partCount = static_cast<int>(horizon_.size());
      for (int point = faces_[removed].firstAhead; point != kNone;) {
        const int following = next_[point];
        if (point != apex) assign(point, firstNew);
        point = following;
      }
    }
  }

  Cone coneOf(int face, const Eigen::Vector3d& inside) const {
    const std::array<int, 3>& corners = faces_[face].corners;
    return {points_[corners[0]] - inside, points_[corners[1]] - inside,
            points_[corners[2]] - inside};
  }

  int startTowards(const Eigen::Vector3d& inside, const Eigen::Vector3d& offset) const {
    int best = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (int face = 0; face < 4; ++face) {
      const double least = coneOf(face, inside).coordinates(offset).minCoeff();
      if (!(least > most)) continue;
      most = least;
      best = face;
    }
    return best;
  }

  /// The fan's faces are in the order in which their first corners turn around the apex, seen from
  /// outside; the first corner of the first face is where turns begin.
  int partTowards(const Face& gone, const Eigen::Vector3d& inside, const Eigen::Vector3d& offset,
                  int& looks) const {
    const Eigen::Vector3d apex = points_[faces_[gone.firstPart].corners[2]] - inside;
    const auto corner = [&](int part) {
      return Eigen::Vector3d(points_[faces_[gone.firstPart + part].corners[0]] - inside);
    };
    const Eigen::Vector3d fromFirst = apex.cross(corner(0));
    const Eigen::Vector3d toRay = offset.cross(apex);
    const bool rayBeyondHalf = fromFirst.dot(offset) < 0.0;
    int least = 0;
    for (int beyond = gone.partCount; beyond - least > 1; ++looks) {
      const int middle = least + (beyond - least) / 2;
      const Eigen::Vector3d there = corner(middle);
      const bool beyondHalf = fromFirst.dot(there) < 0.0;
      const bool passed = beyondHalf == rayBeyondHalf ? toRay.dot(there) >= 0.0 : rayBeyondHalf;
      (passed ? least : beyond) = middle;
    }
    return gone.firstPart + least;
  }

  /// If rounding led to a face beside the right one, a few steps lead there.
  int nearby(int face, const Eigen::Vector3d& inside, const Eigen::Vector3d& offset,
             int& looks) const {
    constexpr int kMostSteps = 16;
    for (int step = 0, previous = kNone; step < kMostSteps; ++step, ++looks) {
      int opposite = 0;
      if (!(coneOf(face, inside).coordinates(offset).minCoeff(&opposite) < 0.0)) break;
      const int next = faces_[face].neighbors[(opposite + 1) % 3];
      if (next == previous) break;
      previous = face;
      face = next;
    }
    return face;
  }

  std::span<const Eigen::Vector3d> points_;
  std::vector<int> next_;
  std::vector<int> faceFrom_;  ///< scratch: the edge or face that leaves a horizon vertex
  std::vector<Face> faces_;
  std::vector<int> visible_;
  std::vector<HorizonEdge> horizon_;
  std::vector<HorizonEdge> loop_;  ///< scratch: the horizon in order
  bool consistent_ = true;
};

}  // namespace swept::detail
