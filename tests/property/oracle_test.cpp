// SPDX-License-Identifier: BSD-3-Clause
// The oracle against brute force: its overlap tests against points sampled from the shapes, its
// kinematics against positions worked out by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "data_folder.hpp"
#include "oracle/arm.hpp"
#include "oracle/oracle.hpp"
#include "oracle/scene.hpp"

namespace {

using namespace oracle;

class Random {
 public:
  double in(double a, double b) { return std::uniform_real_distribution<double>(a, b)(engine_); }
  Vector3d point(double size) { return {in(-size, size), in(-size, size), in(-size, size)}; }
  Isometry3d pose(double size) {
    Isometry3d p = Isometry3d::Identity();
    p.linear() = Eigen::Quaterniond(in(-1, 1), in(-1, 1), in(-1, 1), in(-1, 1))
                     .normalized()
                     .toRotationMatrix();
    p.translation() = point(size);
    return p;
  }
  Primitive primitive(int kind) {
    const double a = in(0.1, 0.5), b = in(0.1, 0.5), c = in(0.1, 0.5);
    if (kind == 0) return Sphere{a};
    if (kind == 1) return Box{{a, b, c}};
    if (kind == 2) return Cylinder{a, b};
    return Capsule{a, b};
  }

 private:
  std::mt19937_64 engine_{42};
};

constexpr int kGrid = 40;

/// Points spread evenly over a triangle, its border included.
template <class Use>
void overTriangle(const Triangle& t, Use use) {
  for (int i = 0; i <= kGrid; ++i)
    for (int k = 0; k <= kGrid - i; ++k)
      use(t[0] + (t[1] - t[0]) * (double(i) / kGrid) + (t[2] - t[0]) * (double(k) / kGrid));
}

double longestEdge(const Triangle& t) {
  return std::max({(t[0] - t[1]).norm(), (t[1] - t[2]).norm(), (t[2] - t[0]).norm()});
}

/// A shape as a closed mesh, a little smaller than it where it is curved.
std::vector<Triangle> surface(const Primitive& solid) {
  std::vector<Triangle> triangles;
  const int n = 24;
  auto at = [&](int i, int k) {
    const double a = M_PI * i / n, b = 2 * M_PI * k / n;
    const Vector3d far(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
    return closestPoint(solid, 2.0 * far);
  };
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      triangles.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1)});
      triangles.push_back({at(i, k), at(i + 1, k + 1), at(i, k + 1)});
    }
  return triangles;
}

TEST(Oracle, TriangleAndSolidAgreeWithSampledPoints) {
  Random random;
  for (int kind = 0; kind < 4; ++kind) {
    int hits = 0, close = 0;
    for (int i = 0; i < 1500; ++i) {
      const Primitive solid = random.primitive(kind);
      const Vector3d middle = random.point(0.5);
      const double size = i % 3 == 0 ? 1.0 : 0.4;
      const Triangle t{middle + random.point(size), middle + random.point(size),
                       middle + random.point(size)};
      double least = INFINITY;
      overTriangle(t, [&](const Vector3d& p) { least = std::min(least, distanceTo(solid, p)); });
      const bool hit = overlap(solid, t);
      hits += hit;
      close += std::abs(least) > 0 && least < 0.05;
      if (least == 0) {
        EXPECT_TRUE(hit) << "kind " << kind << " trial " << i;
      }
      if (hit) {
        EXPECT_LT(least, longestEdge(t) / kGrid) << "kind " << kind << " trial " << i;
      }
      if (!hit) {
        const Gap g = gap(solid, t, 10.0);
        EXPECT_LE(g.upper, least + 1e-9);
        EXPECT_GT(g.lower, std::max(0.0, least - longestEdge(t) / kGrid));
      }
    }
    EXPECT_GT(hits, 450);
    EXPECT_LT(hits, 1050);
    EXPECT_GT(close, 60);
  }
}

TEST(Oracle, TrianglesOverlapExactlyWhenTheirDistanceIsZero) {
  Random random;
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    Triangle s, t;
    for (int k = 0; k < 3; ++k) s[k] = random.point(0.5), t[k] = random.point(0.5);
    if (i % 4 == 0) t[0] = s[0] + 1e-3 * random.point(1);
    double least =
        INFINITY;  // of the border of each from the other: positive when they cross inside
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l <= 200; ++l) {
        const Vector3d p = s[k] + (s[(k + 1) % 3] - s[k]) * (l / 200.0);
        const Vector3d q = t[k] + (t[(k + 1) % 3] - t[k]) * (l / 200.0);
        least = std::min({least, (closestPoint(t, p) - p).norm(), (closestPoint(s, q) - q).norm()});
      }
    const bool hit = overlap(s, t);
    hits += hit;
    const double spacing = std::max(longestEdge(s), longestEdge(t)) / 200;
    if (hit) {
      EXPECT_LT(least, spacing);
    }
    const Gap g = hit ? Gap{0, 0} : gap(s, t, 10.0);
    EXPECT_LE(g.upper, least + 1e-12);
    EXPECT_GT(g.upper, least - spacing);
    if (i >= 2000) i += 9;
  }
  EXPECT_GT(hits, 500);
}

