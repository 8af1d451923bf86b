// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/enclosing_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "mesh_samples.hpp"
#include "screwing_samples.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/separation.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace {

using namespace swept;
using namespace swept::test;
using detail::EnclosingParts;
using Eigen::Isometry3d;
using Eigen::Vector3d;

/// A bracket of three boxes that overlap, a torus, a bumpy solid, and an open sheet that curls.
Soup bracket() {
  Soup soup = boxSoup({0, 0, 0}, {1.0, 0.2, 0.2});
  soup.append(boxSoup({0, 0, 0.05}, {0.2, 1.0, 0.15}));
  soup.append(boxSoup({0.05, 0.05, 0}, {0.15, 0.15, 1.0}));
  return soup;
}

Soup curl() {
  Soup soup;
  constexpr int kSteps = 40;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = 5.0 * i / kSteps;
    const double radius = 0.3 + 0.1 * angle;
    for (const double z : {-0.4, 0.4})
      soup.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
  }
  for (int i = 0; i < kSteps; ++i) {
    soup.triangles.emplace_back(2 * i, 2 * i + 1, 2 * i + 2);
    soup.triangles.emplace_back(2 * i + 1, 2 * i + 3, 2 * i + 2);
  }
  return soup;
}

std::vector<TriangleMesh> samples(std::mt19937& random) {
  std::vector<TriangleMesh> meshes;
  const auto add = [&](const Soup& soup, MeshInterior interior = MeshInterior::Solid) {
    meshes.push_back(
        TriangleMesh::build(soup.vertices, soup.triangles, interior).withEnclosingParts());
  };
  for (const Soup& soup :
       {bracket(), torusSoup(24, 12, 1.0, 0.25), blobSoup(random, 9, 14), curl()})
    for (const double size : {1.0, 1e-3, 1e4}) {
      Soup own = soup.moved(randomPose(random, 2.0));
      for (Vector3d& vertex : own.vertices) vertex *= size;
      add(own);
    }
  add(bracket(), MeshInterior::Surface);
  return meshes;
}

/// Whether a part of the node, and of its children below it, has the point.
bool holds(const EnclosingParts& parts, int node, const Vector3d& point) {
  const Isometry3d part_from_point(Eigen::Translation3d{point});
  const auto& own = parts.nodes[static_cast<std::size_t>(node)].parts;
  return std::ranges::any_of(own, [&](const EnclosingParts::Part& part) {
    return distance(part.hull, Sphere{0.0}, part_from_point).lower <= part.radius &&
           (part.children < 0 || holds(parts, part.children, point));
  });
}

Vector3d pointOfTriangle(const TriangleMesh& mesh, std::mt19937& random) {
  const auto last = static_cast<double>(mesh.triangles().size());
  const Eigen::Vector3i& t = mesh.triangles()[static_cast<std::size_t>(uniform(random, 0.0, last))];
  double u = uniform(random, 0.0, 1.0), v = uniform(random, 0.0, 1.0);
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  const Vector3d& a = mesh.vertices()[t[0]];
  return a + u * (mesh.vertices()[t[1]] - a) + v * (mesh.vertices()[t[2]] - a);
}

/// Points of the surface and of the interior are in leaves. The parts are worth having: far fewer
/// points of the hull than of the parts lie outside of the mesh.
TEST(EnclosingParts, ContainTheMesh) {
  std::mt19937 random(3);
  int inside = 0, nodes = 0;
  double hulls = 0.0, parts = 0.0;
  for (const TriangleMesh& mesh : samples(random)) {
    ASSERT_NE(mesh.enclosingParts(), nullptr)
        << mesh.concavity() << " " << mesh.hull().ball().radius << " " << mesh.triangles().size();
    const EnclosingParts& own = *mesh.enclosingParts();
    nodes += static_cast<int>(own.nodes.size());
    for (int i = 0; i < 500; ++i) ASSERT_TRUE(holds(own, 0, pointOfTriangle(mesh, random)));
    const BoundingSphere& ball = mesh.hull().ball();
    for (int i = 0; i < 1000; ++i) {
      const Vector3d point = ball.center + uniformPoint(random, ball.radius);
      const bool encloses = mesh.encloses(point);
      const bool inParts = holds(own, 0, point);
      if (encloses) {
        ++inside;
        ASSERT_TRUE(inParts);
      }
      const Isometry3d hull_from_point(Eigen::Translation3d{point});
      hulls += !encloses && !(distance(mesh.hull(), Sphere{0.0}, hull_from_point).lower > 0.0);
      parts += !encloses && inParts;
    }
  }
  EXPECT_GT(inside, 800);
  EXPECT_GT(nodes, 40);
  EXPECT_LT(parts, 0.35 * hulls);
}

