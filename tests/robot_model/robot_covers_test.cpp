// SPDX-License-Identifier: BSD-3-Clause
#include "io/robot_covers.hpp"
#include "robot/shape_cover.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "../core/mesh_samples.hpp"
#include "input_files.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;

Link linkOf(const std::vector<Shape>& shapes) {
  Link link;
  for (const Shape& shape : shapes) {
    link.collision.push_back({shape, Eigen::Isometry3d::Identity(), "test"});
  }
  return link;
}

TriangleMesh torus() {
  const test::Soup soup = test::torusSoup(20, 10, 0.2, 0.06);
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

std::vector<Link> someLinks() {
  const TriangleMesh mesh = torus();
  return {linkOf({Box{{0.1, 0.2, 0.05}}, mesh}),
          linkOf({Cylinder{0.05, 0.1}, Capsule{0.05, 0.1}, Box{{0.1, 0.2, 0.06}}}),
          linkOf({mesh, torus(), Box{{0.1, 0.2, 0.05}}, Sphere{0.1}})};
}

TEST(RobotCovers, EqualGeometriesShareOne) {
  std::vector<Link> links = someLinks();
  detail::addCovers(links, 1);
  const auto cover = [&](int link, int piece) { return links[link].collision[piece].cover.get(); };
  EXPECT_EQ(cover(0, 0), cover(2, 2));
  EXPECT_EQ(cover(0, 1), cover(2, 0));
  EXPECT_NE(cover(0, 1), cover(2, 1)) << "a mesh read twice is not known to be the same";
  EXPECT_NE(cover(0, 0), cover(1, 2));
  EXPECT_NE(cover(1, 0), cover(1, 1));
  EXPECT_GT(links[0].collision[1].coverSeconds, 0.0);
  EXPECT_EQ(links[2].collision[0].coverSeconds, 0.0);
}

TEST(RobotCovers, ThreadsChangeNothing) {
  std::vector<Link> one = someLinks();
  detail::addCovers(one, 1);
  for (const unsigned threads : {0u, 2u, 5u, 64u}) {
    std::vector<Link> many = someLinks();
    detail::addCovers(many, threads);
    for (std::size_t i = 0; i < one.size(); ++i) {
      for (std::size_t k = 0; k < one[i].collision.size(); ++k) {
        const SphereCover& a = *one[i].collision[k].cover;
        const SphereCover& b = *many[i].collision[k].cover;
        ASSERT_EQ(a.nodes.size(), b.nodes.size());
        for (std::size_t n = 0; n < a.nodes.size(); ++n) {
          EXPECT_EQ(a.nodes[n].ball.center, b.nodes[n].ball.center);
          EXPECT_EQ(a.nodes[n].ball.radius, b.nodes[n].ball.radius);
          EXPECT_EQ(a.nodes[n].inside, b.nodes[n].inside);
        }
      }
    }
  }
}

TEST(RobotCovers, AreAsFineAsTheConstantsSay) {
  std::vector<Link> links{linkOf({Box{{0.04, 0.05, 0.06}}, Cylinder{0.3, 0.5}})};
  detail::addCovers(links, 1);
  EXPECT_DOUBLE_EQ(links[0].collision[0].cover->levels.back().aimed, detail::kCoverOverhang);
  const SphereCover& large = *links[0].collision[1].cover;
  EXPECT_NEAR(large.levels.back().aimed, detail::kCoverRelative * large.nodes[0].ball.radius, 1e-5);
  EXPECT_GT(large.levels.back().aimed, 2.0 * detail::kCoverOverhang);
}

TEST(RobotCovers, UnboundedGeometryHasNone) {
  std::vector<Link> links{linkOf({Plane{Vector3d::UnitZ(), 0.0}, Sphere{0.1}})};
  detail::addCovers(links, 2);
  EXPECT_EQ(links[0].collision[0].cover, nullptr);
  EXPECT_NE(links[0].collision[1].cover, nullptr);
}

TEST(RobotCovers, EveryGeometryOfALoadedRobotHasOne) {
  const auto robot = Robot::parse(
      "<robot name='r'><link name='a'><collision><geometry><box size='1 1 1'/></geometry>"
      "</collision><collision><geometry><sphere radius='0.1'/></geometry></collision></link>"
      "</robot>",
      "r.urdf");
  ASSERT_EQ(robot->links()[0].collision.size(), 2u);
  for (const CollisionGeometry& geometry : robot->links()[0].collision) {
    ASSERT_NE(geometry.cover, nullptr);
    EXPECT_GT(geometry.cover->nodes.front().inside, 0.0F);
  }
}

}  // namespace
}  // namespace swept
