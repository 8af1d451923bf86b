// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/contacts.hpp"

#include "geometry/nearest_rotation.hpp"
#include "narrowphase/convex_pair.hpp"
#include "narrowphase/piece_pair.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept {

namespace {

using detail::Piece;
using detail::PiecePair;
using detail::Side;
using Eigen::Isometry3d;
using Eigen::Vector3d;

class Collector {
 public:
  Collector(const Side& a, const Side& b, const Isometry3d& a_from_b, std::size_t most,
            std::vector<ContactPoint>& contacts)
      : a_(a), pieces_(a, b, a_from_b), contacts_(contacts) {
    end_ =
        most < contacts.max_size() - contacts.size() ? contacts.size() + most : contacts.max_size();
  }

  /// Returns false if the list is full before every pair was tested.
  bool run() { return descend(pieces_.rootA(), pieces_.rootB()); }
  int effort() const { return effort_; }

 private:
  bool descend(const Piece& pieceA, const Piece& pieceB) {
    if (pieceA.isLeaf() && pieceB.isLeaf()) return testLeaves(pieceA, pieceB);
    detail::WideNode room;
    const PiecePair::Split split = pieces_.split(pieceA, pieceB, room);
    const Piece& other = split.ofA ? pieceB : pieceA;
    PiecePair::Bounds lower;
    pieces_.boundChildren(split, other, 0.0, lower);
    effort_ += split.node->count;
    for (int lane = 0; lane < split.node->count; ++lane) {
      if (lower[lane] > 0.0F) continue;
      const Piece child = PiecePair::child(split, lane);
      if (!(split.ofA ? descend(child, other) : descend(other, child))) return false;
    }
    return true;
  }

  bool testLeaves(const Piece& pieceA, const Piece& pieceB) {
    ++effort_;
    ContactPoint contact;
    const bool touching = pieces_.areTriangles(pieceA, pieceB)
                              ? touchTriangles(pieceA.primitive, pieceB.primitive, contact)
                              : touchConvex(pieceA, pieceB, contact);
    if (!touching) return true;
    if (contacts_.size() >= end_) return false;
    contact.pieceA = pieceA.primitive;
    contact.pieceB = pieceB.primitive;
    contacts_.push_back(contact);
    return true;
  }

  bool touchTriangles(int triangleA, int triangleB, ContactPoint& contact) const {
    const TriangleCorners a = detail::cornersOf(*a_.mesh, triangleA);
    const TriangleCorners b = pieces_.movedCorners(triangleB);
    if (!trianglesTouch(a, b)) return false;
    const TriangleContact found = triangleContact(a, b);
    contact.pointA = found.pointA;
    contact.pointB = found.pointB;
    contact.normal = found.normal;
    contact.depth = found.depth;
    return true;
  }

  /// Leaves of which at least one is not a triangle.
  bool touchConvex(const Piece& pieceA, const Piece& pieceB, ContactPoint& contact) const {
    PiecePair::Leaves leaves;
    pieces_.place(pieceA, pieceB, leaves);
    const SignedDistanceResult found =
        detail::convexPairSigned(leaves.a, leaves.b, leaves.a_from_b, tolerance::kDistance);
    if (!(found.upper <= 0.0)) return false;
    contact = {found.pointA + leaves.centerA,
               found.pointB + leaves.centerA,
               found.normal,
               -found.lower,
               -1,
               -1};
    return true;
  }

  const Side& a_;
  const PiecePair pieces_;
  std::vector<ContactPoint>& contacts_;
  std::size_t end_;
  int effort_ = 0;
};

/// The one contact of two shapes as wholes.
ContactsResult wholeContact(const Shape& a, const Shape& b, const Isometry3d& a_from_b,
                            std::size_t most, std::vector<ContactPoint>& contacts) {
  const SignedDistanceResult found = signedDistance(a, b, a_from_b);
  ContactsResult result;
  result.effort = found.iterations;
  result.complete = true;
  if (found.lower > 0.0) {
    result.status = Contact::Separate;
  } else if (found.upper <= 0.0) {
    result.status = Contact::Touching;
    result.complete = most > 0;
    if (most > 0) contacts.push_back({found.pointA, found.pointB, found.normal, -found.lower});
  }
  return result;
}

}  // namespace

ContactsResult findContacts(const Shape& a, const Shape& b, const Isometry3d& a_from_b,
                            std::size_t most, std::vector<ContactPoint>& contacts) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, most] { return findContacts(a, b, a_from_b, most, contacts); });
  }
  if (!detail::isRigidPose(a_from_b)) {
    const auto rigid = detail::nearestRigidPose(a_from_b);
    return rigid ? findContacts(a, b, *rigid, most, contacts) : ContactsResult{};
  }
  const Side sideA = Side::of(a);
  const Side sideB = Side::of(b);
  if (sideA.isConvex() && sideB.isConvex()) {
    return wholeContact(a, b, a_from_b, most, contacts);
  }
  const std::size_t before = contacts.size();
  Collector collector(sideA, sideB, a_from_b, most, contacts);
  const bool complete = collector.run();
  if (complete && contacts.size() == before) {
    // No surfaces meet: apart, closer than rounding can tell, or one inside the other.
    ContactsResult result;
    result.status = collide(a, b, a_from_b);
    result.complete = true;
    if (result.status == Contact::Touching) {
      result = wholeContact(a, b, a_from_b, most, contacts);
    }
    result.effort += collector.effort();
    return result;
  }
  return {Contact::Touching, complete, collector.effort()};
}

}  // namespace swept
