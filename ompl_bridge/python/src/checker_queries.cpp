// SPDX-License-Identifier: BSD-3-Clause
#include "checker_queries.hpp"

#include <pybind11/stl.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "arrays.hpp"
#include "certificates.hpp"
#include "enums.hpp"
#include "errors.hpp"
#include "swept/robot_model/checker.hpp"
#include "watch.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

/// The checker behind `self`, which Python has checked to be a swept.Checker.
CheckerHandle& handleOf(PyObject* self) {
  // What pybind11's cast ends in, without its search for a type that is known here.
  auto* instance = reinterpret_cast<py::detail::instance*>(self);
  if (instance->simple_layout && instance->simple_value_holder[0] != nullptr)
    return *static_cast<CheckerHandle*>(instance->simple_value_holder[0]);
  return py::cast<CheckerHandle&>(py::handle(self));
}

/// The arguments of a METH_FASTCALL function by name; a missing one is null. Throws
/// ArgumentTypeError as Python itself would.
template <std::size_t kCount>
std::array<PyObject*, kCount> argumentsOf(const char* function,
                                          const std::array<const char*, kCount>& names,
                                          std::size_t required, PyObject* const* given,
                                          Py_ssize_t count, PyObject* keywords) {
  std::array<PyObject*, kCount> found{};
  const auto refuse = [&](const std::string& why) {
    throw ArgumentTypeError(std::string(function) + "() " + why);
  };
  if (static_cast<std::size_t>(count) > kCount)
    refuse("takes " + std::to_string(kCount) + " arguments, not " + std::to_string(count));
  for (Py_ssize_t i = 0; i < count; ++i) found[i] = given[i];
  const Py_ssize_t named = keywords == nullptr ? 0 : PyTuple_GET_SIZE(keywords);
  for (Py_ssize_t i = 0; i < named; ++i) {
    PyObject* const name = PyTuple_GET_ITEM(keywords, i);
    std::size_t place = 0;
    while (place < kCount && PyUnicode_CompareWithASCIIString(name, names[place]) != 0) ++place;
    if (place == kCount) refuse("has no argument '" + std::string(py::str(py::handle(name))) + "'");
    if (found[place] != nullptr) refuse("got '" + std::string(names[place]) + "' twice");
    found[place] = given[count + i];
  }
  for (std::size_t i = 0; i < required; ++i)
    if (found[i] == nullptr) refuse("needs the argument '" + std::string(names[i]) + "'");
  return found;
}

/// Others may run while a query runs. The same as py::gil_scoped_release, but for what that does
/// for interpreters that end.
class OthersRun {
 public:
  OthersRun() : thread_(PyEval_SaveThread()) {}
  OthersRun(const OthersRun&) = delete;
  OthersRun& operator=(const OthersRun&) = delete;
  ~OthersRun() { PyEval_RestoreThread(thread_); }

 private:
  PyThreadState* thread_;
};

constexpr const char* kCheckState =
    "check_state($self, /, q)\n--\n\n"
    "Verdict on a state q (n,). Proven, or witnessed; UNDECIDED within rounding of the margin, and "
    "with a prismatic value beyond\nits limits; VIOLATION, of a constraint, whether in contact or "
    "not.";

PyObject* checkState(PyObject* self, PyObject* const* given, Py_ssize_t count, PyObject* names) {
  const auto [value] = argumentsOf<1>("check_state", {"q"}, 1, given, count, names);
  CheckerHandle& handle = handleOf(self);
  std::vector<double> copy;
  const ConfigurationView q = readConfiguration(value, "q", handle.dimension(), copy);
  const CheckerHandle::Lease workspace(handle);
  Verdict verdict = Verdict::Undecided;
  {
    const OthersRun others;
    verdict = handle.checker().checkState(q, *workspace);
  }
  return toPython(verdict).release().ptr();
}

constexpr const char* kCertifyMotion =
    "certify_motion($self, /, start, end, query=MotionQuery.FIRST_CONTACT)\n--\n\n"
    "MotionCertificate of the straight motion from start (n,) to end (n,): what is proven about "
    "the "
    "whole of it.";

