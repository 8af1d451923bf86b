// SPDX-License-Identifier: BSD-3-Clause
#include "certificates.hpp"

#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

#include "arrays.hpp"
#include "binding.hpp"
#include "enums.hpp"
#include "errors.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

struct CertificateObject {
  PyObject_HEAD MotionCertificate value;
};

PyTypeObject* certificateType = nullptr;  // since bindCertificates()

const MotionCertificate& valueOf(PyObject* self) {
  return reinterpret_cast<CertificateObject*>(self)->value;
}

void destroy(PyObject* self) {
  PyTypeObject* type = Py_TYPE(self);
  std::destroy_at(&reinterpret_cast<CertificateObject*>(self)->value);
  type->tp_free(self);
  Py_DECREF(type);
}

/// A property, as PyGetSetDef has it.
template <auto kGet>
PyObject* property(PyObject* self, void*) noexcept {
  try {
    return kGet(valueOf(self)).release().ptr();
  } catch (...) {
    setPythonError(std::current_exception());
    return nullptr;
  }
}

py::object verdict(const MotionCertificate& value) {
  return toPython(value.verdict);
}
py::object freeUntil(const MotionCertificate& value) {
  return py::float_(value.freeUntil);
}
py::object undecidedAt(const MotionCertificate& value) {
  if (value.verdict != Verdict::Undecided) return py::none();
  return py::float_(value.undecidedAt);
}
py::object witness(const MotionCertificate& value) {
  if (!value.witness) return py::none();
  return py::cast(*value.witness);
}
py::object violation(const MotionCertificate& value) {
  if (!value.violation) return py::none();
  return py::cast(*value.violation);
}
py::object effort(const MotionCertificate& value) {
  return py::cast(value.effort);
}

PyGetSetDef properties[] = {
    {"verdict", &property<&verdict>, nullptr, "Verdict of the whole motion.", nullptr},
    {"free_until", &property<&freeUntil>, nullptr,
     "Largest proven t in [0, 1]: until then all is free. 1 if the verdict is FREE.", nullptr},
    {"witness", &property<&witness>, nullptr,
     "Witness of the contact, exactly if the verdict is COLLISION; else None.", nullptr},
    {"violation", &property<&violation>, nullptr,
     "ConstraintViolation, exactly if the verdict is VIOLATION; else None.", nullptr},
    {"undecided_at", &property<&undecidedAt>, nullptr,
     "Start of the first interval that could not be proven, exactly if the verdict is UNDECIDED; "
     "else None.",
     nullptr},
    {"effort", &property<&effort>, nullptr, "Effort that the answer took.", nullptr},
    {}};

int isFree(PyObject* self) {
  return valueOf(self).verdict == Verdict::Free ? 1 : 0;
}

PyObject* describe(PyObject* self) {
  const MotionCertificate& value = valueOf(self);
  std::string text = "<swept.MotionCertificate " + std::string(toString(value.verdict)) +
                     ", free until t = " + std::string(py::str(py::float_(value.freeUntil)));
  if (value.witness)
    text += ", contact at t = " + std::string(py::str(py::float_(value.witness->t))) + " of " +
            value.witness->bodyA.str() + " and " + value.witness->bodyB.str();
  if (value.violation)
    text += ", violation at t = " + std::string(py::str(py::float_(value.violation->t)));
  return PyUnicode_FromString((text + ">").c_str());
}

PyObject* itself(PyObject* self, PyObject*) {
  Py_INCREF(self);
  return self;
}

PyMethodDef methods[] = {
    {"__copy__", &itself, METH_NOARGS, nullptr}, {"__deepcopy__", &itself, METH_O, nullptr}, {}};

constexpr const char* kDoc =
    "What is proven about a motion q(t), t in [0, 1]. It is true if the verdict is FREE.";

PyType_Slot slots[] = {{Py_tp_dealloc, reinterpret_cast<void*>(&destroy)},
                       {Py_tp_getset, properties},
                       {Py_tp_methods, methods},
                       {Py_tp_repr, reinterpret_cast<void*>(&describe)},
                       {Py_nb_bool, reinterpret_cast<void*>(&isFree)},
                       {Py_tp_doc, const_cast<char*>(kDoc)},
                       {0, nullptr}};

PyType_Spec specification = {"swept.MotionCertificate", sizeof(CertificateObject), 0,
                             Py_TPFLAGS_DEFAULT | Py_TPFLAGS_DISALLOW_INSTANTIATION, slots};

py::object itemOf(const CertificateList& self, py::ssize_t index) {
  const auto size = static_cast<py::ssize_t>(self.certificates.size());
  const py::ssize_t place = index < 0 ? index + size : index;
  if (place < 0 || place >= size)
    throw py::index_error("certificate " + std::to_string(index) + " of " + std::to_string(size));
  return makeCertificate(MotionCertificate(self.certificates[static_cast<std::size_t>(place)]));
}

void bindList(py::module_& module) {
  py::class_<CertificateList>(
      module, "MotionCertificates",
      "The certificates of a batch of motions, in their order. An item is a MotionCertificate. The "
      "arrays are read-only views.")
      .def("__len__", [](const CertificateList& self) { return self.certificates.size(); })
      .def("__getitem__", &itemOf, py::arg("index"))
      .def("__iter__",
           [](const py::object& self) {
             return py::reinterpret_steal<py::object>(PySeqIter_New(self.ptr()));
           })
      .def_property_readonly(
          "verdicts",
          [](const py::object& self) {
            const auto& all = self.cast<const CertificateList&>().certificates;
            static_assert(sizeof(Verdict) == 1);
            const Verdict* first = all.empty() ? nullptr : &all.front().verdict;
            return viewBytes(reinterpret_cast<const std::uint8_t*>(first), all.size(),
                             sizeof(MotionCertificate), self);
          },
          "(n,) uint8, values of Verdict.")
      .def_property_readonly(
          "free_until",
          [](const py::object& self) {
            const auto& all = self.cast<const CertificateList&>().certificates;
            return viewDoubles(all.empty() ? nullptr : &all.front().freeUntil, all.size(),
                               sizeof(MotionCertificate), self);
          },
          "(n,) largest proven t of each motion.")
      .def("__repr__", [](const CertificateList& self) {
        std::size_t free = 0;
        for (const MotionCertificate& one : self.certificates)
          free += one.verdict == Verdict::Free ? 1 : 0;
        return "<swept.MotionCertificates of " + std::to_string(self.certificates.size()) +
               " motions, " + std::to_string(free) + " free>";
      });
}

}  // namespace

py::object makeCertificate(MotionCertificate&& certificate) {
  PyObject* self = certificateType->tp_alloc(certificateType, 0);
  if (self == nullptr) throw py::error_already_set();
  new (&reinterpret_cast<CertificateObject*>(self)->value)
      MotionCertificate(std::move(certificate));
  return py::reinterpret_steal<py::object>(self);
}

const MotionCertificate& certificateOf(py::handle value, const char* argument) {
  if (Py_TYPE(value.ptr()) != certificateType)
    throw ArgumentTypeError(std::string(argument) + ": expected a swept.MotionCertificate, got " +
                            std::string(py::repr(value)));
  return valueOf(value.ptr());
}

void bindCertificates(py::module_& module) {
  PyObject* type = PyType_FromSpec(&specification);
  if (type == nullptr) throw py::error_already_set();
  certificateType = reinterpret_cast<PyTypeObject*>(type);
  module.add_object("MotionCertificate", type);
  bindList(module);
}

}  // namespace swept::python
