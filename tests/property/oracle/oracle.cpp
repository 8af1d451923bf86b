// SPDX-License-Identifier: BSD-3-Clause
#include "oracle.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace oracle {

Oracle::Oracle(Arm arm, std::vector<Body> world, const std::string& group)
    : arm_(std::move(arm)), world_(std::move(world)) {
  const std::set<std::string> names = arm_.groupVariables(group);
  for (size_t i = 0; i < arm_.variables().size(); ++i)
    if (names.count(arm_.variables()[i].name)) moving_.push_back(static_cast<int>(i));
  jointAbove_.assign(arm_.links().size(), -1);
  for (size_t j = 0; j < arm_.joints().size(); ++j)
    jointAbove_[arm_.joints()[j].child] = static_cast<int>(j);
  for (const Body& body : world_) {
    placedWorld_.emplace_back();
    for (const Piece& piece : body.pieces)
      placedWorld_.back().push_back(place(piece, Isometry3d::Identity()));
  }
  findPairs();
}

/// Whether a joint that the group moves lies on the way from one link to the other; -1 is the
/// world.
bool Oracle::movesBetween(int linkA, int linkB) const {
  auto path = [&](int link) {
    std::set<int> joints;
    while (link >= 0 && jointAbove_[link] >= 0) {
      joints.insert(jointAbove_[link]);
      link = arm_.joints()[jointAbove_[link]].parent;
    }
    return joints;
  };
  const std::set<int> a = path(linkA), b = path(linkB);
  std::vector<int> between;
  std::set_symmetric_difference(a.begin(), a.end(), b.begin(), b.end(),
                                std::back_inserter(between));
  return std::any_of(between.begin(), between.end(), [&](int j) {
    return std::count(moving_.begin(), moving_.end(), arm_.joints()[j].variable) > 0;
  });
}

void Oracle::findPairs() {
  const auto& links = arm_.links();
  const int count = static_cast<int>(links.size());
  for (int a = 0; a < count; ++a) {
    if (links[a].pieces.empty()) continue;
    if (movesBetween(a, -1))
      for (size_t b = 0; b < world_.size(); ++b)
        if (!world_[b].pieces.empty()) pairs_.push_back({a, static_cast<int>(b), true});
    for (int b = a + 1; b < count; ++b) {
      if (links[b].pieces.empty() || arm_.disabled(links[a].name, links[b].name)) continue;
      const bool joined =
          std::any_of(arm_.joints().begin(), arm_.joints().end(), [&](const ArmJoint& j) {
            return (j.parent == a && j.child == b) || (j.parent == b && j.child == a);
          });
      if (!joined && movesBetween(a, b)) pairs_.push_back({a, b, false});
    }
  }
}

std::vector<std::pair<std::string, std::string>> Oracle::pairs() const {
  std::vector<std::pair<std::string, std::string>> names;
  for (const Pair& p : pairs_)
    names.emplace_back(arm_.links()[p.a].name, p.world ? world_[p.b].name : arm_.links()[p.b].name);
  return names;
}

Oracle::Placed Oracle::place(const Piece& piece, const Isometry3d& model_from_body) {
  const Isometry3d pose = model_from_body * piece.body_from_piece;
  return {&piece, pose, pose * piece.boxCenter};
}

void Oracle::placeLinks(const std::vector<double>& q, Placement& links) const {
  std::vector<Isometry3d> poses;
  arm_.poses(q, poses);
  links.resize(poses.size());
  for (size_t i = 0; i < poses.size(); ++i)
    for (const Piece& piece : arm_.links()[i].pieces) links[i].push_back(place(piece, poses[i]));
}

Oracle::Hit Oracle::hit(const std::vector<double>& q) const {
  Placement links;
  placeLinks(q, links);
  for (const Pair& pair : pairs_) {
    for (const Placed& a : links[pair.a]) {
      for (const Placed& b : pair.world ? placedWorld_[pair.b] : links[pair.b]) {
        const double reach = a.piece->radius + b.piece->radius;
        if ((a.center - b.center).squaredNorm() > reach * reach) continue;
        if (surelyOverlap(*a.piece, *b.piece, a.model_from_piece.inverse() * b.model_from_piece))
          return {arm_.links()[pair.a].name,
                  pair.world ? world_[pair.b].name : arm_.links()[pair.b].name};
      }
    }
  }
  return {};
}

Gap Oracle::clearance(const std::vector<double>& q, double enough) const {
  Placement links;
  placeLinks(q, links);
  Gap least{enough, enough};
  for (const Pair& pair : pairs_)
    for (const Placed& a : links[pair.a])
      for (const Placed& b : pair.world ? placedWorld_[pair.b] : links[pair.b]) {
        const double reach = a.piece->radius + b.piece->radius + least.upper;
        if ((a.center - b.center).squaredNorm() > reach * reach) continue;
        const Gap g =
            gap(*a.piece, *b.piece, a.model_from_piece.inverse() * b.model_from_piece, least.upper);
        least.lower = std::min(least.lower, g.lower);
        least.upper = std::min(least.upper, g.upper);
      }
  return least;
}

double Oracle::distanceTo(const std::string& body, const std::vector<double>& q,
                          const Vector3d& p) const {
  Placement links;
  placeLinks(q, links);
  std::vector<Placed> placed;
  for (size_t i = 0; i < links.size(); ++i)
    if (arm_.links()[i].name == body) placed = links[i];
  for (size_t i = 0; i < world_.size(); ++i)
    if (world_[i].name == body) placed = placedWorld_[i];
  if (placed.empty()) throw std::runtime_error("no body " + body);
  double best = INFINITY;
  for (const Placed& part : placed)
    best = std::min(best, oracle::distanceTo(*part.piece, part.model_from_piece.inverse() * p));
  return best;
}

}  // namespace oracle