PyObject* certifyMotion(PyObject* self, PyObject* const* given, Py_ssize_t count, PyObject* names) {
  const auto [first, last, how] =
      argumentsOf<3>("certify_motion", {"start", "end", "query"}, 2, given, count, names);
  CheckerHandle& handle = handleOf(self);
  const MotionQuery query =
      how == nullptr ? MotionQuery::FirstContact : motionQueryOf(how, "query");
  std::vector<double> copyOfStart, copyOfEnd;
  const ConfigurationView start =
      readConfiguration(first, "start", handle.dimension(), copyOfStart);
  const ConfigurationView end = readConfiguration(last, "end", handle.dimension(), copyOfEnd);
  const CheckerHandle::Lease workspace(handle);
  MotionCertificate certificate;
  {
    const OthersRun others;
    certificate = handle.checker().certifyMotion(start, end, *workspace, query);
  }
  return makeCertificate(std::move(certificate)).release().ptr();
}

template <auto kFunction>
PyMethodDef fastMethod(const char* name, const char* doc) {
  auto* const function = &fastCall<kFunction>;
  return {name, reinterpret_cast<PyCFunction>(reinterpret_cast<void (*)()>(function)),
          METH_FASTCALL | METH_KEYWORDS, doc};
}

void addFastMethods(py::class_<CheckerHandle>& type) {
  static PyMethodDef methods[] = {fastMethod<&checkState>("check_state", kCheckState),
                                  fastMethod<&certifyMotion>("certify_motion", kCertifyMotion)};
  for (PyMethodDef& method : methods) {
    PyObject* made = PyDescr_NewMethod(reinterpret_cast<PyTypeObject*>(type.ptr()), &method);
    if (made == nullptr) throw py::error_already_set();
    type.attr(method.ml_name) = py::reinterpret_steal<py::object>(made);
  }
}

py::object checkStates(CheckerHandle& self, const py::object& states, unsigned threads,
                       std::optional<double> seconds, const Token& cancel) {
  const Watch watch(seconds, cancel);
  const std::size_t each = self.dimension();
  const Table table = readTable(states, "states", each);
  std::uint8_t* memory = nullptr;
  py::object result = makeBytes(table.rows(), memory);
  static_assert(sizeof(Verdict) == 1);
  const std::span<Verdict> verdicts(reinterpret_cast<Verdict*>(memory), table.rows());
  runBatch(table.rows(), watch, self.paceOfStates(), [&](const std::stop_token& stop) {
    self.checker().checkStates(table.numbers(), verdicts, threads, stop);
  });
  return result;
}

CertificateList certifyMotions(CheckerHandle& self, const py::object& starts,
                               const py::object& ends, const py::object& query, unsigned threads,
                               std::optional<double> seconds, const Token& cancel) {
  const Watch watch(seconds, cancel);
  const std::size_t each = self.dimension();
  const Table from = readTable(starts, "starts", each), to = readTable(ends, "ends", each);
  if (from.rows() != to.rows())
    throw std::invalid_argument("ends: expected as many rows as starts, " +
                                std::to_string(from.rows()) + "; got " + std::to_string(to.rows()));
  const MotionQuery how =
      query.is_none() ? MotionQuery::FirstContact : motionQueryOf(query, "query");
  CertificateList result{std::vector<MotionCertificate>(from.rows())};
  runBatch(from.rows(), watch, self.paceOfMotions(), [&](const std::stop_token& stop) {
    self.checker().certifyMotions(from.numbers(), to.numbers(), result.certificates, how, threads,
                                  stop);
  });
  return result;
}

void addBatches(py::class_<CheckerHandle>& type) {
  type.def("check_states", &checkStates, py::arg("states"), py::kw_only(), py::arg("threads") = 0,
           py::arg("seconds") = py::none(), py::arg("cancel") = py::none(),
           "(m,) uint8, values of Verdict, for states (m, n): compare with `== Verdict.FREE`. "
           "`threads`: of oneTBB, 0: as many as\nprocessors. Raises Cancelled after `seconds`, or "
           "when the token `cancel` is cancelled; Ctrl-C ends it, too.")
      .def("certify_motions", &certifyMotions, py::arg("starts"), py::arg("ends"),
           py::arg("query") = py::none(), py::kw_only(), py::arg("threads") = 0,
           py::arg("seconds") = py::none(), py::arg("cancel") = py::none(),
           "MotionCertificates of the motions from starts (m, n) to ends (m, n). `query`: "
           "MotionQuery, "
           "by default FIRST_CONTACT. The\nother arguments are those of check_states.");
}

