// SPDX-License-Identifier: BSD-3-Clause
#include "tasks.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "binding.hpp"
#include "enums.hpp"
#include "paths.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

PhaseHandle makePhase(const std::string& name, const CheckerHandle& checker,
                      const JointTrajectory& trajectory, const std::vector<TaskChange>& changes,
                      const TrajectoryCertificate* certificate,
                      const std::vector<std::string>& warnings) {
  PhaseHandle made{.robot = checker.robot(),
                   .phase = {.name = name,
                             .checker = checker.shared(),
                             .trajectory = trajectory,
                             .certificate = {},
                             .changes = changes,
                             .warnings = warnings}};
  made.isProven = certificate != nullptr && certificate->world && certificate->self;
  if (made.isProven) made.phase.certificate = *certificate;
  return made;
}

void bindChange(py::module_& module) {
  py::class_<TaskChange> type(module, "TaskChange",
                              "How a body of one phase differs from that in the phase before.");
  type.def(py::init([](const py::object& kind, const std::string& body) {
             return TaskChange{changeKindOf(kind, "kind"), body};
           }),
           py::arg("kind"), py::arg("body"),
           "`kind`: ChangeKind. `body`: the name of an attached body, or of one of the world.")
      .def_property_readonly(
          "kind", [](const TaskChange& self) { return toPython(self.kind); }, "ChangeKind.")
      .def_readonly("body", &TaskChange::body, "Its name.");
  addRepr(type, {"kind", "body"});
  addImmutableCopies(type);
}

void bindPhase(py::module_& module) {
  py::class_<PhaseHandle> type(
      module, "TaskPhase",
      "A phase of a task: a trajectory, and the checker under which it is proven. Immutable.");
  type.def(py::init(&makePhase), py::arg("name"), py::arg("checker"), py::arg("trajectory"),
           py::arg("changes") = std::vector<TaskChange>(), py::kw_only(),
           py::arg("certificate") = nullptr, py::arg("warnings") = std::vector<std::string>(),
           "`name`: for people. `checker`: robot, group, world and attached bodies. `trajectory`: "
           "on "
           "the clock of the task, its first time is the last\none of the phase before: see "
           "Trajectory.delayed. `changes`: a list of TaskChange since the phase before; no other "
           "body may differ.\n`certificate`: of Checker.certify_trajectory with `clearances`, for "
           "the same trajectory; without one, write_task asks. `warnings`: of the\nfiles of robot "
           "and world, to be written beside the proof.")
      .def_property_readonly(
          "name", [](const PhaseHandle& self) { return self.phase.name; }, "For people.")
      .def_property_readonly(
          "checker",
          [](const PhaseHandle& self) {
            return std::make_unique<CheckerHandle>(self.robot, self.phase.checker);
          },
          "Checker under which it is proven.")
      .def_property_readonly(
          "trajectory", [](const PhaseHandle& self) { return self.phase.trajectory; },
          "Trajectory, on the clock of the task.")
      .def_property_readonly(
          "changes",
          [](const PhaseHandle& self) { return py::tuple(py::cast(self.phase.changes)); },
          "A TaskChange each, since the phase before.")
      .def_property_readonly(
          "warnings",
          [](const PhaseHandle& self) { return py::tuple(py::cast(self.phase.warnings)); },
          "Written beside the proof.");
  addRepr(type, {"name", "trajectory", "changes"});
  addImmutableCopies(type);
}

void write(const std::filesystem::path& file, const std::vector<PhaseHandle>& phases,
           const Token& cancel) {
  requireWritten(watched(cancel, [&](const std::stop_token& stop) {
    std::vector<TaskPhase> all;
    for (const PhaseHandle& one : phases) {
      all.push_back(one.phase);
      if (one.isProven || stop.stop_requested()) continue;  // writeTask() looks at it
      const Checker& checker = *one.phase.checker;
      Workspace workspace(checker);
      all.back().certificate = checker.certifyTrajectory(
          controllerCurve(one.phase.trajectory), workspace, {.limits = {}, .clearances = true});
    }
    return writeTask(file, all, stop);
  }));
}

