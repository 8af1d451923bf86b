// SPDX-License-Identifier: BSD-3-Clause
// Capsules, boxes and hulls around the hand: shapes_test.py has the same. A question has q, which
// does not matter, the kind and the number.
#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "answer.hpp"
#include "swept/robot_model/shape_model.hpp"

namespace swept::test {
namespace {

struct AddParameters {
  Answer& answer;

  void operator()(const Box& box) const { answer << Eigen::Vector3d(2.0 * box.halfExtents); }
  void operator()(const Capsule& capsule) const {
    answer << capsule.radius << 2.0 * capsule.halfLength;
  }
  void operator()(const ConvexHull& hull) const {
    for (const Eigen::Vector3d& vertex : hull.vertices()) answer << vertex;
  }
  template <typename Other>
  void operator()(const Other& /*shape*/) const {
    answer << "other";
  }
};

}  // namespace

bool askShapes(Answer& answer, const std::string& question, const Checker& checker,
               std::span<const double> more) {
  if (question != "shapes") return false;
  const Robot& robot = checker.robot();
  const std::vector<PosedShape> hand =
      bodyOf(robot.links()[static_cast<std::size_t>(*robot.findLink("hand"))]);
  const int count = static_cast<int>(more[1]);
  EnclosingShapesSearch search(hand, static_cast<EnclosingKind>(more[0]), {.pieces = 20});
  answer << static_cast<double>(search.countFor(0.02)) << search.reachFor(count);
  const EnclosingShapes found = search.atMost(count);
  answer << found.reach;
  for (const PosedShape& posed : found.shapes) {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) answer << posed.body_from_shape.matrix()(i, j);
    std::visit(AddParameters{answer}, posed.shape);
  }
  const OutsideSpheres outside =
      outsideShapes(hand, found.shapes, {.mostSplits = 3000, .samples = 500});
  const SphereExcess excess =
      shapesExcess(hand, found.shapes, 0.01, {.samples = 300, .mostDistances = 1000});
  answer << outside.lower << outside.upper << outside.point << outside.surfaceShare
         << excess.largestSeen << excess.largest << excess.mean << excess.volumeRatio;
  return true;
}

}  // namespace swept::test
