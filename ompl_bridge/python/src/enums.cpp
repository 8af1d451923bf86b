// SPDX-License-Identifier: BSD-3-Clause
#include "enums.hpp"

#include <array>
#include <string>

#include "errors.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

/// A class of swept/enums.py with its members, by value. It lives as long as the process.
template <std::size_t kCount>
struct Enumeration {
  explicit Enumeration(const char* ofEnums) : name(ofEnums) {
    type = py::object(py::module_::import("swept.enums").attr(name)).release();
    for (std::size_t i = 0; i < kCount; ++i) members[i] = type(i).release();
  }
  py::object member(std::size_t value) const {
    return py::reinterpret_borrow<py::object>(members[value]);
  }
  std::size_t valueOf(py::handle value, const char* argument) const {
    for (std::size_t i = 0; i < kCount; ++i)
      if (members[i].is(value)) return i;
    throw ArgumentTypeError(std::string(argument) + ": expected a member of swept." + name +
                            ", got " + std::string(py::repr(value)));
  }

  const char* name;
  py::handle type;
  std::array<py::handle, kCount> members;
};

const Enumeration<2>& motionQueries() {
  static const Enumeration<2> found("MotionQuery");
  return found;
}

const Enumeration<4>& clearanceQueries() {
  static const Enumeration<4> found("ClearanceQuery");
  return found;
}

const Enumeration<3>& changeKinds() {
  static const Enumeration<3> found("ChangeKind");
  return found;
}

}  // namespace

py::object toPython(Verdict verdict) {
  static const Enumeration<4> found("Verdict");
  return found.member(static_cast<std::size_t>(verdict));
}

py::object toPython(LimitKind kind) {
  static const Enumeration<4> found("LimitKind");
  return found.member(static_cast<std::size_t>(kind));
}

py::object toPython(ConstraintViolation::Kind kind) {
  static const Enumeration<4> found("ConstraintKind");
  return found.member(static_cast<std::size_t>(kind));
}

py::object toPython(ToolLineStop::Reason reason) {
  static const Enumeration<7> found("LineStop");
  return found.member(static_cast<std::size_t>(reason));
}

py::object toPython(TaskChange::Kind kind) {
  return changeKinds().member(static_cast<std::size_t>(kind));
}

py::object toPython(PlannedSchedule::Status status) {
  static const Enumeration<5> found("ScheduleStatus");
  return found.member(static_cast<std::size_t>(status));
}

MotionQuery motionQueryOf(py::handle value, const char* argument) {
  return static_cast<MotionQuery>(motionQueries().valueOf(value, argument));
}

ClearanceQuery clearanceQueryOf(py::handle value, const char* argument) {
  return static_cast<ClearanceQuery>(clearanceQueries().valueOf(value, argument));
}

EnclosingKind enclosingKindOf(py::handle value, const char* argument) {
  static const Enumeration<3> found("EnclosingKind");
  return static_cast<EnclosingKind>(found.valueOf(value, argument));
}

TaskChange::Kind changeKindOf(py::handle value, const char* argument) {
  return static_cast<TaskChange::Kind>(changeKinds().valueOf(value, argument));
}

}  // namespace swept::python
