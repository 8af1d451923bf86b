// SPDX-License-Identifier: BSD-3-Clause
// What a robot sweeps is in its boxes, and a body of the world where its space says: by sampling.
#include "graph/motion_boxes.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "graph/body_space.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "version_arms.hpp"

namespace swept::detail {
namespace {

using test::at;

bool contains(const SingleBox& box, const Eigen::Vector3d& point, double slack = 0.0) {
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = point[static_cast<Eigen::Index>(k)];
    if (x < box.lower(k) - slack || x > box.upper(k) + slack) return false;
  }
  return true;
}

/// Points of a shape, its extreme ones among them.
std::vector<Eigen::Vector3d> pointsOf(const Shape& shape) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) return mesh->vertices();
  if (const auto* hull = std::get_if<ConvexHull>(&shape)) return hull->vertices();
  std::vector<Eigen::Vector3d> points;
  const Aabb box = boundingBox(shape);
  if (std::holds_alternative<Box>(shape)) {
    for (int i = 0; i < 8; ++i)
      points.emplace_back((i & 1) != 0 ? box.lower.x() : box.upper.x(),
                          (i & 2) != 0 ? box.lower.y() : box.upper.y(),
                          (i & 4) != 0 ? box.lower.z() : box.upper.z());
  } else {  // round about z: in the middle of each side of its box
    for (int k = 0; k < 3; ++k)
      for (const Eigen::Vector3d& end : {box.lower, box.upper}) {
        Eigen::Vector3d point = box.center();
        point[k] = end[k];
        points.push_back(point);
      }
  }
  return points;
}

/// Of each piece of a moving link, in the order of MotionBoxes: attached bodies come last.
struct Piece {
  std::string link;
  Eigen::Isometry3d link_from_shape;
  std::vector<Eigen::Vector3d> points;
};

void expectContained(const std::shared_ptr<const Robot>& robot, const std::string& group,
                     const CheckerOptions& options, unsigned seed) {
  const Checker checker(robot, group, std::make_shared<const World>(), options);
  const MotionBoxes boxesOf(checker);
  std::vector<Piece> pieces;
  std::mt19937 random(seed);
  const std::vector<double> q = test::randomConfiguration(checker, random);
  const std::vector<double> p = test::randomConfiguration(checker, random);
  for (const Link& link : robot->links())
    for (const CollisionGeometry& geometry : link.collision) {
      const LinkMotion motion(*robot, group, link.name, q, p);
      if (motion.rates(0, 1).speed > 0.0 || motion.rates(0, 1).angularSpeed > 0.0)
        pieces.push_back({link.name, geometry.link_from_shape, pointsOf(geometry.shape)});
    }
  for (const AttachedBody& body : options.attached)
    pieces.push_back({body.link, body.parts[0].link_from_shape, pointsOf(body.parts[0].shape)});
  ASSERT_EQ(pieces.size(), boxesOf.pieces());
  MotionBoxes::Scratch scratch;
  std::vector<SingleBox> boxes(boxesOf.boxes());
  std::uniform_real_distribution<double> share(0.0, 1.0), error(-1.0, 1.0);
  std::size_t tested = 0, near = 0;
  for (int i = 0; i < 30; ++i) {
    const std::vector<double> from = test::randomConfiguration(checker, random);
    std::vector<double> to = test::randomConfiguration(checker, random);
    const double way = i % 3 == 0 ? 1.0 : 0.2;
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[k] + way * (to[k] - from[k]);
    boxesOf.find(from, to, boxes, scratch);
    for (std::size_t part = 0; part < MotionBoxes::kParts; ++part)
      for (int sample = 0; sample < 4; ++sample) {
        const double within = sample == 0 ? 0.0 : sample == 1 ? 1.0 : share(random);
        const double t = (static_cast<double>(part) + within) / MotionBoxes::kParts;
        std::vector<double> beside(from.size());
        checker.interpolate(from, to, t, beside);
        for (double& value : beside) value += error(random) * options.tracking.rotation;
        for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
          const Eigen::Isometry3d pose =
              linkPose(*robot, group, pieces[piece].link, beside) * pieces[piece].link_from_shape;
          const SingleBox& box = boxes[part * pieces.size() + piece];
          for (const Eigen::Vector3d& point : pieces[piece].points) {
            const Eigen::Vector3d placed = pose * point;
            ASSERT_TRUE(contains(box, placed)) << pieces[piece].link << " at " << t;
            ++tested;
            near += contains(box, placed, -0.03) ? 0 : 1;
          }
        }
      }
  }
  // Some points are near the sides, or smaller boxes would do as well.
  EXPECT_GT(tested, 10'000U);
  EXPECT_GT(50 * near, tested);
}