TEST(Oracle, SolidPairsAgreeWithTheirSurfaces) {
  Random random;
  for (int a = 0; a < 4; ++a)
    for (int b = a; b < 4; ++b) {
      int hits = 0;
      for (int i = 0; i < 150; ++i) {
        const Primitive p = random.primitive(a), q = random.primitive(b);
        const Isometry3d p_from_q = random.pose(0.6);
        // A mesh inside q: where it meets p, so does q; else it is farther by its facets' depth.
        bool meshHit = distanceTo(p, p_from_q.translation()) == 0;
        double meshGap = INFINITY;
        for (const Triangle& t : surface(q)) {
          const Triangle moved = oracle::moved(p_from_q, t);
          meshHit = meshHit || overlap(p, moved);
          meshGap = std::min(meshGap, gap(p, moved, 10.0).upper);
        }
        const bool hit = overlap(p, q, p_from_q);
        hits += hit;
        EXPECT_EQ(hit, overlap(q, p, p_from_q.inverse()));
        if (meshHit) {
          EXPECT_TRUE(hit) << a << ' ' << b << " trial " << i;
        } else if (hit) {
          EXPECT_LT(meshGap, 0.1);
        } else {
          const Gap g = gap(p, q, p_from_q);
          EXPECT_LT(g.upper - g.lower, 1e-6);
          EXPECT_LE(g.lower, meshGap + 1e-9);
          EXPECT_GT(g.upper, std::max(0.0, meshGap - 0.1));
        }
      }
      EXPECT_GT(hits, 30) << a << ' ' << b;
      EXPECT_LT(hits, 135) << a << ' ' << b;
    }
}

std::vector<Vector3d> cubeCorners(double half) {
  std::vector<Vector3d> v;
  for (int i = 0; i < 8; ++i)
    v.emplace_back(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half);
  return v;
}

const std::vector<std::array<int, 3>> kCubeFaces{{0, 1, 3}, {0, 3, 2}, {4, 5, 7}, {4, 7, 6},
                                                 {0, 1, 5}, {0, 5, 4}, {2, 3, 7}, {2, 7, 6},
                                                 {0, 2, 6}, {0, 6, 4}, {1, 3, 7}, {1, 7, 5}};

std::shared_ptr<const Mesh> cube(double half) {
  return std::make_shared<Mesh>(cubeCorners(half), kCubeFaces);
}

TEST(Oracle, MeshOfABoxBehavesAsTheBox) {
  Random random;
  const Piece mesh(cube(0.3)), box(Box{{0.3, 0.3, 0.3}});
  int hits = 0, enclosed = 0;
  for (int i = 0; i < 3000; ++i) {
    const Isometry3d pose = random.pose(0.7);
    const Piece other =
        i % 5 == 4 ? Piece(cube(i % 2 ? 0.05 : 0.4)) : Piece(random.primitive(i % 4));
    const bool hit = overlap(box, other, pose);
    hits += hit;
    EXPECT_EQ(hit, overlap(mesh, other, pose)) << i;
    EXPECT_EQ(hit, overlap(other, mesh, pose.inverse())) << i;
    const Gap a = gap(mesh, other, pose, 1.0), b = gap(box, other, pose, 1.0);
    EXPECT_LE(a.lower, b.upper + 1e-9);
    EXPECT_LE(b.lower, a.upper + 1e-9);
    const Vector3d p = random.point(0.5);
    const bool inside = (p.cwiseAbs().array() < 0.3).all();
    enclosed += inside;
    EXPECT_EQ(mesh.mesh->encloses(p), inside);
    EXPECT_NEAR(distanceTo(mesh, p), distanceTo(box, p), 1e-12);
  }
  EXPECT_GT(hits, 900);
  EXPECT_LT(hits, 2400);
  EXPECT_GT(enclosed, 300);
}

