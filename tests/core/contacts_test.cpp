// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/contacts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "mesh_samples.hpp"
#include "reference_distance.hpp"
#include "swept/core/triangle_pair.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::Soup;

constexpr std::size_t kAll = 1u << 20;

TriangleMesh surfaceOf(const Soup& soup) {
  return TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Surface);
}

TriangleCorners corners(const TriangleMesh& mesh, int i, const Isometry3d& pose) {
  const Eigen::Vector3i& t = mesh.triangles()[i];
  return {pose * mesh.vertices()[t[0]], pose * mesh.vertices()[t[1]], pose * mesh.vertices()[t[2]]};
}

std::set<std::pair<int, int>> pairsOf(const std::vector<ContactPoint>& contacts) {
  std::set<std::pair<int, int>> pairs;
  for (const ContactPoint& c : contacts) pairs.emplace(c.pieceA, c.pieceB);
  EXPECT_EQ(pairs.size(), contacts.size()) << "a pair is listed twice";
  return pairs;
}

TEST(Contacts, OfMeshesAreThoseOfAllTrianglePairs) {
  std::mt19937 random(3);
  int touching = 0;
  constexpr int kRounds = 60;
  for (int round = 0; round < kRounds; ++round) {
    const TriangleMesh a = surfaceOf(test::blobSoup(random, 8, 10));
    const TriangleMesh b = surfaceOf(test::torusSoup(10, 6, 1.0, 0.3));
    const Isometry3d pose = test::randomPose(random, 2.2);
    std::set<std::pair<int, int>> expected;
    for (int i = 0; i < static_cast<int>(a.triangles().size()); ++i) {
      for (int j = 0; j < static_cast<int>(b.triangles().size()); ++j) {
        if (trianglesTouch(corners(a, i, Isometry3d::Identity()), corners(b, j, pose)))
          expected.emplace(i, j);
      }
    }
    std::vector<ContactPoint> contacts;
    const ContactsResult result = findContacts(a, b, pose, kAll, contacts);
    EXPECT_EQ(pairsOf(contacts), expected);
    EXPECT_TRUE(result.complete);
    EXPECT_EQ(result.status, expected.empty() ? Contact::Separate : Contact::Touching);
    EXPECT_LT(result.effort,
              0.5 * static_cast<double>(a.triangles().size() * b.triangles().size()));
    touching += expected.empty() ? 0 : 1;
    for (const ContactPoint& c : contacts) {
      EXPECT_NEAR(c.normal.norm(), 1.0, 1e-9);
      TriangleCorners moved = corners(b, c.pieceB, pose);
      for (Vector3d& corner : moved) corner += (c.depth + 1e-9) * c.normal;
      EXPECT_FALSE(trianglesTouch(corners(a, c.pieceA, Isometry3d::Identity()), moved));
    }
  }
  EXPECT_GT(touching, kRounds * 3 / 10);
  EXPECT_LT(touching, kRounds * 9 / 10);
}

TEST(Contacts, OfAMeshAndASphereAreTheTrianglesWithinItsRadius) {
  std::mt19937 random(4);
  for (const bool meshFirst : {true, false}) {
    int within = 0;
    for (int round = 0; round < 60; ++round) {
      const TriangleMesh mesh = surfaceOf(test::blobSoup(random, 8, 10));
      const Sphere sphere = makeSphere(test::uniform(random, 0.05, 0.6));
      Isometry3d mesh_from_sphere = test::randomPose(random, 0.9);
      std::set<int> expected;
      for (int i = 0; i < static_cast<int>(mesh.triangles().size()); ++i) {
        const double d = reference::pointTriangle(mesh_from_sphere.translation(),
                                                  corners(mesh, i, Isometry3d::Identity()));
        ASSERT_GT(std::abs(d - sphere.radius), 1e-9) << "too close to call, pick another seed";
        if (d < sphere.radius) expected.insert(i);
      }
      std::vector<ContactPoint> contacts;
      if (meshFirst) {
        findContacts(mesh, sphere, mesh_from_sphere, kAll, contacts);
      } else {
        findContacts(sphere, mesh, mesh_from_sphere.inverse(), kAll, contacts);
      }
      std::set<int> found;
      for (const ContactPoint& c : contacts) {
        const int piece = meshFirst ? c.pieceA : c.pieceB;
        EXPECT_EQ(meshFirst ? c.pieceB : c.pieceA, -1);
        found.insert(piece);
        const double d = reference::pointTriangle(mesh_from_sphere.translation(),
                                                  corners(mesh, piece, Isometry3d::Identity()));
        EXPECT_NEAR(c.depth, sphere.radius - d, 1e-8);
        EXPECT_NEAR((c.pointB - c.pointA).norm(), c.depth, 1e-8);
      }
      EXPECT_EQ(found, expected);
      within += expected.empty() ? 0 : 1;
    }
    EXPECT_GT(within, 18);
    EXPECT_LT(within, 55);
  }
}

