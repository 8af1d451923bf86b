// SPDX-License-Identifier: BSD-3-Clause
#include "errors.hpp"

#include <ompl/util/Exception.h>

#include "swept/robot_model/foreign_text.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

/// The classes of swept/errors.py. They live as long as the process, as the module does.
struct Classes {
  py::handle argument, argumentType, input, usage, cancelled;
};

const Classes& classes() {
  static const Classes found = [] {
    const py::module_ errors = py::module_::import("swept.errors");
    const auto take = [&](const char* name) { return py::object(errors.attr(name)).release(); };
    return Classes{.argument = take("ArgumentError"),
                   .argumentType = take("ArgumentTypeError"),
                   .input = take("InputError"),
                   .usage = take("UsageError"),
                   .cancelled = take("Cancelled")};
  }();
  return found;
}

// Names in files need not be UTF-8, and a message must not be lost over one.
py::object textOf(const std::string& text) {
  return py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "backslashreplace"));
}

void set(py::handle type, const std::string& message) {
  PyErr_SetObject(type.ptr(), textOf(message).ptr());
}

void setInputError(const InputError& error) {
  const py::object value = classes().input(textOf(error.what()));
  value.attr("file") = textOf(error.file());
  value.attr("line") = error.line();
  value.attr("message") = textOf(error.message());
  PyErr_SetObject(classes().input.ptr(), value.ptr());
}

/// Exceptions that the module knows; others pass.
void translate(std::exception_ptr error) {
  try {
    if (error) std::rethrow_exception(error);
  } catch (const InputError& known) {
    setInputError(known);
  } catch (const UsageError& known) {
    set(classes().usage, known.what());
  } catch (const Cancelled& known) {
    set(classes().cancelled, known.what());
  } catch (const ArgumentTypeError& known) {
    set(classes().argumentType, known.what());
  } catch (const std::invalid_argument& known) {
    set(classes().argument, known.what());
  } catch (const ompl::Exception& known) {
    set(classes().usage, foreignText(known.what()));
  }
}

}  // namespace

void registerErrors() {
  classes();
  py::register_exception_translator(&translate);
}

void setPythonError(const std::exception_ptr& error) {
  try {
    try {
      translate(error);
    } catch (py::error_already_set& raised) {
      raised.restore();
    } catch (const py::builtin_exception& raised) {
      raised.set_error();
    }
  } catch (const std::bad_alloc&) {
    PyErr_NoMemory();
  } catch (const std::exception& other) {
    PyErr_SetString(PyExc_RuntimeError, other.what());
  }
}

}  // namespace swept::python
