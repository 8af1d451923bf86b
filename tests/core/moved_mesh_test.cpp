// SPDX-License-Identifier: BSD-3-Clause
// Meshes that deform from frame to frame, each frame against a mesh built of the same vertices.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "bvh/wide_bvh.hpp"
#include "deforming_samples.hpp"
#include "message_of.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Eigen::Vector3i;
using test::Soup;

TriangleMesh build(const Soup& soup, MeshInterior interior = MeshInterior::Solid) {
  return TriangleMesh::build(soup.vertices, soup.triangles, interior);
}

/// Every triangle with corners of its own, as in an STL file; and a vertex that none uses.
Soup unwelded(const Soup& soup) {
  Soup own;
  own.vertices.emplace_back(50.0, 0.0, 0.0);
  for (const Vector3i& triangle : soup.triangles) {
    const int first = static_cast<int>(own.vertices.size());
    for (const int corner : triangle) own.vertices.push_back(soup.vertices[corner]);
    own.triangles.emplace_back(first, first + 1, first + 2);
  }
  return own;
}

/// A smooth bending of space, then a move as a whole.
class Bend {
 public:
  explicit Bend(std::mt19937& random) {
    for (int i = 0; i < 3; ++i) {
      amplitude_[i] = test::uniform(random, -0.1, 0.1);
      wave_.row(i) = 2.0 * test::unitVector(random);
      phase_[i] = test::uniform(random, 0.0, 6.0);
    }
    const double far = random() % 4 == 0 ? 1e4 : 0.3;
    pose_ = test::randomPose(random, far);
  }
  Vector3d operator()(const Vector3d& p) const {
    const Vector3d angles = wave_ * p + phase_;
    return pose_ * (p + amplitude_.cwiseProduct(angles.array().sin().matrix()));
  }
  std::vector<Vector3d> operator()(const std::vector<Vector3d>& points) const {
    std::vector<Vector3d> bent;
    for (const Vector3d& p : points) bent.push_back((*this)(p));
    return bent;
  }

 private:
  Vector3d amplitude_;
  Eigen::Matrix3d wave_;
  Vector3d phase_;
  Isometry3d pose_;
};

struct Agreement {
  int inside = 0;
  int outside = 0;
  int touching = 0;
};

/// Of two meshes that are to be the same set, at points around and against a body.
void expectSame(const TriangleMesh& moved, const TriangleMesh& built, std::mt19937& random,
                Agreement& seen) {
  const Vector3d middle = built.bvh().bounds().center();
  const double size = 0.6 * (built.bvh().bounds().upper - middle).norm();
  const Shape other = makeCapsule(0.2 * size, size);
  for (int i = 0; i < 20; ++i) {
    const Isometry3d pose = Eigen::Translation3d(middle) * test::randomPose(random, size);
    const Vector3d& point = pose.translation();
    EXPECT_EQ(moved.encloses(point), built.encloses(point));
    ++(built.encloses(point) ? seen.inside : seen.outside);
    const DistanceResult a = distance(moved, Sphere{0.0}, Isometry3d(Eigen::Translation3d(point)));
    const DistanceResult b = distance(built, Sphere{0.0}, Isometry3d(Eigen::Translation3d(point)));
    EXPECT_LE(a.lower, b.upper + 1e-12 * middle.norm());
    EXPECT_LE(b.lower, a.upper + 1e-12 * middle.norm());
    EXPECT_EQ(collide(moved, other, pose), collide(built, other, pose));
    seen.touching += collide(built, other, pose) == Contact::Touching ? 1 : 0;
  }
}

TEST(MovedMesh, IsTheMeshOfTheNewVertices) {
  std::mt19937 random(31);
  Soup two = test::torusSoup(20, 10, 0.4, 0.15);
  two.append(test::boxSoup(Vector3d(-0.1, -0.1, 0.3), Vector3d(0.2, 0.1, 0.5)));
  const std::pair<Soup, MeshInterior> soups[] = {
      {two, MeshInterior::Solid},
      {two, MeshInterior::Surface},
      {unwelded(two), MeshInterior::Solid},
      {test::blobSoup(random, 12, 16), MeshInterior::Solid},
      {test::sheetSoup(15, 0.0, 0.0), MeshInterior::Solid},
      {test::boxSoup(Vector3d::Zero(), Vector3d::Ones()), MeshInterior::Solid}};
  Agreement seen;
  for (const auto& [soup, interior] : soups) {
    const TriangleMesh first = build(soup, interior);
    TriangleMesh mesh = first;
    for (int frame = 0; frame < 8; ++frame) {
      Soup next = soup;
      next.vertices = Bend(random)(soup.vertices);
      mesh = mesh.moved(next.vertices);
      const TriangleMesh built = build(next, interior);
      EXPECT_EQ(mesh.isClosed(), built.isClosed());
      EXPECT_EQ(mesh.convexParts().size(), built.convexParts().size());
      EXPECT_EQ(mesh.componentPoints().size(), built.componentPoints().size());
      EXPECT_EQ(mesh.triangles().size(), built.triangles().size());
      EXPECT_EQ(mesh.report().verticesGiven, built.report().verticesGiven);
      expectSame(mesh, built, random, seen);
      if (HasFailure()) return;
    }
    EXPECT_EQ(first.vertices(), build(soup, interior).vertices());
  }
  EXPECT_GT(seen.inside, 60);
  EXPECT_GT(seen.outside, 300);
  EXPECT_GT(seen.touching, 200);
}

