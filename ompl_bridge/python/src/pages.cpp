// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <utility>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "handles.hpp"
#include "swept/pages/page.hpp"
#include "swept/pages/task_page.hpp"
#include "tasks.hpp"
#include "trajectories.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

using Facts = std::vector<std::pair<std::string, std::string>>;

/// swept.Page. One thread at a time may use it: the GIL, which no function here releases, sees to
/// that.
struct PageHandle {
  Page page;
  std::size_t dimension;
};

PageOptions optionsOf(const RobotHandle& robot, const std::string& title,
                      const std::string& headline, const Facts& facts) {
  PageOptions options{.title = title, .headline = headline, .facts = facts};
  const Source& source = robot.source;
  if (source.cell != nullptr) {
    const ComposedRobot composed = compose(*source.cell);
    options.visuals = VisualModel::parse(composed.urdf, composed.name);
  } else if (!source.file.empty()) {
    options.visuals = VisualModel::load(source.file);
  }
  return options;
}

PageHandle make(const CheckerHandle& checker, const std::string& title, const std::string& headline,
                const Facts& facts) {
  return {Page(checker.shared(), optionsOf(checker.robot(), title, headline, facts)),
          checker.dimension()};
}

/// `cup attached to hand`.
std::string wordsOf(const TaskChange& change, const Checker& checker) {
  if (change.kind == TaskChange::Kind::Sensed) return change.body + " sensed";
  if (change.kind == TaskChange::Kind::Placed) return change.body + " placed";
  for (const AttachedBody& attached : checker.options().attached)
    if (attached.name == change.body) return change.body + " attached to " + attached.link;
  return change.body + " attached";
}

void addPhase(TaskPage& page, const PhaseHandle& handle, const RateLimits* limits) {
  const TaskPhase& phase = handle.phase;
  std::vector<std::string> changes;
  for (const TaskChange& change : phase.changes) changes.push_back(wordsOf(change, *phase.checker));
  TrajectoryQuery query;
  if (limits != nullptr) query.limits = *limits;
  page.addPhase(phase.name, phase.checker, controllerCurve(phase.trajectory), query, changes);
}

void bindTaskPage(py::module_& module) {
  py::class_<TaskPage>(
      module, "TaskPage",
      "An HTML page that plays the phases of a task on one clock, each with what its checker says. "
      "It does not say whether they join: verify_task\ndoes. Jupyter shows it. See `show_task`.")
      .def(py::init([](const RobotHandle& robot, const std::string& title,
                       const std::string& headline, const Facts& facts) {
             return TaskPage(optionsOf(robot, title, headline, facts));
           }),
           py::arg("robot"), py::kw_only(), py::arg("title") = "swept", py::arg("headline") = "",
           py::arg("facts") = Facts(),
           "`robot`: of all phases. `headline`: by default how many of the phases are free. "
           "`facts`: pairs of a name and a value.")
      .def("add_phase", &addPhase, py::arg("phase"), py::arg("limits") = nullptr,
           "Adds a TaskPhase, which begins where the one before ends, with RateLimits. Raises "
           "ArgumentError for one that begins earlier.")
      .def_property_readonly("html", &TaskPage::html,
                             "The whole page: one file that any browser opens from disk. Raises "
                             "ArgumentError without a phase.")
      .def("write", &TaskPage::write, py::arg("file"),
           "Writes the page to a .html file. Raises UsageError.");
}

}  // namespace

void bindPages(py::module_& module) {
  bindTaskPage(module);
  py::class_<PageHandle>(
      module, "Page",
      "An HTML page with a robot, its world, and what is proven about its states, "
      "motions or trajectories: one kind of these\na page. Jupyter shows it. See "
      "`show`.")
      .def(py::init(&make), py::arg("checker"), py::kw_only(), py::arg("title") = "swept",
           py::arg("headline") = "", py::arg("facts") = Facts(),
           "`headline`: by default how many of the states or motions are free. `facts`: pairs of a "
           "name and a value.")
      .def(
          "add_state",
          [](PageHandle& self, const std::string& label, const py::object& q) {
            self.page.addState(label, readVector(q, "q", self.dimension).numbers());
          },
          py::arg("label"), py::arg("q"), "Adds a state (n,).")
      .def(
          "add_path",
          [](PageHandle& self, const std::string& label, const py::object& path) {
            const Table table = readTable(path, "path", self.dimension);
            std::vector<std::vector<double>> states;
            for (const ConfigurationView row : table.list())
              states.emplace_back(row.begin(), row.end());
            self.page.addPath(label, states);
          },
          py::arg("label"), py::arg("path"), "Adds a path (m, n).")
      .def(
          "add_trajectory",
          [](PageHandle& self, const std::string& label, const py::object& trajectory,
             const RateLimits* limits) {
            TrajectoryQuery query;
            if (limits != nullptr) query.limits = *limits;
            self.page.addTrajectory(label, curveOf(trajectory, "trajectory"), query);
          },
          py::arg("label"), py::arg("trajectory"), py::arg("limits") = nullptr,
          "Adds a Trajectory or Curve, which the page plays in real time, with RateLimits.")
      .def_property_readonly(
          "html", [](const PageHandle& self) { return self.page.html(); },
          "The whole page: one file that any browser opens from disk.")
      .def(
          "write",
          [](const PageHandle& self, const std::filesystem::path& file) { self.page.write(file); },
          py::arg("file"), "Writes the page to a .html file. Raises UsageError.");
}

}  // namespace swept::python