/// A query with a workspace, without the GIL.
template <typename Query>
auto ask(CheckerHandle& self, Query&& query) {
  const CheckerHandle::Lease workspace(self);
  const OthersRun others;
  return query(self.checker(), *workspace);
}

py::object signedClearance(CheckerHandle& self, const py::object& q, bool gradient) {
  const Table at = readVector(q, "q", self.dimension());
  if (!gradient)
    return py::cast(ask(self, [&](const Checker& checker, Workspace& workspace) {
      return checker.signedClearance(at.row(0), workspace);
    }));
  double* memory = nullptr;
  const py::object derivatives = makeDoubles(at.columns(), memory);
  const SignedClearance found = ask(self, [&](const Checker& checker, Workspace& workspace) {
    return checker.signedClearance(at.row(0), workspace, ConfigurationSpan(memory, at.columns()));
  });
  return py::make_tuple(found, derivatives);
}

void addMeasures(py::class_<CheckerHandle>& type) {
  using Handle = CheckerHandle;
  type.def(
          "report_state",
          [](Handle& self, const py::object& q) {
            const Table at = readVector(q, "q", self.dimension());
            return ask(self, [&](const Checker& checker, Workspace& workspace) {
              return checker.reportState(at.row(0), workspace);
            });
          },
          py::arg("q"),
          "StateReport of q (n,): all violating pairs and the clearance. Takes tens to hundreds of "
          "times as\nlong as check_state.")
      .def(
          "clearance",
          [](Handle& self, const py::object& q) {
            const Table at = readVector(q, "q", self.dimension());
            return ask(self, [&](const Checker& checker, Workspace& workspace) {
              return checker.clearance(at.row(0), workspace);
            });
          },
          py::arg("q"),
          "m, proven lower bound of the least distance over all checked pairs at q (n,); 0 in "
          "contact. Takes\nten to twenty times as long as check_state.")
      .def("signed_clearance", &signedClearance, py::arg("q"), py::kw_only(),
           py::arg("gradient") = false,
           "SignedClearance at q (n,), negative in contact. With `gradient` a pair of it and an "
           "array "
           "(n,): the derivatives of the\nnearest pair's signed distance by the values of q (m per "
           "rad, m per m), zero where `normal` is.")
      .def(
          "motion_clearance",
          [](Handle& self, const py::object& start, const py::object& end, double accuracy,
             const py::object& query) {
            const Table from = readVector(start, "start", self.dimension());
            const Table to = readVector(end, "end", self.dimension());
            const ClearanceQuery how =
                query.is_none() ? ClearanceQuery::ByKind : clearanceQueryOf(query, "query");
            return ask(self, [&](const Checker& checker, Workspace& workspace) {
              return checker.motionClearance(from.row(0), to.row(0), accuracy, workspace, how);
            });
          },
          py::arg("start"), py::arg("end"), py::arg("accuracy") = 1e-3,
          py::arg("query") = py::none(),
          "MotionClearance over the motion from start (n,) to end (n,): upper - lower <= accuracy "
          "(m). "
          "`query`: ClearanceQuery, by\ndefault BY_KIND.")
      .def(
          "within_limits",
          [](const Handle& self, const py::object& q) {
            return self.checker().withinLimits(readVector(q, "q", self.dimension()).row(0));
          },
          py::arg("q"),
          "Whether each value of q (n,) is within its limits, or at most 1e-5 beyond.")
      .def(
          "interpolate",
          [](const Handle& self, const py::object& start, const py::object& end, double t) {
            const Table from = readVector(start, "start", self.dimension());
            const Table to = readVector(end, "end", self.dimension());
            double* memory = nullptr;
            py::object q = makeDoubles(self.dimension(), memory);
            self.checker().interpolate(from.row(0), to.row(0), t,
                                       ConfigurationSpan(memory, self.dimension()));
            return q;
          },
          py::arg("start"), py::arg("end"), py::arg("t"),
          "(n,) configuration at t in [0, 1] on the motion that certify_motion checks.");
}

}  // namespace

void addQueries(py::class_<CheckerHandle>& type) {
  addFastMethods(type);
  addBatches(type);
  addMeasures(type);
}

}  // namespace swept::python
