// SPDX-License-Identifier: BSD-3-Clause
// A page of a path, in one HTML file that any browser opens: robot and world, the motions to play,
// what is proven about them, and the robot's visual meshes. Needs no OMPL.
//   example_14_page MODELS
// Exits 0 if the page and the checker agree about the path.
#include <filesystem>
#include <iostream>

#include "swept/pages/page.hpp"
#include "swept/robot_model/planning_scene.hpp"

int main(int argc, char** argv) try {
  const std::string models = argc > 1 ? argv[1] : "models";
  const std::string arm = models + "/robots/rook7/rook7";
  const auto robot = swept::Robot::load(arm + ".urdf", arm + ".srdf");
  const auto world =
      std::make_shared<const swept::World>(swept::World::load(models + "/scenes/narrow_slot.yaml"));
  const auto checker = std::make_shared<const swept::Checker>(robot, "arm", world);

  // The URDF's <visual> elements: the page can show them instead of the checked shapes.
  swept::PageOptions options;
  options.title = "my planner";
  options.facts = {{"planning time", "12 ms"}};
  options.visuals = swept::VisualModel::load(arm + ".urdf");

  // Paths of two planners; the second goes through the wall.
  const std::vector<double> home{0, -0.5, 0, 1.0, 0, 0.4, 0}, ready{0, -0.3, 0, 1.9, 0, 1.54, 0};
  const std::vector<std::vector<double>> around{home, {-0.4, -0.5, 0, 1.0, 0, 0.4, 0}};
  const std::vector<std::vector<double>> straight{home, ready};
  swept::Page page(checker, options);
  page.addPath("around", around);
  page.addPath("straight", straight);

  const auto file = std::filesystem::temp_directory_path() / "swept_example_page.html";
  page.write(file);
  std::cout << "page of " << std::filesystem::file_size(file) << " bytes written to " << file
            << '\n';
  const std::string html = page.html();
  const auto says = [&](const char* text) { return html.find(text) != std::string::npos; };
  std::filesystem::remove(file);
  return says("2 paths: 1 free, 1 in collision") && says("\"title\":\"my planner\"") ? 0 : 1;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 3;
}
