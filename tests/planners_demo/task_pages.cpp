// SPDX-License-Identifier: BSD-3-Clause
// The page of a task, for task_page_browser.py: task_pages NAME --html FILE.html
#include <Eigen/Geometry>
#include <exception>
#include <iostream>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "robot_model/carried_box.hpp"
#include "robot_model/sliding_cube.hpp"
#include "swept/pages/task_page.hpp"

namespace {

/// A cube goes from x = -1 to 1 m in 2 s, and waits for 1 s; a bar comes along y from -3 m at 0 s
/// to 3 m at 6 s of a clock that shows 2 s at the task's time 0, and turns by a quarter.
void writeBar(const char* file) {
  const auto at = [](double y, double angle) {
    return Eigen::Isometry3d(Eigen::Translation3d(0, y, 0.5) *
                             Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()));
  };
  const auto checker = std::make_shared<const swept::Checker>(
      swept::Checker(swept::test::slidingCube(), "all", std::make_shared<const swept::World>())
          .withObstacle(
              {.name = "bar",
               .parts = {{swept::makeBox({1.0, 0.1, 0.1}), Eigen::Isometry3d::Identity()}},
               .waypoints = {{0.0, at(-3, 0)}, {6.0, at(3, 0.5 * std::numbers::pi)}}}));
  swept::TaskPage page;
  Eigen::MatrixXd goes(2, 2), waits(2, 2);
  goes << -1, 1, 0, 0;
  waits << 1, 1, 0, 0;
  page.addPhase("go", checker, {{0.0, 2.0}, {goes}}, {.clock = 2.0});
  page.addPhase("wait", checker, {{2.0, 3.0}, {waits}}, {.clock = 2.0});
  page.write(file);
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string name = argc == 4 ? argv[1] : "";
  if (name == "bar") {
    writeBar(argv[3]);
    return 0;
  }
  if (name != "box") return 2;
  const swept::test::CarriedBox box;
  swept::PageOptions options;
  options.title = "a box <b>carried</b>";
  swept::TaskPage page(options);
  const std::vector<std::vector<std::string>> changes{
      {}, {"box attached to cube"}, {}, {}, {"box placed", "map sensed"}};
  std::size_t i = 0;
  for (const swept::TaskPhase& phase : box.phases())
    page.addPhase(phase.name, phase.checker, swept::controllerCurve(phase.trajectory), {},
                  changes[i++]);
  page.write(argv[3]);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