/// What is read from a file has corners in single precision.
TEST(Oracle, ShallowOverlapsOfMeshesOfFilesAreNotSure) {
  const auto file = std::filesystem::path(testing::TempDir()) / "oracle_cube.obj";
  {
    std::ofstream out(file);
    for (const Vector3d& p : cubeCorners(0.3))
      out << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    for (const auto& f : kCubeFaces)
      out << "f " << f[0] + 1 << ' ' << f[1] + 1 << ' ' << f[2] + 1 << '\n';
  }
  const Piece mesh(std::make_shared<Mesh>(Mesh::read(file, Vector3d::Ones())));
  const double off = mesh.mesh->rounding();
  EXPECT_GT(off, 1e-8);
  EXPECT_LT(off, 1e-6);
  const Piece ball(Sphere{0.1}), sharp(cube(0.1));
  for (int axis = 0; axis < 3; ++axis)
    for (const Piece* other : {&ball, &sharp}) {
      const auto at = [&](double depth) {
        return Isometry3d(Eigen::Translation3d((0.4 - depth) * Vector3d::Unit(axis)));
      };
      EXPECT_FALSE(overlap(mesh, *other, at(-2.0 * off)));
      EXPECT_TRUE(overlap(mesh, *other, at(off)));
      EXPECT_FALSE(surelyOverlap(mesh, *other, at(off)));
      EXPECT_FALSE(surelyOverlap(*other, mesh, at(off).inverse()));
      EXPECT_TRUE(surelyOverlap(mesh, *other, at(3.0 * off)));
    }
}

TEST(Oracle, CracksAndFoldsLeaveASolid) {
  constexpr double kHalf = 0.3, kCrack = 1e-7;
  Random random;
  const std::vector<Vector3d> corners = cubeCorners(kHalf);
  std::vector<Vector3d> own;
  std::vector<std::array<int, 3>> faces;
  for (const auto& face : kCubeFaces) {
    const int first = static_cast<int>(own.size());
    for (const int corner : face) own.push_back(corners[corner] + random.point(0.5 * kCrack));
    faces.push_back({first, first + 1, first + 2});
  }
  EXPECT_EQ(Mesh(own, faces).closedParts(), 0);
  const Mesh cracked(own, faces, kCrack);
  ASSERT_EQ(cracked.closedParts(), 1);
  faces.pop_back();
  EXPECT_EQ(Mesh(own, faces, kCrack).closedParts(), 0);

  // A corner more on an edge of one face, at its place and off it.
  for (const double off : {0.0, 0.5 * kCrack}) {
    std::vector<Vector3d> divided = corners;
    divided.push_back(0.5 * (corners[kCubeFaces[0][0]] + corners[kCubeFaces[0][1]]) +
                      Vector3d::Constant(off));
    faces = kCubeFaces;
    const auto [a, b, c] = faces.front();
    faces.front() = {a, 8, c};
    faces.push_back({8, b, c});
    EXPECT_EQ(Mesh(divided, faces).closedParts(), 0);
    EXPECT_EQ(Mesh(divided, faces, kCrack).closedParts(), 1);
    faces.pop_back();
    EXPECT_EQ(Mesh(divided, faces, kCrack).closedParts(), 0);
  }

  // A fin on the edge from 0 to 1, by itself, and out and back.
  std::vector<Vector3d> folded = corners;
  folded.push_back(2 * corners[0]);
  faces = kCubeFaces;
  faces.push_back({0, 1, 8});
  EXPECT_EQ(Mesh(folded, faces).closedParts(), 1);
  faces.push_back({1, 0, 8});
  const Mesh fin(folded, faces);
  ASSERT_EQ(fin.closedParts(), 1);
  // A sheet written twice is one all the same.
  EXPECT_EQ(Mesh(corners, {{0, 1, 2}, {2, 1, 0}}).closedParts(), 0);

  int enclosed = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d p = random.point(0.5);
    const bool inside = (p.cwiseAbs().array() < kHalf).all();
    enclosed += inside;
    EXPECT_EQ(cracked.encloses(p), inside) << i;
    EXPECT_EQ(fin.encloses(p), inside) << i;
  }
  EXPECT_GT(enclosed, 300);
}

/// Two cubes, the second 0.2 m further along x, as one closed part: a passage joins a
/// triangle of the first one's far side to one of the second one's near side, inside both.
Mesh joinedCubes(double half, bool consistent) {
  const std::vector<std::array<int, 3>> sides{{1, 3, 7}, {0, 6, 2}, {1, 7, 5}, {0, 4, 6},
                                              {2, 6, 7}, {2, 7, 3}, {0, 1, 5}, {0, 5, 4},
                                              {4, 5, 7}, {4, 7, 6}, {0, 3, 1}, {0, 2, 3}};
  std::vector<Vector3d> v;
  std::vector<std::array<int, 3>> faces{{1, 3, 10},  {1, 10, 8}, {3, 7, 14},
                                        {3, 14, 10}, {7, 1, 8},  {7, 8, 14}};
  for (int k = 0; k < 2; ++k) {
    for (int i = 0; i < 8; ++i)
      v.push_back(Vector3d(i & 1 ? half : -half, i & 2 ? half : -half, i & 4 ? half : -half) +
                  k * Vector3d(0.2, 0, 0));
    for (int i = 0; i < 12; ++i)
      if (i != k) faces.push_back({sides[i][0] + 8 * k, sides[i][1] + 8 * k, sides[i][2] + 8 * k});
  }
  if (!consistent) std::swap(faces.back()[0], faces.back()[1]);
  return Mesh(v, faces);
}

