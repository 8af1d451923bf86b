// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <utility>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "handles.hpp"
#include "swept/pages/page.hpp"
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

PageHandle make(const CheckerHandle& checker, const std::string& title, const std::string& headline,
                const Facts& facts) {
  PageOptions options{.title = title, .headline = headline, .facts = facts};
  const Source& source = checker.robot().source;
  if (source.cell != nullptr) {
    const ComposedRobot composed = compose(*source.cell);
    options.visuals = VisualModel::parse(composed.urdf, composed.name);
  } else if (!source.file.empty()) {
    options.visuals = VisualModel::load(source.file);
  }
  return {Page(checker.shared(), std::move(options)), checker.dimension()};
}

}  // namespace

void bindPages(py::module_& module) {
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
