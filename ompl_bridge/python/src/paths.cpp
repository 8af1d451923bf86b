// SPDX-License-Identifier: BSD-3-Clause
#include "paths.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <vector>

#include "arrays.hpp"
#include "binding.hpp"
#include "certificates.hpp"
#include "enums.hpp"
#include "errors.hpp"
#include "handles.hpp"
#include "loading.hpp"
#include "swept/robot_model/path_clearance.hpp"
#include "swept/robot_model/path_file.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

py::tuple segmentsOf(const PathCertificate& self) {
  py::tuple segments(self.segments.size());
  for (std::size_t i = 0; i < self.segments.size(); ++i)
    segments[i] = makeCertificate(MotionCertificate(self.segments[i].certificate));
  return segments;
}

py::tuple clearancesOf(const PathCertificate& self) {
  py::tuple clearances(self.segments.size());
  for (std::size_t i = 0; i < self.segments.size(); ++i) clearances[i] = self.segments[i].clearance;
  return clearances;
}

void bindCertificate(py::module_& module) {
  py::class_<PathCertificate> type(module, "PathCertificate",
                                   "What is known about a path: straight motions between "
                                   "configurations. True if the verdict is FREE.");
  type.def_property_readonly(
          "verdict", [](const PathCertificate& self) { return toPython(self.verdict()); },
          "VIOLATION if one segment is, else COLLISION if one is; FREE if all are; else UNDECIDED.")
      .def_property_readonly("segments", &segmentsOf,
                             "A MotionCertificate for the motion from each state to the next.")
      .def_property_readonly(
          "clearances", &clearancesOf,
          "A MotionClearance for each; None in a collision, and if not asked for.")
      .def("__len__", [](const PathCertificate& self) { return self.segments.size(); })
      .def("__bool__", [](const PathCertificate& self) { return self.verdict() == Verdict::Free; })
      .def("__repr__", [](const PathCertificate& self) {
        return "<swept.PathCertificate " + std::string(toString(self.verdict())) + ", " +
               std::to_string(self.count(Verdict::Free)) + " of " +
               std::to_string(self.segments.size()) + " segments free>";
      });
  addImmutableCopies(type);
}

PathCertificate certify(const CheckerHandle& checker, const py::object& path, bool clearances,
                        unsigned threads, std::optional<double> seconds,
                        const std::shared_ptr<CancellationToken>& cancel) {
  const Watch watch(seconds, cancel);
  const Table states = readTable(path, "path", checker.dimension());
  return certifyTable(checker.checker(), states, clearances, threads, watch);
}

py::object read(const std::filesystem::path& file, const CheckerHandle& checker) {
  const Checker& of = checker.checker();
  Remarks remarks;
  const LoadOptions options = remarks.optionsFor({});
  std::vector<std::vector<double>> states;
  {
    const py::gil_scoped_release others;
    states = readPath(file, of.robot(), of.group(), of.options().reference, options);
  }
  remarks.warn();
  return makeArray(states, of.group().variables.size());
}

PathClearance clearanceOf(const CheckerHandle& checker, const py::object& path, double accuracy,
                          const py::object& query) {
  const Table states = readTable(path, "path", checker.dimension());
  const ClearanceQuery how =
      query.is_none() ? ClearanceQuery::ByKind : clearanceQueryOf(query, "query");
  const py::gil_scoped_release others;
  Workspace workspace(checker.checker());
  return pathClearance(checker.checker(), states.list(), accuracy, workspace, how);
}

void write(const std::filesystem::path& file, const CheckerHandle& checker, const py::object& path,
           const PathCertificate* certificate, const Token& cancel) {
  const Table states = readTable(path, "path", checker.dimension());
  const PathCertificate own =
      certificate != nullptr ? PathCertificate()
                             : certifyTable(checker.checker(), states, true, 0, Watch({}, cancel));
  requireWritten(watched(cancel, [&](const std::stop_token& stop) {
    return writeProof(file, checker.checker(), states.list(),
                      certificate != nullptr ? *certificate : own, {}, stop);
  }));
}

void writeOfTrajectory(const std::filesystem::path& file, const CheckerHandle& checker,
                       const JointTrajectory& trajectory, const TrajectoryCertificate* certificate,
                       double clock, const Token& cancel) {
  const Checker& of = checker.checker();
  requireWritten(watched(cancel, [&](const std::stop_token& stop) {
    if (certificate != nullptr && certificate->world && certificate->self)
      return writeTrajectoryProof(file, of, trajectory, *certificate, {}, clock, stop);
    Workspace workspace(of);
    const TrajectoryCertificate own = of.certifyTrajectory(
        controllerCurve(trajectory), workspace, {.clock = clock, .limits = {}, .clearances = true});
    return writeTrajectoryProof(file, of, trajectory, own, {}, clock, stop);
  }));
}

CheckedProof verify(const std::filesystem::path& file, const CheckerHandle* checker,
                    const Token& cancel) {
  return watched(cancel, [&](const std::stop_token& stop) {
    return checker != nullptr ? verifyProof(file, checker->checker(), stop)
                              : verifyProof(file, stop);
  });
}