TEST(Oracle, PiecesOfOnePartMayOverlap) {
  Random random;
  const Mesh joined = joinedCubes(0.3, true), flipped = joinedCubes(0.3, false);
  ASSERT_EQ(joined.closedParts(), 1);
  ASSERT_EQ(flipped.closedParts(), 1);
  int both = 0, holes = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector3d p = random.point(0.6);
    const bool first = (p.cwiseAbs().array() < 0.3).all();
    const bool second = ((p - Vector3d(0.2, 0, 0)).cwiseAbs().array() < 0.3).all();
    both += first && second;
    EXPECT_EQ(joined.encloses(p), first || second) << i;
    // One triangle the other way round leaves parity, for which twice inside is outside.
    if (first != second) {
      EXPECT_TRUE(flipped.encloses(p)) << i;
    }
    holes += first && second && !flipped.encloses(p);
  }
  EXPECT_GT(both, 60);
  EXPECT_GT(holes, 30);
}

const char* const kUrdf = R"(<robot name="r">
  <link name="base"/><link name="a"/><link name="b"><collision><geometry><sphere radius="0.1"/>
  </geometry></collision></link><link name="c"/>
  <joint name="lift" type="prismatic"><parent link="base"/><child link="a"/><axis xyz="0 0 2"/>
    <limit lower="0" upper="1"/></joint>
  <joint name="turn" type="continuous"><parent link="a"/><child link="b"/>
    <origin xyz="1 0 0" rpy="0 0 1.5707963267948966"/><axis xyz="0 0 1"/></joint>
  <joint name="follow" type="revolute"><parent link="b"/><child link="c"/><origin xyz="1 0 0"/>
    <axis xyz="0 0 1"/><limit lower="-9" upper="9"/><mimic joint="turn" multiplier="-2" offset="0.5"/>
  </joint></robot>)";

TEST(Oracle, KinematicsByHand) {
  const auto file = std::filesystem::path(testing::TempDir()) / "oracle_test.urdf";
  std::ofstream(file) << kUrdf;
  const Arm arm(file, {});
  ASSERT_EQ(arm.variables().size(), 2u);
  std::vector<Isometry3d> poses;
  arm.poses({0.25, M_PI / 2}, poses);
  EXPECT_NEAR((poses[arm.link("b")].translation() - Vector3d(1, 0, 0.25)).norm(), 0, 1e-15);
  // b is turned by half a turn, so c hangs at -x of it; c itself is turned by pi - pi + 0.5.
  EXPECT_NEAR((poses[arm.link("c")].translation() - Vector3d(0, 0, 0.25)).norm(), 0, 1e-15);
  EXPECT_NEAR(poses[arm.link("c")].linear()(0, 0), std::cos(0.5), 1e-15);
  EXPECT_NEAR(arm.between({0, 3.0}, {1, -3.0}, 0.5)[1], M_PI, 1e-15);
  EXPECT_NEAR(arm.largestChange({0, 3.0}, {0, -3.0}), 2 * (2 * M_PI - 6), 1e-14);
}

TEST(Oracle, KnowsThePublishedPandaStartsAreFree) {
  const auto data = dataFolder();
  if (!data) GTEST_SKIP() << "skipped: SWEPT_DATA is not set";
  const std::filesystem::path& root = *data;
  const Arm arm(root / "robots/panda/panda.urdf", root / "robots/panda/panda.srdf");
  int free = 0, total = 0;
  for (const int index : {1, 20, 40, 60, 80}) {
    const Problem p = readProblem(root / "mbm/panda.json", "bookshelf_small", index);
    const Oracle judge(arm, p.world, "panda_arm");
    for (const auto& values : {p.start, p.goal}) {
      std::vector<double> q = arm.home();
      for (size_t i = 0; i < arm.variables().size(); ++i)
        for (size_t k = 0; k < p.joints.size(); ++k)
          if (arm.variables()[i].name == p.joints[k]) q[i] = values[k];
      free += !judge.hit(q);
      ++total;
    }
  }
  EXPECT_EQ(free, total);
}

}  // namespace