/// As in the tree: the points of all triangles below a lane are in its box, and each triangle is
/// below one.
void expectInside(const TriangleMesh& mesh) {
  const detail::WideBvh& bvh = mesh.bvh();
  std::vector<int> leaves(mesh.triangles().size(), 0);
  const auto check = [&](const auto& self, std::int32_t child,
                         const std::vector<detail::OrientedBox>& boxes) -> void {
    if (child >= 0) {
      const detail::WideNode& node = bvh.nodes()[static_cast<std::size_t>(child)];
      for (int lane = 0; lane < node.count; ++lane) {
        auto more = boxes;
        more.push_back(node.box(lane));
        self(self, node.child[lane], more);
      }
      return;
    }
    const auto triangle = static_cast<std::size_t>(-1 - child);
    ++leaves.at(triangle);
    for (const int corner : mesh.triangles()[triangle]) {
      const Vector3d& p = mesh.vertices()[static_cast<std::size_t>(corner)];
      for (const detail::OrientedBox& box : boxes) {
        for (int j = 0; j < 3; ++j) {
          const Vector3d axis(box.axes[j][0], box.axes[j][1], box.axes[j][2]);
          EXPECT_LE(std::abs(axis.dot(p - box.center)), box.half[j] + 1e-13 * p.norm());
        }
      }
    }
  };
  check(check, 0, {});
  EXPECT_FALSE(leaves.empty());
  EXPECT_EQ(leaves, std::vector<int>(leaves.size(), 1));
}

TEST(MovedMesh, BoxesHoldTheirTriangles) {
  std::mt19937 random(32);
  const Soup soup = test::torusSoup(40, 20, 0.4, 0.15);
  TriangleMesh mesh = build(soup);
  for (int frame = 0; frame < 6; ++frame) {
    mesh = mesh.moved(Bend(random)(soup.vertices));
    expectInside(mesh);
  }
}

