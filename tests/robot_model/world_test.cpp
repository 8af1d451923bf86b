// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

namespace swept {
namespace {

using Eigen::Isometry3d;

Isometry3d at(double x) {
  return Isometry3d(Eigen::Translation3d(x, 0, 0));
}

WorldBody ball(const std::string& name, double x) {
  return {.name = name, .parts = {{Sphere{0.1}, at(x)}}};
}

MovingObstacle drone(const std::string& name, double x) {
  return {.name = name,
          .parts = {{Sphere{0.1}, Isometry3d::Identity()}},
          .waypoints = {{.time = 0.0, .world_from_body = at(x)}}};
}

/// Names in order, each with where it is: what a world is to be like.
struct Listed {
  std::string name;
  double x;
  bool operator==(const Listed&) const = default;
};

/// The world finds by their names what is in the lists, and nothing else.
void expectAs(const World& world, const std::vector<Listed>& still,
              const std::vector<Listed>& moving, int names) {
  std::vector<Listed> bodies, obstacles;
  for (const WorldBody& body : world.bodies())
    bodies.push_back({body.name, body.parts[0].world_from_shape.translation().x()});
  for (const MovingObstacle& body : world.obstacles())
    obstacles.push_back({body.name, body.waypoints[0].world_from_body.translation().x()});
  ASSERT_EQ(bodies, still);
  ASSERT_EQ(obstacles, moving);
  for (int i = 0; i < names; ++i) {
    const std::string name = "n" + std::to_string(i);
    const auto body = std::ranges::find(world.bodies(), name, &WorldBody::name);
    const auto obstacle = std::ranges::find(world.obstacles(), name, &MovingObstacle::name);
    ASSERT_EQ(world.find(name), body == world.bodies().end() ? nullptr : &*body);
    ASSERT_EQ(world.findObstacle(name), obstacle == world.obstacles().end() ? nullptr : &*obstacle);
  }
}

/// Against lists that are searched from their begin, whatever is added, replaced and removed, and
/// in copies.
TEST(World, FindsWhatIsThereByItsName) {
  constexpr int kNames = 12;
  std::mt19937 random(7);
  World world;
  std::vector<Listed> still, moving;
  int added = 0, refused = 0, removed = 0, replaced = 0;
  const auto isNamed = [](const std::string& name) {
    return [&name](const Listed& other) { return other.name == name; };
  };
  for (int i = 0; i < 3000; ++i) {
    const std::string name = "n" + std::to_string(random() % kNames);
    const double x = i;
    const bool taken =
        std::ranges::any_of(still, isNamed(name)) || std::ranges::any_of(moving, isNamed(name));
    switch (random() % 4) {
      case 0:
      case 1: {
        const bool moves = random() % 2 == 0;
        if (taken) {
          EXPECT_THROW(moves ? world.add(drone(name, x)) : world.add(ball(name, x)),
                       std::invalid_argument);
          ++refused;
          break;
        }
        moves ? world.add(drone(name, x)) : world.add(ball(name, x));
        (moves ? moving : still).push_back({name, x});
        ++added;
        break;
      }
      case 2:
        EXPECT_EQ(world.remove(name), taken);
        removed += taken ? 1 : 0;
        std::erase_if(still, isNamed(name));
        std::erase_if(moving, isNamed(name));
        break;
      default: {
        const auto old = std::ranges::find_if(still, isNamed(name));
        if (old == still.end()) {
          EXPECT_THROW(world.replace(ball(name, x)), std::invalid_argument);
          break;
        }
        world.replace(ball(name, x));
        old->x = x;
        ++replaced;
      }
    }
    ASSERT_NO_FATAL_FAILURE(expectAs(world, still, moving, kNames)) << "step " << i;
    if (i % 100 == 0) {
      // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): copies are asked here.
      const World copy = world;
      ASSERT_NO_FATAL_FAILURE(expectAs(copy, still, moving, kNames)) << "step " << i;
    }
  }
  for (const int count : {added, refused, removed, replaced}) EXPECT_GT(count, 100);
}

}  // namespace
}  // namespace swept