TEST(MotionBoxes, HoldWhatIsSwept) {
  const auto arm = test::parseArm(test::armUrdf({}));
  CheckerOptions options;
  expectContained(arm, "all", options, 1);
  options.attached = {{"tool", "hand", {{Box{{0.02, 0.03, 0.2}}, at(0, 0.1, 0.1)}}}};
  expectContained(arm, "all", options, 2);
  options.tracking.rotation = 0.05;
  expectContained(arm, "all", options, 3);
  const std::filesystem::path robots = std::filesystem::path(modelsDir()) / "robots";
  for (const char* name : {"rook7", "rook6_cart"}) {
    const std::filesystem::path urdf = robots / name / (std::string(name) + ".urdf");
    const auto robot = Robot::load(urdf, Robot::srdfBeside(urdf));
    expectContained(robot, robot->groups().front().name, {}, 4);
  }
}

TEST(MotionBoxes, AreUnboundedWhereNothingIsKnown) {
  const auto arm = test::parseArm(test::armUrdf({}));
  const MotionBoxes boxesOf(Checker(arm, "all", std::make_shared<const World>()));
  MotionBoxes::Scratch scratch;
  std::vector<SingleBox> boxes(boxesOf.boxes());
  const std::vector<double> from{0.0, 0.0}, to{0.0, 1e300};
  boxesOf.find(from, to, boxes, scratch);
  const BodySpace far({"far", {{Sphere{0.1}, at(1e20, 0, 0)}}}, 1.0, 0.0, 1e-13);
  EXPECT_TRUE(far.touches(boxes.back()));
}

TEST(BodySpace, HasAllOfItsBody) {
  std::mt19937 random(5);
  const auto uniform = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::size_t touching = 0, apart = 0, inside = 0;
  for (int i = 0; i < 400; ++i) {
    WorldBody body{.name = "body"};
    const std::size_t parts = i % 5 == 0 ? 60 : 1 + random() % 3;
    std::vector<Eigen::Vector3d> points;
    for (std::size_t part = 0; part < parts; ++part) {
      Eigen::Isometry3d pose = at(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
      pose.rotate(
          Eigen::AngleAxisd(uniform(-3, 3), Eigen::Vector3d(1, uniform(-1, 1), 1).normalized()));
      std::vector<Eigen::Vector3d> local;
      if (i % 4 == 1 && parts == 1) {
        for (int k = 0; k < 300; ++k)
          local.emplace_back(uniform(-0.3, 0.3), uniform(-0.3, 0.3), uniform(-0.01, 0.01));
        body.parts.push_back({PointCloud::build(local, 0.0), pose});
      } else {
        const Shape shape = Box{{uniform(0, 0.2), uniform(0, 0.2), uniform(0, 0.2)}};
        local = pointsOf(shape);
        body.parts.push_back({shape, pose});
      }
      for (const Eigen::Vector3d& point : local) points.push_back(pose * point);
    }
    const double margin = i % 3 == 0 ? 0.05 : 0.0;
    const BodySpace space(body, 1.0, margin, 1e-13);
    for (int k = 0; k < 60; ++k) {
      Eigen::Vector3d middle(uniform(-1.3, 1.3), uniform(-1.3, 1.3), uniform(-1.3, 1.3));
      const Eigen::Vector3d half(uniform(0, 0.1), uniform(0, 0.1), uniform(0, 0.1));
      // Half of the boxes begin at a point of the body, or a margin from it.
      const bool meets = k % 2 == 0;
      if (meets) {
        middle = points[random() % points.size()];
        middle.x() += half.x() + 0.999 * margin;
      }
      const SingleBox box = singleBox(middle - half, middle + half);
      const bool touches = space.touches(box);
      ++(touches ? touching : apart);
      if (meets) {
        ASSERT_TRUE(touches) << i;
        ASSERT_TRUE(BoxProbe(space.box()).overlaps(box));
      }
      for (const Eigen::Vector3d& point : points)
        inside += contains(box, point) && !touches ? 1 : 0;
    }
  }
  EXPECT_EQ(inside, 0U);
  EXPECT_GT(touching, 5000U);
  EXPECT_GT(apart, 5000U);
}

TEST(BodySpace, OfFlatBodiesIsOnTheirSide) {
  const BodySpace floor({"floor", {{makeHalfSpace({0, 0, 1}, 0.0), at(0, 0, -0.1)}}}, 1.0, 0.0,
                        1e-13);
  const BodySpace sheet({"sheet", {{makePlane({1, 0, 0}, 0.5), at(0, 0, 0)}}}, 1.0, 0.01, 1e-13);
  const auto boxAt = [](double x, double z) {
    return singleBox(Eigen::Vector3d(x, 0, z), Eigen::Vector3d(x + 0.1, 0.1, z + 0.1));
  };
  EXPECT_TRUE(floor.touches(boxAt(5, -0.15)));
  EXPECT_TRUE(floor.touches(boxAt(5, -7)));
  EXPECT_FALSE(floor.touches(boxAt(5, -0.09)));
  EXPECT_TRUE(sheet.touches(boxAt(0.45, 3)));
  EXPECT_TRUE(sheet.touches(boxAt(0.395, 3)));
  EXPECT_FALSE(sheet.touches(boxAt(0.38, 3)));
  EXPECT_FALSE(sheet.touches(boxAt(0.52, 3)));
  EXPECT_TRUE(sheet.touches(unboundedBox()));
}

}  // namespace
}  // namespace swept::detail
