// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <span>
#include <utility>
#include <vector>

#include "geometry/orientation.hpp"

namespace swept::detail {

/// Closed triangulated surface, outward oriented.
struct HullSurface {
  std::vector<std::array<int, 3>> faces;  ///< indices of points
  std::vector<std::array<int, 3>>
      neighbors;  ///< of each face, across the edge from corner i to i + 1
};

/// Quickhull (Barber, Dobkin, Huhdanpaa 1996). Where we deviate: which faces a new point sees is
/// decided exactly, so the faces it sees always form a disc and faces never have to be merged.
/// Points that are not certainly ahead of a face are passed over; what they miss is measured by the
/// caller.
class Quickhull {
 public:
  /// `start` are four points, meant to span a volume. Coordinates are at most 1 in magnitude.
  Quickhull(std::span<const Eigen::Vector3d> points, const std::array<int, 4>& start)
      : points_(points), next_(points.size(), kNone), faceFrom_(points.size(), kNone) {
    addTetrahedron(start);
    // Adding a point removes the face it is ahead of, so each face is looked at once.
    for (std::size_t face = 0; face < faces_.size() && consistent_; ++face) {
      if (faces_[face].alive && faces_[face].farthest != kNone)
        addFarthestOf(static_cast<int>(face));
    }
  }

  /// False when the start has no volume, or the arithmetic was not exact after all (underflow). The
  /// surface is then unusable.
  bool consistent() const { return consistent_; }

  HullSurface surface() const {
    std::vector<int> index(faces_.size(), kNone);
    HullSurface out;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (!faces_[i].alive) continue;
      index[i] = static_cast<int>(out.faces.size());
      out.faces.push_back(faces_[i].corners);
      out.neighbors.push_back(faces_[i].neighbors);
    }
    for (std::array<int, 3>& neighbors : out.neighbors) {
      for (int& neighbor : neighbors) neighbor = index[neighbor];
    }
    return out;
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

  /// Puts the point on the list of one face from `firstFace` on that it is certainly ahead of.
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

  /// The horizon is one closed loop through distinct vertices when the decisions are exact.
  bool horizonIsLoop() {
    for (const HorizonEdge& edge : horizon_) faceFrom_[edge.from] = kNone;
    for (std::size_t i = 0; i < horizon_.size(); ++i) {
      if (faceFrom_[horizon_[i].from] != kNone) return false;
      faceFrom_[horizon_[i].from] = static_cast<int>(i);
    }
    std::size_t length = 0;
    int vertex = horizon_.front().from;
    do {
      const int edge = faceFrom_[vertex];
      if (edge == kNone) return false;
      vertex = horizon_[edge].to;
    } while (vertex != horizon_.front().from && ++length <= horizon_.size());
    return length + 1 == horizon_.size();
  }

  void addFarthestOf(int firstFace) {
    const int apex = faces_[firstFace].farthest;
    collectHorizon(apex, firstFace);
    consistent_ = horizon_.size() >= 3 && horizonIsLoop();
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
      for (int point = faces_[removed].firstAhead; point != kNone;) {
        const int following = next_[point];
        if (point != apex) assign(point, firstNew);
        point = following;
      }
    }
  }

  std::span<const Eigen::Vector3d> points_;
  std::vector<int> next_;
  std::vector<int> faceFrom_;  ///< scratch: the edge or face that leaves a horizon vertex
  std::vector<Face> faces_;
  std::vector<int> visible_;
  std::vector<HorizonEdge> horizon_;
  bool consistent_ = true;
};

}  // namespace swept::detail
