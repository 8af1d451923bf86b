// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef SWEPT_HAS_FCL

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "self_collision_fcl.hpp"
#include "timing.hpp"

/// Why swept and FCL say different things of a state: by FCL's distance and by winding numbers.
namespace swept::benchmark {

/// m. What counts as rounding: FCL's triangle and shape tests have tolerances of that order.
constexpr double kTouching = 1e-6;

/// Turns of a mesh's triangles around a point (van Oosterom, Strackee 1983): not 0 inside, for
/// triangles that are oriented outwards; with open ones among them, about half of what is behind.
inline double windingNumber(const TriangleMesh& mesh, const Eigen::Vector3d& point) {
  double sum = 0.0;
  for (const TriangleMesh::Triangle& t : mesh.triangles()) {
    const Eigen::Vector3d a = mesh.vertices()[t[0]] - point, b = mesh.vertices()[t[1]] - point,
                          c = mesh.vertices()[t[2]] - point;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2.0 * std::atan2(a.dot(b.cross(c)),
                            la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4.0 * std::numbers::pi);
}

/// A component of `inner`, or the whole of it, begins inside the mesh `outer`.
inline bool encloses(const CollisionGeometry& outer, const CollisionGeometry& inner,
                     const Eigen::Isometry3d& outerLink_from_innerLink) {
  const auto* mesh = std::get_if<TriangleMesh>(&outer.shape);
  if (mesh == nullptr) return false;
  const Eigen::Isometry3d outer_from_inner =
      outer.link_from_shape.inverse() * outerLink_from_innerLink * inner.link_from_shape;
  const auto inside = [&](const Eigen::Vector3d& point) {
    return std::abs(windingNumber(*mesh, outer_from_inner * point)) > 0.5;
  };
  const auto* other = std::get_if<TriangleMesh>(&inner.shape);
  if (other == nullptr) return inside(Eigen::Vector3d::Zero());
  return std::ranges::any_of(other->componentPoints(), inside);
}

/// Counts what differs, and prints one line for the first pairs of links of each kind.
class SelfJudge {
 public:
  SelfJudge(const Checker& checker, FclSelf& fcl)
      : checker_(checker), fcl_(fcl), workspace_(checker) {}

  /// Of a state on which the verdict (not Undecided) and FCL do not agree.
  void judge(std::span<const double> q) {
    const StateReport report = checker_.reportState(q, workspace_);
    fcl_.place(q);
    ++states_;
    std::set<std::pair<std::string, std::string>> ours;
    for (const Witness& contact : report.contacts) ours.insert({contact.bodyA, contact.bodyB});
    bool explained = false;
    for (const Checker::Pair& pair : checker_.checkedPairs()) {
      const int a = *checker_.robot().findLink(pair.bodyA);
      const int b = *checker_.robot().findLink(pair.bodyB);
      const bool contact = ours.contains({pair.bodyA, pair.bodyB});
      if (contact == fcl_.collides(a, b)) continue;
      const double distance = fcl_.distance(a, b);
      const std::string reason = reasonOf(a, b, contact, distance);
      explained = explained || reason != kUnexplained;
      note(pair, reason, distance, contact ? 0.0 : report.clearance);
    }
    if (!explained) ++unexplained_;
  }

  void print() const {
    std::printf("%d states differ, %d of them unexplained\n", states_, unexplained_);
    for (const auto& [reason, count] : counts_)
      std::printf("* %d pairs: %s\n", count, reason.c_str());
    for (const std::string& line : lines_) std::printf("    %s\n", line.c_str());
  }
  int unexplained() const { return unexplained_; }

 private:
  static constexpr const char* kUnexplained = "not explained";

  std::string reasonOf(int a, int b, bool contact, double distance) const {
    if (contact) {
      if (isEnclosed(a, b)) return "one inside the other's mesh, which is hollow for FCL";
      if (distance <= kTouching) return "in contact; FCL's distance agrees, its yes or no does not";
      return kUnexplained;
    }
    if (distance > 0.0) return "apart; FCL's distance agrees, its yes or no does not";
    return kUnexplained;
  }

  bool isEnclosed(int a, int b) const {
    const auto& links = checker_.robot().links();
    const Eigen::Isometry3d a_from_b = fcl_.poseOfLink(a).inverse() * fcl_.poseOfLink(b);
    for (const CollisionGeometry& first : links[a].collision)
      for (const CollisionGeometry& second : links[b].collision)
        if (encloses(first, second, a_from_b) || encloses(second, first, a_from_b.inverse()))
          return true;
    return false;
  }

  void note(const Checker::Pair& pair, const std::string& reason, double distance,
            double clearance) {
    constexpr int kShown = 6;
    if (++counts_[reason] > kShown) return;
    lines_.push_back(pair.bodyA + " - " + pair.bodyB + ": " + reason + "; FCL's distance " +
                     number(distance) + " m, clearance of all " + number(clearance) + " m");
  }

  const Checker& checker_;
  FclSelf& fcl_;
  Workspace workspace_;
  int states_ = 0, unexplained_ = 0;
  std::map<std::string, int> counts_;
  std::vector<std::string> lines_;
};

}  // namespace swept::benchmark
#endif
