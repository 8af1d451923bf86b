// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "continuous/deforming_data.hpp"
#include "continuous/deforming_refit.hpp"
#include "deforming_samples.hpp"
#include "heap_counter.hpp"

/// A step followed by several threads: bit for bit what one makes of it, and that is right.
namespace swept {
namespace {

using detail::DeformingFrame;
using Eigen::Vector3d;
using test::SoupMotion;
using Points = std::vector<Vector3d>;

constexpr unsigned kThreads[] = {1, 2, 3, 7};

template <typename T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool sameFrame(const DeformingFrame& a, const DeformingFrame& b) {
  bool same =
      a.reach == b.reach && sameBits(a.vertices, b.vertices) && sameBits(a.corners, b.corners);
  for (std::size_t l = 0; l < a.boxes.size(); ++l) same = same && sameBits(a.boxes[l], b.boxes[l]);
  return same;
}

/// Whatever a query looks at.
bool sameMesh(const DeformingMesh& a, const DeformingMesh& b) {
  const DeformingMesh::Data& p = a.data();
  const DeformingMesh::Data& q = b.data();
  return p.order.triangleOf == q.order.triangleOf && p.order.vertexOf == q.order.vertexOf &&
         p.still == q.still && (p.still || sameFrame(p.start, q.start)) &&
         sameFrame(p.end, q.end) && a.growth() == b.growth() && a.rebuilds() == b.rebuilds();
}

/// The mesh with its next frame in the place of its start, however small it is.
double refitted(const DeformingMesh& mesh, const Points& vertices, unsigned threads,
                DeformingMesh::Data& data) {
  data = mesh.data();
  return detail::refit(data, vertices, threads);
}

/// Boxes of the frame at `start`, from the vertices alone; returns the ratio of areas.
double expectBoxesOf(const DeformingMesh::Data& data, const Points& vertices,
                     const std::vector<Eigen::Vector3i>& triangles) {
  const auto areaOf = [](const Eigen::AlignedBox3f& box) {
    const Vector3d size = box.sizes().cast<double>();
    return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
  };
  std::vector<Eigen::AlignedBox3f> below;
  for (std::size_t slot = 0; slot < data.order.blocks[0] * 8; ++slot) {
    const std::size_t held = std::min(slot, triangles.size() - 1);
    Eigen::AlignedBox3f box;
    for (const int v : triangles[static_cast<std::size_t>(data.order.triangleOf[held])])
      box.extend(vertices[static_cast<std::size_t>(v)].cast<float>());
    below.push_back(box);
  }
  double triangleArea = 0.0, nodeArea = 0.0;
  for (const auto& box : below) triangleArea += areaOf(box);
  for (int level = 1; level < data.order.levels; ++level) {
    const auto& blocks = data.start.boxes[static_cast<std::size_t>(level)];
    std::vector<Eigen::AlignedBox3f> boxes;
    for (std::size_t i = 0; i < blocks.size() * 8; ++i) {
      Eigen::AlignedBox3f box;
      const std::size_t from = std::min(i, below.size() / 8 - 1);
      for (std::size_t k = 0; k < 8; ++k) box.extend(below[8 * from + k]);
      for (int k = 0; k < 3; ++k) {
        const auto axis = static_cast<std::size_t>(k);
        EXPECT_EQ(blocks[i / 8].lower[axis][i % 8], box.min()[k]) << level << ": " << i;
        EXPECT_EQ(blocks[i / 8].upper[axis][i % 8], box.max()[k]) << level << ": " << i;
      }
      boxes.push_back(box);
      if (level + 1 < data.order.levels) nodeArea += areaOf(box);
    }
    below = std::move(boxes);
  }
  return triangleArea > 0.0 ? nodeArea / triangleArea : 0.0;
}

TEST(DeformingThreads, EachNumberMakesTheSameFrame) {
  std::mt19937 random(17);
  // 4096 triangles are a subtree.
  for (const int count : {1, 2, 7, 8, 9, 64, 65, 511, 4095, 4096, 4097, 9000, 33000}) {
    const SoupMotion motion = test::randomTriangles(random, count, 0.05, 0.5);
    const DeformingMesh mesh = DeformingMesh::build(motion.soup.vertices, motion.soup.triangles);
    DeformingMesh::Data one(0, {}), many(0, {});
    const double ratio = refitted(mesh, motion.end, 1, one);
    EXPECT_NEAR(ratio, expectBoxesOf(one, motion.end, motion.soup.triangles), 1e-5 * ratio);
    EXPECT_EQ(ratio == 0.0, count <= 8);
    EXPECT_FALSE(sameFrame(one.start, one.end));
    for (const unsigned threads : kThreads) {
      for (int turn = 0; turn < 3; ++turn) {
        EXPECT_EQ(refitted(mesh, motion.end, threads, many), ratio) << count;
        ASSERT_TRUE(sameFrame(many.start, one.start)) << count << " on " << threads;
        ASSERT_TRUE(sameFrame(many.end, mesh.data().end)) << count << " on " << threads;
      }
    }
  }
}

/// Often enough for threads to be late, and early, at every stage.
TEST(DeformingThreads, MakeItAgainAndAgain) {
  std::mt19937 random(21);
  SoupMotion motion = test::randomTriangles(random, 33000, 0.05, 0.5);
  // Of all sizes: a sum of areas that differ that much depends on the order.
  std::uniform_real_distribution<double> exponent(-12.0, 12.0);
  for (Vector3d& v : motion.end) v *= std::exp2(exponent(random));
  const Points* const frames[] = {&motion.end, &motion.soup.vertices};
  const DeformingMesh mesh = DeformingMesh::build(motion.soup.vertices, motion.soup.triangles);
  DeformingMesh::Data expected[] = {mesh.data(), mesh.data()}, data = mesh.data();
  double ratio[2];
  for (int k = 0; k < 2; ++k) ratio[k] = detail::refit(expected[k], *frames[k], 1);
  for (int turn = 0; turn < 150; ++turn) {
    const int k = turn % 2;
    ASSERT_EQ(detail::refit(data, *frames[k], 2 + static_cast<unsigned>(turn % 6)), ratio[k]);
    ASSERT_TRUE(sameFrame(data.start, expected[k].start)) << "turn " << turn;
  }
}

/// Triangles that come near others, far enough from where they were for one rebuild or more.
std::vector<Points> mixingFrames(const SoupMotion& motion, std::mt19937& random) {
  std::vector<Points> frames{motion.soup.vertices, motion.end};
  std::vector<std::size_t> places(motion.end.size() / 3);
  for (std::size_t t = 0; t < places.size(); ++t) places[t] = t;
  std::shuffle(places.begin(), places.end(), random);
  Points mixed = motion.end;
  for (std::size_t v = 0; v < mixed.size(); ++v)
    mixed[v] = motion.soup.vertices[3 * places[v / 3] + v % 3];
  frames.push_back(mixed);
  for (Vector3d& v : mixed) v += 0.01 * test::uniformPoint(random, 1.0);
  frames.push_back(mixed);
  return frames;
}

TEST(DeformingThreads, EachNumberMakesTheSameMesh) {
  for (const int count : {50, 3000, 91000}) {
    std::mt19937 random(18);
    const SoupMotion motion = test::randomTriangles(random, count, 0.02, 0.01);
    const std::vector<Points> frames = mixingFrames(motion, random);
    const DeformingMesh built = DeformingMesh::build(motion.soup.vertices, motion.soup.triangles);
    std::vector<DeformingMesh> steps;
    for (const unsigned threads : {1U, 2U, 3U, 7U, 0U}) {
      DeformingMesh mesh = built;
      for (std::size_t f = 0; f < 2 * frames.size(); ++f) {
        if (f % 3 == 2) {
          mesh.place(frames[f % frames.size()], threads);
        } else {
          mesh.moveTo(frames[f % frames.size()], threads);
        }
        if (threads == 1) steps.push_back(mesh);
        ASSERT_TRUE(sameMesh(mesh, steps[f])) << count << ", step " << f << " on " << threads;
      }
      EXPECT_GE(mesh.rebuilds(), 1U);
      EXPECT_LT(mesh.rebuilds(), 2 * frames.size());
    }
  }
}

TEST(DeformingThreads, RefuseWithoutAChange) {
  std::mt19937 random(19);
  const SoupMotion motion = test::randomTriangles(random, 62000, 0.02, 0.1);
  DeformingMesh mesh = motion.mesh();
  const DeformingMesh before = mesh;
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double bad : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    for (const std::size_t at : {std::size_t{0}, motion.end.size() / 2, motion.end.size() - 1}) {
      Points vertices = motion.soup.vertices;
      vertices[at].y() = bad;
      for (const unsigned threads : {1U, 2U, 3U, 7U, 0U}) {
        for (int turn = 0; turn < 20; ++turn) {
          try {
            mesh.moveTo(vertices, threads);
            ADD_FAILURE() << "taken";
          } catch (const std::invalid_argument& error) {
            EXPECT_STREQ(error.what(), "DeformingMesh: a vertex is not finite");
          }
        }
        EXPECT_THROW(mesh.place(vertices, threads), std::invalid_argument);
        ASSERT_TRUE(sameMesh(mesh, before)) << "vertex " << at << " on " << threads;
      }
    }
  }
  EXPECT_THROW(mesh.moveTo(std::span(motion.end).first(3), 2), std::invalid_argument);
  EXPECT_TRUE(sameMesh(mesh, before));
  mesh.moveTo(motion.soup.vertices, 2);
  EXPECT_FALSE(sameMesh(mesh, before));
}

/// What a thread is started with comes from the heap.
TEST(DeformingThreads, StartWhereTheyPay) {
  std::mt19937 random(20);
  for (const int count : {2000, 59000, 61000}) {
    const SoupMotion motion = test::randomTriangles(random, count, 0.02, 0.001);
    DeformingMesh mesh = DeformingMesh::build(motion.soup.vertices, motion.soup.triangles);
    mesh.moveTo(motion.end);
    for (const unsigned threads : {1U, 2U, 7U}) {
      const long before = test::allocations;
      mesh.moveTo(motion.soup.vertices, threads);
      mesh.moveTo(motion.end, threads);
      EXPECT_EQ(test::allocations > before, threads > 1 && count > 60000) << count;
    }
    EXPECT_EQ(mesh.rebuilds(), 0U);
  }
}

}  // namespace
}  // namespace swept
