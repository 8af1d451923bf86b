// SPDX-License-Identifier: BSD-3-Clause
// The page of a task, for task_page_browser.py: task_pages NAME --html FILE.html
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "robot_model/carried_box.hpp"
#include "swept/pages/task_page.hpp"

int main(int argc, char** argv) try {
  if (argc != 4 || std::string(argv[1]) != "box") return 2;
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
