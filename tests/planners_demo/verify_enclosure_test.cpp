// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "swept/core/triangle_mesh.hpp"
#include "verify/enclosed.hpp"
#include "verify/inside.hpp"
#include "verify/intervals.hpp"
#include "verify/proof.hpp"

/// What the checker of proofs takes for inside of a closed mesh, against the library.
namespace swept::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

/// A cube with a cubic cavity, 2 and 1 m; the cavity's triangles may be turned either way round.
verify::Surface hollow(bool turned) {
  verify::Surface surface;
  for (const double half : {1.0, 0.5}) {
    const int first = static_cast<int>(surface.vertices.size());
    for (int corner = 0; corner < 8; ++corner)
      surface.vertices.emplace_back((corner & 1) != 0 ? half : -half,
                                    (corner & 2) != 0 ? half : -half,
                                    (corner & 4) != 0 ? half : -half);
    constexpr int kFaces[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                   {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                   {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    for (const auto& face : kFaces) {
      std::array<int, 3> triangle{first + face[0], first + face[1], first + face[2]};
      if (half < 1.0 && turned) std::swap(triangle[1], triangle[2]);
      surface.triangles.push_back(triangle);
    }
  }
  return surface;
}

/// Boxes of two opposite corners each; corners at the same place are one vertex.
verify::Surface boxes(const std::vector<std::pair<Vector3d, Vector3d>>& corners) {
  verify::Surface surface;
  const auto vertexAt = [&](const Vector3d& place) {
    const auto found = std::ranges::find(surface.vertices, place);
    if (found == surface.vertices.end()) surface.vertices.push_back(place);
    return static_cast<int>(std::ranges::find(surface.vertices, place) - surface.vertices.begin());
  };
  for (const auto& [low, high] : corners) {
    const verify::Surface unit = hollow(false);
    for (std::size_t i = 0; i < 12; ++i) {
      std::array<int, 3> triangle{};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto vertex = static_cast<std::size_t>(unit.triangles[i][k]);
        const Vector3d share = 0.5 * (unit.vertices[vertex] + Vector3d::Ones());
        triangle[k] = vertexAt(low + share.cwiseProduct(high - low));
      }
      surface.triangles.push_back(triangle);
    }
  }
  return surface;
}

/// `inside`: how many of 2000 points of a cube of 2.6 m at the origin may be in it, to prove that
/// the points see both sides.
void expectAgreement(const verify::Surface& surface, std::pair<int, int> expected) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1.3, 1.3);
  std::vector<Eigen::Vector3i> triangles;
  for (const auto& t : surface.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  const TriangleMesh mesh = TriangleMesh::build(surface.vertices, triangles);
  const verify::Enclosure enclosure(surface);
  int inside = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d point(uniform(random), uniform(random), uniform(random));
    const bool truth = mesh.encloses(point);
    inside += truth ? 1 : 0;
    EXPECT_EQ(enclosure.sideOf(point), truth ? verify::Side::Inside : verify::Side::Outside)
        << point.transpose();
  }
  EXPECT_GE(inside, expected.first);
  EXPECT_LE(inside, expected.second);
}

TEST(VerifyEnclosure, AgreesWithTheLibrary) {
  for (const bool turned : {false, true}) {
    const verify::Surface surface = hollow(turned);
    expectAgreement(surface, {600, 1400});
    const verify::Enclosure enclosure(surface);
    EXPECT_EQ(enclosure.sideOf({0.9, 0.0, 0.0}), verify::Side::Inside);
  }
  verify::Surface open = hollow(false);
  open.triangles.erase(open.triangles.begin());
  EXPECT_EQ(verify::Enclosure(open).sideOf({0.9, 0.0, 0.0}), verify::Side::Outside)
      << "the outer cube is open, and the point outside the inner one";
}

