// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <exception>
#include <stdexcept>
#include <string>

namespace swept::python {

/// An argument of a type that cannot be used; swept.ArgumentTypeError. One with a wrong value is a
/// std::invalid_argument, as in the library: swept.ArgumentError.
class ArgumentTypeError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// `value` as a T. Throws ArgumentTypeError: `ARGUMENT: expected EXPECTED, got VALUE`.
template <typename T>
T valueOf(const pybind11::handle& value, const char* argument, const char* expected) {
  try {
    return value.cast<T>();
  } catch (const pybind11::cast_error&) {
    throw ArgumentTypeError(std::string(argument) + ": expected " + expected + ", got " +
                            std::string(pybind11::repr(value)));
  }
}

/// Work that a token or a deadline ended; swept.Cancelled.
class Cancelled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Makes every function of the module raise the exceptions of swept/errors.py. Call it first.
void registerErrors();

/// Sets the exception of Python for one of C++, with its message. Needs the GIL.
void setPythonError(const std::exception_ptr& error);

/// A function of C++ as one of METH_FASTCALL: exceptions become Python's.
template <auto kFunction>
PyObject* fastCall(PyObject* self, PyObject* const* arguments, Py_ssize_t count,
                   PyObject* names) noexcept {
  try {
    return kFunction(self, arguments, count, names);
  } catch (...) {
    setPythonError(std::current_exception());
    return nullptr;
  }
}

}  // namespace swept::python