/// The volume of so thin a hull, estimated by few directions, is negative.
TEST(EnclosingParts, TwoThinPiecesFarApart) {
  const std::vector<Vector3d> vertices{{3, 3, -4},  {3, 7, -4},  {2, 2, -3},  {7, 1, -7},
                                       {0, -5, -7}, {1, -2, -3}, {4, -5, -8}, {0, -3, -8}};
  std::vector<Eigen::Vector3i> triangles;
  for (const int first : {0, 4})
    for (const Eigen::Vector3i& face : {Eigen::Vector3i(0, 2, 1), Eigen::Vector3i(0, 1, 3),
                                        Eigen::Vector3i(0, 3, 2), Eigen::Vector3i(1, 2, 3)})
      triangles.emplace_back(face + Eigen::Vector3i::Constant(first));
  const TriangleMesh mesh = TriangleMesh::build(vertices, triangles).withEnclosingParts();
  ASSERT_NE(mesh.enclosingParts(), nullptr);
  std::mt19937 random(4);
  for (int i = 0; i < 500; ++i)
    ASSERT_TRUE(holds(*mesh.enclosingParts(), 0, pointOfTriangle(mesh, random)));
}

/// Parts of triangles that lie apart are nearly flat: their volumes are as small as roundings.
TEST(EnclosingParts, ContainTrianglesThatLieApart) {
  std::mt19937 random(6);
  int divided = 0;
  for (int i = 0; i < 200; ++i) {
    Soup soup;
    const int triangles = 1 + i % 4;
    for (int k = 0; k < triangles; ++k) {
      for (int corner = 0; corner < 3; ++corner) soup.vertices.push_back(uniformPoint(random, 1.0));
      soup.triangles.emplace_back(3 * k, 3 * k + 1, 3 * k + 2);
    }
    const TriangleMesh mesh =
        TriangleMesh::build(soup.vertices, soup.triangles).withEnclosingParts();
    if (mesh.enclosingParts() == nullptr) continue;
    ++divided;
    for (int k = 0; k < 50; ++k)
      ASSERT_TRUE(holds(*mesh.enclosingParts(), 0, pointOfTriangle(mesh, random))) << i;
  }
  EXPECT_GT(divided, 120);
}

TEST(EnclosingParts, BoxesContainTheHulls) {
  std::mt19937 random(4);
  for (const TriangleMesh& mesh : samples(random)) {
    for (const EnclosingParts::Node& node : mesh.enclosingParts()->nodes) {
      ASSERT_EQ(static_cast<std::size_t>(node.boxes.count), node.parts.size());
      for (std::size_t i = 0; i < node.parts.size(); ++i) {
        const detail::OrientedBox box = node.boxes.box(static_cast<int>(i));
        const double slack = 1e-12 * mesh.hull().extent();
        for (const Vector3d& vertex : node.parts[i].hull.vertices())
          for (std::size_t j = 0; j < 3; ++j) {
            const Vector3d axis(box.axes[j][0], box.axes[j][1], box.axes[j][2]);
            ASSERT_LE(std::abs(axis.dot(vertex - box.center)),
                      static_cast<double>(box.half[j]) * (1.0 + 1e-6) + slack);
          }
      }
    }
  }
}

TEST(EnclosingParts, AreNotMadeForWhatIsNearlyConvex) {
  const Soup box = boxSoup({-1, -1, -1}, {1, 1, 1});
  EXPECT_EQ(TriangleMesh::build(box.vertices, box.triangles).withEnclosingParts().enclosingParts(),
            nullptr);
}

TEST(EnclosingParts, AreDroppedByMoved) {
  const Soup soup = bracket();
  const TriangleMesh mesh = TriangleMesh::build(soup.vertices, soup.triangles).withEnclosingParts();
  ASSERT_NE(mesh.enclosingParts(), nullptr);
  EXPECT_EQ(mesh.moved(soup.vertices).enclosingParts(), nullptr);
}