TEST(VerifyEnclosure, AgreesWhereShellsAreJoined) {
  const Vector3d one = Vector3d::Ones();
  // At an edge: one component, whose overlap has winding number 2 and parity 0. 910 = 2000 * 8
  // / 2.6^3.
  expectAgreement(boxes({{-one, one}, {{0.0, 0.0, -1.0}, one}}), {800, 1000});
  // At a vertex: two, one of them not oriented.
  verify::Surface vertex = boxes({{-one, one}, {-0.5 * one, one}});
  std::swap(vertex.triangles.back()[0], vertex.triangles.back()[1]);
  expectAgreement(vertex, {800, 1000});
  // A flap at a vertex of a box does not open it.
  verify::Surface flap = boxes({{-one, one}});
  const int next = static_cast<int>(flap.vertices.size());
  flap.vertices.emplace_back(1.2, 1.1, 1.0);
  flap.vertices.emplace_back(1.1, 1.2, 1.0);
  flap.triangles.push_back({next - 1, next, next + 1});
  expectAgreement(flap, {800, 1000});
}

/// What a model has of a mesh that the library read.
verify::Surface asWritten(const verify::Surface& given, double crackWidth) {
  std::vector<Eigen::Vector3i> triangles;
  for (const auto& t : given.triangles) triangles.emplace_back(t[0], t[1], t[2]);
  const TriangleMesh mesh =
      TriangleMesh::build(given.vertices, triangles, MeshInterior::Solid, crackWidth);
  verify::Surface written{mesh.vertices(), {}};
  for (const Eigen::Vector3i& t : mesh.triangles()) written.triangles.push_back({t[0], t[1], t[2]});
  return written;
}

TEST(VerifyEnclosure, AgreesWhereTheLibraryFoundSolids) {
  const verify::Surface box = boxes({{-Vector3d::Ones(), Vector3d::Ones()}});
  const int next = static_cast<int>(box.vertices.size());
  // A flap along an edge, of two triangles.
  verify::Surface flap = box;
  flap.vertices.emplace_back(1.2, 1.1, 1.0);
  flap.vertices.emplace_back(1.1, 1.2, 1.2);
  flap.triangles.push_back({flap.triangles[0][0], flap.triangles[0][1], next});
  flap.triangles.push_back({flap.triangles[0][1], next, next + 1});
  expectAgreement(flap, {800, 1000});
  expectAgreement(asWritten(flap, 0.0), {800, 1000});
  // A corner on an edge, exactly and not.
  for (const double off : {0.0, 1e-6}) {
    verify::Surface divided = box;
    const std::array<int, 3> whole = divided.triangles.front();
    const Vector3d middle = 0.5 * (box.vertices[whole[0]] + box.vertices[whole[1]]);
    divided.vertices.emplace_back(middle + Vector3d::Constant(off));
    divided.triangles.front() = {whole[0], next, whole[2]};
    divided.triangles.push_back({next, whole[1], whole[2]});
    EXPECT_EQ(verify::Enclosure(divided).sideOf({0.1, 0.2, 0.3}), verify::Side::Outside);
    expectAgreement(asWritten(divided, 1e-5), {800, 1000});
  }
  // A wall between two halves, written once, along the diagonals of two sides.
  verify::Surface halves = box;
  for (const auto& [a, b, c] : {std::array{1, 2, 6}, std::array{1, 6, 5}}) {
    const auto at = [&](int corner) {
      const Vector3d place((corner & 1) != 0 ? 1.0 : -1.0, (corner & 2) != 0 ? 1.0 : -1.0,
                           (corner & 4) != 0 ? 1.0 : -1.0);
      return static_cast<int>(std::ranges::find(halves.vertices, place) - halves.vertices.begin());
    };
    halves.triangles.push_back({at(a), at(b), at(c)});
  }
  expectAgreement(asWritten(halves, 0.0), {800, 1000});
}