void bindProofs(py::module_& module) {
  py::class_<CheckedProof> type(module, "CheckedProof",
                                "The result of checking a proof. True if it holds; otherwise only "
                                "`refusal` means something.");
  type.def_property_readonly("holds", &CheckedProof::holds, "Whether the file's claims are proven.")
      .def_readonly("refusal", &CheckedProof::refusal,
                    "The first place where it does not hold, or what was changed; empty: it holds.")
      .def_readonly("segments", &CheckedProof::segments,
                    "Of the path, or pieces of the trajectory.")
      .def_readonly("pairs", &CheckedProof::pairs, "Of bodies that must stay apart.")
      .def_readonly("intervals", &CheckedProof::intervals, "Of all pairs and segments.")
      .def_readonly("planes", &CheckedProof::planes, "Likewise.")
      .def_readonly("clearance", &CheckedProof::clearance,
                    "m, every pair keeps more; inf: no pairs.")
      .def_readonly("clearance_world", &CheckedProof::clearanceWorld, "m, of pairs with the world.")
      .def_readonly("clearance_self", &CheckedProof::clearanceSelf,
                    "m, of pairs of the robot's own bodies.")
      .def_readonly("not_checked", &CheckedProof::notChecked,
                    "Pairs that may touch and were not checked, by who says so.")
      .def_readonly("constraints", &CheckedProof::constraints,
                    "What holds at every instant besides, in words.")
      .def_readonly("duration", &CheckedProof::duration, "s, of a trajectory; None for a path.")
      .def("__bool__", &CheckedProof::holds);
  addRepr(type, {"holds", "refusal", "segments", "pairs", "planes", "clearance"});

  module.def(
      "write_proof", &write, py::arg("file"), py::arg("checker"), py::arg("path"),
      py::arg("certificate") = nullptr, py::kw_only(), py::arg("cancel") = py::none(),
      "Writes a path (m, n) with planes that separate all pairs of bodies, the robot and the "
      "world to a .json file, which can be\nchecked without any other: `verify`, or `swept "
      "verify`. `certificate`: of certify_path, for the same path. Raises\nUsageError for a "
      "path that is not FREE, or for which no proof was found. Ctrl-C and `cancel`, a "
      "CancellationToken, end it, and there is no file:\nKeyboardInterrupt, Cancelled.");
  module.def("write_trajectory_proof", &writeOfTrajectory, py::arg("file"), py::arg("checker"),
             py::arg("trajectory"), py::arg("certificate") = nullptr, py::kw_only(),
             py::arg("clock") = 0.0, py::arg("cancel") = py::none(),
             "The same for the curve of a Trajectory. `certificate`: of certify_trajectory with "
             "`clearances`, for the same trajectory and `clock`: s, what\nmoving obstacles' clock "
             "shows at time 0. They are in the file, with their waypoints.");
  module.def("verify", &verify, py::arg("file"), py::arg("checker") = nullptr, py::kw_only(),
             py::arg("cancel") = py::none(),
             "CheckedProof of a file, by a checker that shares no code with what found the proof. "
             "`checker`: also compares robot, world,\nrules and constraints with its own. Raises "
             "InputError for a "
             "file that is no path with a proof. `cancel` as of write_proof.");
}

}  // namespace

PathCertificate certifyTable(const Checker& checker, const Table& states, bool clearances,
                             unsigned threads, const Watch& watch) {
  PathCertificate certificate;
  if (states.rows() == 0) throw std::invalid_argument("path: expected one state at least");
  // In parts, between which the caller may end it.
  Pace pace{.seconds = 1e-2};
  const std::size_t segments = std::max<std::size_t>(states.rows(), 2) - 1;
  const std::vector<ConfigurationView> all = states.list();
  runInRanges(segments, watch, pace, [&](std::size_t begin, std::size_t end) {
    const std::vector<ConfigurationView> some(
        all.begin() + static_cast<std::ptrdiff_t>(begin),
        all.begin() + static_cast<std::ptrdiff_t>(std::min(end + 1, all.size())));
    PathCertificate part =
        certifyPath(checker, some, {.clearances = clearances, .threads = threads});
    std::ranges::move(part.segments, std::back_inserter(certificate.segments));
  });
  return certificate;
}

void requireWritten(const WrittenProof& written) {
  if (!written.isWritten()) throw UsageError("no proof was found for " + written.missing);
}

void bindPaths(py::module_& module) {
  bindCertificate(module);
  bindProofs(module);
  module.def(
      "certify_path", &certify, py::arg("checker"), py::arg("path"), py::kw_only(),
      py::arg("clearances") = true, py::arg("threads") = 0, py::arg("seconds") = py::none(),
      py::arg("cancel") = py::none(),
      "PathCertificate of a path (m, n) from any planner: of the motions from each state to the "
      "next. `clearances`: whether to\ncompute them. The other arguments are those of "
      "Checker.check_states. Limits are not looked at.");
  module.def("path_clearance", &clearanceOf, py::arg("checker"), py::arg("path"),
             py::arg("accuracy") = 1e-3, py::arg("query") = py::none(),
             "PathClearance of a path (m, n): as Checker.motion_clearance, over all its motions.");
  module.def(
      "read_path", &read, py::arg("file"), py::arg("checker"),
      "(m, n) configurations of a path in a file: .csv, .yaml as ROS prints messages, or .json. "
      "In the order of the checker's group,\nwithin the limits. Raises InputError.");
}

}  // namespace swept::python