TEST(EnclosingParts, AreTheSameEachTime) {
  const Soup soup = torusSoup(24, 12, 1.0, 0.25);
  const TriangleMesh mesh = TriangleMesh::build(soup.vertices, soup.triangles);
  const EnclosingParts first = detail::enclosingParts(mesh), second = detail::enclosingParts(mesh);
  ASSERT_EQ(first.nodes.size(), second.nodes.size());
  for (std::size_t i = 0; i < first.nodes.size(); ++i) {
    ASSERT_EQ(first.nodes[i].parts.size(), second.nodes[i].parts.size());
    for (std::size_t k = 0; k < first.nodes[i].parts.size(); ++k)
      EXPECT_EQ(first.nodes[i].parts[k].hull.vertices(), second.nodes[i].parts[k].hull.vertices());
  }
}

/// Bodies that interlock beside each other, at all paces: what separate() says with parts must hold
/// where it is sampled, contacts must be those that it finds without parts, and it must prove
/// nearly all that it proves without, at fewer steps.
TEST(EnclosingParts, ProofsSurviveSampling) {
  std::mt19937 random(5);
  const std::vector<TriangleMesh> meshes = [&] {
    std::vector<TriangleMesh> all;
    for (const Soup& soup :
         {bracket(), torusSoup(24, 12, 0.6, 0.15), blobSoup(random, 7, 10), curl()})
      all.push_back(TriangleMesh::build(soup.vertices, soup.triangles));
    return all;
  }();
  std::vector<TriangleMesh> withParts;
  for (const TriangleMesh& mesh : meshes) withParts.push_back(mesh.withEnclosingParts());
  int separated = 0, only = 0, lost = 0, contacts = 0, inHulls = 0, flat = 0;
  for (int i = 0; i < 6000; ++i) {
    const std::size_t a = static_cast<std::size_t>(i) % meshes.size();
    const std::size_t b = static_cast<std::size_t>(i) / meshes.size() % (meshes.size() + 2);
    const Shape others[2] = {Box{{0.3, 0.1, 0.05}}, HalfSpace{Vector3d::UnitZ(), 0.0}};
    const bool isMesh = b < meshes.size();
    const Shape plainB = isMesh ? Shape(meshes[b]) : others[b - meshes.size()];
    const Shape partsB = isMesh ? Shape(withParts[b]) : plainB;
    const double pace = std::pow(10.0, uniform(random, -3.0, -0.5));
    const Screwing moveA{randomPose(random, 0.2), pace * uniformPoint(random, 0.2),
                         pace * uniformPoint(random, 0.5)};
    const Screwing moveB{randomPose(random, 0.9), pace * uniformPoint(random, 0.2),
                         pace * uniformPoint(random, 0.2)};
    const bool bounded = b != meshes.size() + 1;
    const Isometry3d a_from_b = moveA.middle.inverse() * moveB.middle;
    SeparationQuery query;
    query.approach = bounded ? approachOf(meshes[a], moveA, plainB, moveB)
                             : approachOf(meshes[a], moveA, Sphere{1.0}, moveB);
    if (!bounded) query.approach.spinB.setZero();
    query.thorough = i % 3 != 0;
    const SeparationResult plain = separate(meshes[a], plainB, a_from_b, query);
    const SeparationResult found = separate(withParts[a], partsB, a_from_b, query);
    ASSERT_EQ(found.status == Separation::Contact, plain.status == Separation::Contact) << i;
    contacts += found.status == Separation::Contact;
    only += found.status == Separation::Separated && plain.status != Separation::Separated;
    lost += found.status != Separation::Separated && plain.status == Separation::Separated;
    if (found.status != Separation::Separated) continue;
    ++separated;
    flat += !bounded;
    if (bounded && isMesh)
      inHulls += !(distance(meshes[a].hull(), meshes[b].hull(), a_from_b).lower > 0.0);
    if (!bounded) continue;
    for (int k = -8; k <= 8; ++k) {
      const double s = k / 8.0;
      ASSERT_GT(distance(meshes[a], plainB, moveA.at(s).inverse() * moveB.at(s)).lower, 0.0)
          << "case " << i << " at s = " << s;
    }
  }
  EXPECT_GT(separated, 1500);
  EXPECT_GT(contacts, 1500);
  EXPECT_GT(inHulls, 100) << "too few proofs that hulls cannot give";
  EXPECT_GT(flat, 50);
  EXPECT_LE(lost, separated / 100);
  RecordProperty("proven with parts only", only);
}

}  // namespace