TEST(Contacts, AreNoMoreThanAskedFor) {
  std::mt19937 random(5);
  const TriangleMesh mesh = surfaceOf(test::blobSoup(random, 8, 10));
  const Isometry3d pose(Eigen::Translation3d(0.4, 0.1, 0.0));
  std::vector<ContactPoint> all;
  findContacts(mesh, mesh, pose, kAll, all);
  ASSERT_GT(all.size(), 10u);
  std::vector<ContactPoint> few{ContactPoint{}};
  const ContactsResult result = findContacts(mesh, mesh, pose, 4, few);
  EXPECT_EQ(few.size(), 5u) << "appended";
  EXPECT_EQ(result.status, Contact::Touching);
  EXPECT_FALSE(result.complete);
  std::vector<ContactPoint> exactly;
  EXPECT_TRUE(findContacts(mesh, mesh, pose, all.size(), exactly).complete);
  std::vector<ContactPoint> none;
  const ContactsResult yesNo = findContacts(mesh, mesh, pose, 0, none);
  EXPECT_EQ(yesNo.status, Contact::Touching);
  EXPECT_TRUE(none.empty());
}

TEST(Contacts, OfConvexShapesIsOneWithTheTrueDepth) {
  const Isometry3d pose(Eigen::Translation3d(0.0, 0.0, 0.9));
  std::vector<ContactPoint> contacts;
  const ContactsResult result =
      findContacts(makeBox({1, 1, 1}), makeBox({1, 1, 1}), pose, kAll, contacts);
  EXPECT_EQ(result.status, Contact::Touching);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_NEAR(contacts[0].depth, 0.1, 1e-12);
  EXPECT_NEAR((contacts[0].normal - Vector3d::UnitZ()).norm(), 0.0, 1e-12);
  EXPECT_NEAR(contacts[0].pointA.z(), 0.5, 1e-12);
  EXPECT_NEAR(contacts[0].pointB.z(), 0.4, 1e-12);
  EXPECT_EQ(contacts[0].pieceA, -1);
}

TEST(Contacts, OfAnEnclosedBodyIsOneWithoutPieces) {
  const Soup soup = test::boxSoup({-1, -1, -1}, {1, 1, 1});
  const Shape solid = TriangleMesh::build(soup.vertices, soup.triangles);
  const Shape surface = surfaceOf(soup);
  const Shape ball = makeSphere(0.1);
  std::vector<ContactPoint> contacts;
  EXPECT_EQ(findContacts(solid, ball, Isometry3d::Identity(), kAll, contacts).status,
            Contact::Touching);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].pieceA, -1);
  EXPECT_GT(contacts[0].depth, 1.0);
  contacts.clear();
  EXPECT_EQ(findContacts(surface, ball, Isometry3d::Identity(), kAll, contacts).status,
            Contact::Separate);
  EXPECT_TRUE(contacts.empty());
}

TEST(Contacts, OfAMeshAndAHalfSpaceAreTheTrianglesBelow) {
  const Soup soup = test::boxSoup({-1, -1, -1}, {1, 1, 1});
  const Shape mesh = surfaceOf(soup);
  const Isometry3d pose(Eigen::Translation3d(0.0, 0.0, -0.5));
  std::vector<ContactPoint> contacts;
  const auto result =
      findContacts(mesh, makeHalfSpace(Vector3d::UnitZ(), 0.0), pose, kAll, contacts);
  EXPECT_EQ(result.status, Contact::Touching);
  EXPECT_EQ(contacts.size(), 10u);  // all but the two of the top
  for (const ContactPoint& c : contacts) EXPECT_NEAR(c.depth, 0.5, 1e-12);
}

TEST(Contacts, ANonFinitePoseIsUnknown) {
  Isometry3d pose = Isometry3d::Identity();
  pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  std::vector<ContactPoint> contacts;
  EXPECT_EQ(findContacts(makeSphere(1), makeSphere(1), pose, kAll, contacts).status,
            Contact::Unknown);
  EXPECT_TRUE(contacts.empty());
}

}  // namespace
}  // namespace swept