TEST(MovedMesh, BoxesThatGotLargeAreMadeAnew) {
  std::mt19937 random(33);
  // Tiles, each a triangle of its own, that change places.
  Soup tiles;
  std::vector<Vector3d> places;
  for (int i = 0; i < 1000; ++i) {
    places.emplace_back(i % 10, i / 10 % 10, i / 100);
    tiles.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  const auto tilesAt = [](const std::vector<Vector3d>& at) {
    std::vector<Vector3d> vertices;
    for (const Vector3d& place : at)
      for (int k = 0; k < 3; ++k) vertices.push_back(place + 0.3 * Vector3d::Unit(k));
    return vertices;
  };
  tiles.vertices = tilesAt(places);
  const TriangleMesh ordered = build(tiles);
  std::shuffle(places.begin(), places.end(), random);
  const TriangleMesh shuffled = ordered.moved(tilesAt(places));
  expectInside(shuffled);
  const auto fresh = [&] { return build({tilesAt(places), tiles.triangles}).bvh().spread(); };
  EXPECT_LE(shuffled.bvh().spread(), 1.1 * fresh());
  // The next ones are held against the new order.
  for (Vector3d& place : places) place += 0.1 * test::unitVector(random);
  EXPECT_LE(shuffled.moved(tilesAt(places)).bvh().spread(), 1.3 * fresh());
}

TEST(MovedMesh, WhatIsConnectedStaysSoAndNothingElseBecomesSo) {
  // A strip of four walls that closes: ends on each other are not joined.
  const Soup box = test::boxSoup(Vector3d::Zero(), Vector3d::Ones());
  Soup open = box;
  open.vertices.push_back(open.vertices[7] + Vector3d(0.5, 0.5, 0.5));
  for (int& corner : open.triangles.back())
    if (corner == 7) corner = 8;
  std::vector<Vector3d> closing = open.vertices;
  closing.back() = closing[7];
  const TriangleMesh closed = build(open).moved(closing);
  EXPECT_FALSE(closed.isClosed());
  EXPECT_FALSE(closed.encloses(Vector3d(0.3, 0.4, 0.6)));
  EXPECT_TRUE(build({closing, open.triangles}).encloses(Vector3d(0.3, 0.4, 0.6)));
  // All in one point, and out again.
  const TriangleMesh point =
      build(box).moved(std::vector<Vector3d>(box.vertices.size(), Vector3d(1.0, 2.0, 3.0)));
  const Isometry3d at(Eigen::Translation3d(1.0, 2.0, 5.0));
  EXPECT_NEAR(distance(point, Sphere{0.5}, at).upper, 1.5, 1e-12);
  EXPECT_EQ(point.triangles().size(), 12U);
  const TriangleMesh again = point.moved(box.vertices);
  EXPECT_TRUE(again.encloses(Vector3d(0.3, 0.4, 0.6)));
  EXPECT_EQ(again.convexParts().size(), 1U);
  EXPECT_FALSE(again.encloses(Vector3d(1.0, 2.0, 3.0)));
}

/// Corners fall together, edges lie on each other, faces lose their area.
TEST(MovedMesh, DegenerateTrianglesKeepTheirDistances) {
  std::mt19937 random(34);
  const Soup soup = test::torusSoup(16, 8, 0.4, 0.15);
  const TriangleMesh mesh = build(soup);
  int inside = 0, outside = 0;
  for (int frame = 0; frame < 60; ++frame) {
    std::vector<Vector3d> vertices = soup.vertices;
    for (int i = 0; i < 20; ++i) {
      const Vector3i& t = soup.triangles[random() % soup.triangles.size()];
      vertices[t[0]] = vertices[t[1]];
      if (i % 3 == 0) vertices[t[2]] = vertices[t[1]];
      if (i % 3 == 1) vertices[t[2]] = vertices[random() % vertices.size()];
    }
    const TriangleMesh moved = mesh.moved(vertices);
    for (int i = 0; i < 10; ++i) {
      const Isometry3d at(Eigen::Translation3d(test::uniformPoint(random, 0.7)));
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vector3i& t : soup.triangles) {
        const Triangle triangle{{vertices[t[0]], vertices[t[1]], vertices[t[2]]}};
        nearest = std::min(nearest, distance(triangle, Sphere{0.0}, at).upper);
      }
      const bool isInside = moved.encloses(at.translation());
      ++(isInside ? inside : outside);
      const DistanceResult found = distance(moved, Sphere{0.0}, at);
      EXPECT_NEAR(found.upper, isInside ? 0.0 : nearest, 1e-9);
      EXPECT_LE(found.lower, (isInside ? 0.0 : nearest) + 1e-9);
    }
  }
  EXPECT_GT(inside, 5);
  EXPECT_GT(outside, 400);
}

std::string messageOf(const TriangleMesh& mesh, const std::vector<Vector3d>& vertices) {
  return test::messageOf([&] { (void)mesh.moved(vertices); });
}

TEST(MovedMesh, BadVerticesAreNamed) {
  const Soup box = unwelded(test::boxSoup(Vector3d::Zero(), Vector3d::Ones()));
  const TriangleMesh mesh = build(box);
  EXPECT_EQ(messageOf(mesh, {}), "mesh of 37 vertices is moved to 0");
  std::vector<Vector3d> bad = box.vertices;
  bad[0].x() = std::numeric_limits<double>::quiet_NaN();  // though no triangle uses it
  EXPECT_EQ(messageOf(mesh, bad), "mesh vertex 0 is (nan, 0, 0); allowed: finite coordinates");
  bad = box.vertices;
  bad[20].z() += 0.25;
  std::size_t equal = 0;
  while (equal == 20 || box.vertices[equal] != box.vertices[20]) ++equal;
  const auto text = [](const Vector3d& p) {
    std::ostringstream out;
    out << '(' << p.x() << ", " << p.y() << ", " << p.z() << ')';
    return out.str();
  };
  EXPECT_EQ(messageOf(mesh, bad), "mesh vertices " + std::to_string(equal) +
                                      " and 20 were equal when the mesh was built and are moved "
                                      "apart, to " +
                                      text(bad[equal]) + " and " + text(bad[20]) +
                                      "; what tears has to be built anew");
}

}  // namespace
}  // namespace swept