/// Planes between a ball and each triangle of a box around it hold; that it is inside does not.
TEST(VerifyEnclosure, WhatIsInsideIsRefused) {
  const verify::Surface cavity = hollow(false);
  verify::Surface cube;
  cube.vertices.assign(cavity.vertices.begin(), cavity.vertices.begin() + 8);
  cube.triangles.assign(cavity.triangles.begin(), cavity.triangles.begin() + 12);
  std::vector<verify::Element> faces;
  for (const auto& t : cube.triangles)
    faces.push_back({.points = {cube.vertices[t[0]], cube.vertices[t[1]], cube.vertices[t[2]]}});
  verify::Model model;
  model.links = {"link"};
  model.jointOf = {-1};
  model.bodies.emplace_back(
      "ball", std::vector<verify::Element>{{.points = {Vector3d::Zero()}, .radius = 0.1}},
      std::vector<verify::Flat>{}, std::vector<verify::Surface>{});
  model.linkOf = {0, -1};
  model.paddings = {0.0, 0.0};
  for (const bool solid : {true, false}) {
    model.bodies.resize(1, model.bodies.front());
    model.bodies.emplace_back(
        "box", faces, std::vector<verify::Flat>{},
        solid ? std::vector<verify::Surface>{cube} : std::vector<verify::Surface>{});
    const verify::Motion motion(model, std::vector<double>{}, std::vector<double>{});
    const verify::PairMotion between(model, motion, {0, 1}, 0.0, 1.0);
    const verify::Body& box = model.bodies[1];
    const auto tree = [&](const auto& self, int node) -> Json {
      const verify::Body::Node& own = box.nodes()[node];
      if (own.left >= 0) return {{"b", Json::array({self(self, own.left), self(self, own.right)})}};
      Vector3d middle = Vector3d::Zero();
      for (const Vector3d& point : box.elements()[own.first].points) middle += point / 3.0;
      Eigen::Index axis = 0;
      middle.cwiseAbs().maxCoeff(&axis);
      Vector3d way = Vector3d::Zero();
      way[axis] = middle[axis];
      return {way.x(), way.y(), way.z(), 0.89};
    };
    const Json proof = {{"intervals", Json::array({Json::array({0.0, 1.0, tree(tree, 0)})})}};
    EXPECT_EQ(checkPair(model, motion, {0, 1}, proof, "here").planes, 12u);
    try {
      requireNotEnclosed(model, motion, {0, 1}, proof, "here");
      EXPECT_FALSE(solid);
    } catch (const verify::Refusal& refusal) {
      EXPECT_TRUE(solid);
      EXPECT_STREQ(refusal.what(), "here: at the beginning, ball is inside box");
    }
  }
}

TEST(VerifyEnclosure, OfABodyInPartsNoneIsInside) {
  verify::Model model;
  model.links = {"link"};
  model.jointOf = {-1};
  model.linkOf = {0, -1};
  model.paddings = {0.0, 0.0};
  const verify::Surface cube = boxes({{-Vector3d::Ones(), Vector3d::Ones()}});
  const auto isRefused = [&](double x, double y) {
    model.bodies.clear();
    model.bodies.emplace_back("balls",
                              std::vector<verify::Element>{{.points = {{x, 0, 0}}, .radius = 0.1},
                                                           {.points = {{y, 0, 0}}, .radius = 0.1}},
                              std::vector<verify::Flat>{}, std::vector<verify::Surface>{});
    model.bodies.emplace_back("box", std::vector<verify::Element>{{.points = cube.vertices}},
                              std::vector<verify::Flat>{}, std::vector<verify::Surface>{cube});
    const Json divided = {{"a", Json::array()}};
    const Json proof = {{"intervals", Json::array({Json::array({0.0, 1.0, divided})})}};
    try {
      requireNotEnclosed(model, verify::Motion(model, std::vector<double>{}, std::vector<double>{}),
                         {0, 1}, proof, "here");
    } catch (const verify::Refusal&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(isRefused(-3.0, 3.0));
  EXPECT_TRUE(isRefused(-3.0, 0.0));
  EXPECT_TRUE(isRefused(0.0, 3.0));
}

}  // namespace
}  // namespace swept::test