void bindChecked(py::module_& module) {
  py::class_<CheckedPhase> phase(module, "CheckedPhase", "A phase of a task whose proof holds.");
  phase.def_readonly("name", &CheckedPhase::name, "As written.")
      .def_readonly("group", &CheckedPhase::group, "Of the joints that move.")
      .def_readonly("begin", &CheckedPhase::begin, "s, on the clock of the task.")
      .def_readonly("end", &CheckedPhase::end, "s, likewise.")
      .def_property_readonly(
          "changes", [](const CheckedPhase& self) { return py::tuple(py::cast(self.changes)); },
          "Since the phase before, in words: `cup attached to hand`.")
      .def_readonly("proof", &CheckedPhase::proof, "CheckedProof of the phase alone; it holds.");
  addRepr(phase, {"name", "group", "begin", "end", "changes"});
  addImmutableCopies(phase);

  py::class_<CheckedTask> task(
      module, "CheckedTask",
      "The result of checking a task. True if the proof of each phase holds, and the phases join.");
  task.def_property_readonly("holds", &CheckedTask::holds, "Whether the file's claims are proven.")
      .def_readonly("refusal", &CheckedTask::refusal,
                    "The first place where it does not hold; empty: it holds.")
      .def_property_readonly(
          "phases", [](const CheckedTask& self) { return py::tuple(py::cast(self.phases)); },
          "A CheckedPhase each, if it holds; else empty.")
      .def("__bool__", &CheckedTask::holds);
  addRepr(task, {"holds", "refusal", "phases"});
  addImmutableCopies(task);

  py::class_<TaskStep> step(module, "TaskStep",
                            "A phase of a task file, as a controller needs it.");
  step.def_readonly("name", &TaskStep::name, "As written.")
      .def_readonly("group", &TaskStep::group, "Of the joints that move.")
      .def_readonly("trajectory", &TaskStep::trajectory, "Trajectory, on the clock of the task.")
      .def_property_readonly(
          "changes", [](const TaskStep& self) { return py::tuple(py::cast(self.changes)); },
          "A TaskChange each, before it begins.");
  addRepr(step, {"name", "group", "trajectory", "changes"});
  addImmutableCopies(step);
}

}  // namespace

void bindTasks(py::module_& module) {
  bindChange(module);
  bindPhase(module);
  bindChecked(module);
  py::class_<JointTrajectory>(module.attr("Trajectory"))
      .def(
          "delayed",
          [](const JointTrajectory& self, double seconds) {
            JointTrajectory later = delayed(self, seconds);
            controllerCurve(later);  // throws for what is no trajectory
            return later;
          },
          py::arg("seconds"),
          "The same with all times later by `seconds`. Raises ArgumentError for a time before 0.");
  module.def(
      "write_task", &write, py::arg("file"), py::arg("phases"), py::kw_only(),
      py::arg("cancel") = py::none(),
      "Writes a task, a list of TaskPhase one after the other, with the proof of each as "
      "write_trajectory_proof to one .json file, which can be\nchecked without any other: "
      "`verify_task`, or `swept verify`. The file is written completely or not at all. Raises "
      "UsageError for phases\nthat do not join, with the difference, for no phase, and for one "
      "that is not FREE or for which no proof was found.\nCtrl-C and `cancel`, a "
      "CancellationToken, end it, and there is no file: "
      "KeyboardInterrupt, Cancelled.");
  module.def(
      "verify_task",
      [](const std::filesystem::path& file, const Token& cancel) {
        return watched(cancel, [&](const std::stop_token& stop) { return verifyTask(file, stop); });
      },
      py::arg("file"), py::kw_only(), py::arg("cancel") = py::none(),
      "CheckedTask of a file of write_task, by a checker that shares no code with what found the "
      "proofs: whether each holds, and whether the\nphases join. All have the same robot; each "
      "begins where, when and as fast as the one before ends; each body is as before, but for the\n"
      "changes that the file states. Raises InputError for a file that is no task. `cancel` as of "
      "write_task.");
  module.def(
      "read_task",
      [](const std::filesystem::path& file) {
        const py::gil_scoped_release others;
        return readTask(file);
      },
      py::arg("file"),
      "A list of TaskStep: the phases of a file of write_task, whose proofs it does not look at. "
      "Raises InputError for a file that is no task.");
}

}  // namespace swept::python
