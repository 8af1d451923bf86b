// SPDX-License-Identifier: BSD-3-Clause
#include "arrays.hpp"

#define NPY_NO_DEPRECATED_API NPY_1_7_API_VERSION
#include <numpy/arrayobject.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <string>

#include "errors.hpp"

namespace py = pybind11;

namespace swept::python {
namespace {

/// (7,) or (n, 7); 0 stands for any number.
std::string shapeText(std::size_t rows, std::size_t columns, bool isVector) {
  const std::string count = columns > 0 ? std::to_string(columns) : "m";
  if (isVector) return "(" + count + ",)";
  return "(" + (rows > 0 ? std::to_string(rows) : "n") + ", " + count + ")";
}

std::string shapeOf(PyArrayObject* array) {
  std::string text = "(";
  const int dimensions = PyArray_NDIM(array);
  for (int i = 0; i < dimensions; ++i)
    text += (i > 0 ? ", " : "") + std::to_string(PyArray_DIM(array, i));
  return text + (dimensions == 1 ? ",)" : ")");
}

std::string typeOf(PyArrayObject* array) {
  return py::str(
      py::reinterpret_borrow<py::object>(reinterpret_cast<PyObject*>(PyArray_DESCR(array))));
}

std::string expectation(const char* argument, const std::string& shape) {
  return std::string(argument) + ": expected finite float64 values of shape " + shape +
         ", C-contiguous; got ";
}

[[noreturn]] void refuseType(py::handle value, const char* argument, const std::string& shape) {
  throw ArgumentTypeError(expectation(argument, shape) + "an object of type " +
                          Py_TYPE(value.ptr())->tp_name);
}

/// An exponent of ones, that of infinities and NaN, carries into the sign's place where one is
/// added. Sums and bits are as fast as memory on every processor; comparisons of floats, and of
/// integers of 64 bits without SSE4, take several times as long.
bool allFinite(const double* values, std::size_t count) {
  constexpr std::uint64_t kExponent = 0x7ff0000000000000, kOne = std::uint64_t{1} << 52U;
  std::uint64_t carries = 0;
  for (std::size_t i = 0; i < count; ++i) {
    std::uint64_t bits = 0;
    std::memcpy(&bits, values + i, sizeof bits);
    carries |= (bits & kExponent) + kOne;
  }
  return (carries >> 63U) == 0;
}

[[noreturn]] void refuseValue(const double* values, std::size_t columns, bool isVector,
                              const char* argument, const std::string& shape) {
  std::size_t i = 0;
  while (std::isfinite(values[i])) ++i;
  std::ostringstream text;
  text << expectation(argument, shape) << values[i] << " at ";
  if (isVector)
    text << '[' << i << ']';
  else
    text << '[' << i / columns << ", " << i % columns << ']';
  throw std::invalid_argument(text.str());
}

/// Throws unless it is an array that can be read in place.
void requireArray(PyArrayObject* array, const char* argument, std::size_t rows, std::size_t columns,
                  bool isVector) {
  const auto got = [&] {
    return expectation(argument, shapeText(rows, columns, isVector)) + typeOf(array) +
           " of shape " + shapeOf(array);
  };
  if (PyArray_TYPE(array) != NPY_DOUBLE || PyArray_ISBYTESWAPPED(array))
    throw ArgumentTypeError(got());
  const int dimensions = isVector ? 1 : 2;
  const bool fits =
      PyArray_NDIM(array) == dimensions &&
      (columns == 0 || PyArray_DIM(array, dimensions - 1) == static_cast<npy_intp>(columns)) &&
      (rows == 0 || PyArray_DIM(array, 0) == static_cast<npy_intp>(rows));
  if (!fits) throw std::invalid_argument(got());
  if (!PyArray_ISCARRAY_RO(array))
    throw std::invalid_argument(got() + ", not C-contiguous: numpy.ascontiguousarray makes it so");
}

bool isList(PyObject* value) {
  return PyList_Check(value) || PyTuple_Check(value);
}

/// An array of the numbers in a list.
py::object arrayOfList(py::handle value, const char* argument, const std::string& shape) {
  PyObject* array = PyArray_FROM_OTF(value.ptr(), NPY_DOUBLE, NPY_ARRAY_CARRAY_RO);
  if (array == nullptr) {
    const py::error_already_set error;
    throw ArgumentTypeError(expectation(argument, shape) + "a " + Py_TYPE(value.ptr())->tp_name +
                            ": " + std::string(py::str(error.value())));
  }
  return py::reinterpret_steal<py::object>(array);
}

Table read(py::handle value, const char* argument, std::size_t rows, std::size_t columns,
           bool isVector) {
  const std::string shape = shapeText(rows, columns, isVector);
  py::object owner = py::reinterpret_borrow<py::object>(value);
  if (isList(value.ptr()))
    owner = arrayOfList(value, argument, shape);
  else if (!PyArray_Check(value.ptr()))
    refuseType(value, argument, shape);
  auto* array = reinterpret_cast<PyArrayObject*>(owner.ptr());
  requireArray(array, argument, isVector ? 0 : rows, columns, isVector);
  const auto* data = static_cast<const double*>(PyArray_DATA(array));
  const auto count = static_cast<std::size_t>(PyArray_SIZE(array));
  const auto width = static_cast<std::size_t>(PyArray_DIM(array, isVector ? 0 : 1));
  if (!allFinite(data, count)) refuseValue(data, width, isVector, argument, shape);
  return {data, isVector ? 1 : static_cast<std::size_t>(PyArray_DIM(array, 0)), width,
          std::move(owner)};
}

py::object newArray(int dimensions, npy_intp* shape, int type) {
  PyObject* array = PyArray_SimpleNew(dimensions, shape, type);
  if (array == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::object>(array);
}

void* memoryOf(const py::object& array) {
  return PyArray_DATA(reinterpret_cast<PyArrayObject*>(array.ptr()));
}

double* doublesOf(const py::object& array) {
  return static_cast<double*>(memoryOf(array));
}

py::object newTable(std::size_t rows, std::size_t columns) {
  npy_intp shape[] = {static_cast<npy_intp>(rows), static_cast<npy_intp>(columns)};
  return newArray(2, shape, NPY_DOUBLE);
}

py::object view(const void* first, std::size_t size, std::size_t stride, int type,
                py::object owner) {
  npy_intp shape = static_cast<npy_intp>(size);
  npy_intp step = static_cast<npy_intp>(stride);
  PyObject* array =
      PyArray_New(&PyArray_Type, 1, &shape, type, &step, const_cast<void*>(first), 0, 0, nullptr);
  if (array == nullptr) throw py::error_already_set();
  py::object result = py::reinterpret_steal<py::object>(array);
  // Takes the reference, also if it fails.
  if (PyArray_SetBaseObject(reinterpret_cast<PyArrayObject*>(array), owner.release().ptr()) != 0)
    throw py::error_already_set();
  return result;
}

int loadInterface() {
  import_array1(-1);
  return 0;
}

}  // namespace

void importNumpy() {
  if (loadInterface() != 0) throw py::error_already_set();
}

std::vector<ConfigurationView> Table::list() const {
  std::vector<ConfigurationView> result;
  result.reserve(rows_);
  for (std::size_t i = 0; i < rows_; ++i) result.push_back(row(i));
  return result;
}

std::vector<Eigen::Vector3d> Table::points() const {
  std::vector<Eigen::Vector3d> result(rows_);
  for (std::size_t i = 0; i < rows_; ++i) result[i] = Eigen::Vector3d(data_ + 3 * i);
  return result;
}

Table readVector(py::handle value, const char* argument, std::size_t size) {
  return read(value, argument, 0, size, true);
}

Table readTable(py::handle value, const char* argument, std::size_t columns) {
  return read(value, argument, 0, columns, false);
}

ConfigurationView readConfiguration(PyObject* value, const char* argument, std::size_t size,
                                    std::vector<double>& copy) {
  if (PyArray_Check(value)) {
    auto* array = reinterpret_cast<PyArrayObject*>(value);
    if (PyArray_TYPE(array) == NPY_DOUBLE && PyArray_NDIM(array) == 1 &&
        PyArray_DIM(array, 0) == static_cast<npy_intp>(size) && PyArray_ISCARRAY_RO(array)) {
      const auto* data = static_cast<const double*>(PyArray_DATA(array));
      if (allFinite(data, size)) return {data, size};
    }
  }
  const Table table = readVector(value, argument, size);
  copy.assign(table.numbers().begin(), table.numbers().end());
  return copy;
}

std::vector<std::uint32_t> readIndices(py::handle value, const char* argument, std::size_t columns,
                                       std::size_t end) {
  const std::string expected = std::string(argument) + ": expected integers of shape (m, " +
                               std::to_string(columns) + "), C-contiguous; got ";
  py::object owner = py::reinterpret_borrow<py::object>(value);
  if (isList(value.ptr())) {
    owner = py::reinterpret_steal<py::object>(
        PyArray_FROM_OTF(value.ptr(), NPY_INT64, NPY_ARRAY_CARRAY_RO));
    if (!owner) {
      const py::error_already_set error;
      throw ArgumentTypeError(expected + "a " + Py_TYPE(value.ptr())->tp_name);
    }
  } else if (!PyArray_Check(value.ptr())) {
    throw ArgumentTypeError(expected + "an object of type " + Py_TYPE(value.ptr())->tp_name);
  }
  auto* array = reinterpret_cast<PyArrayObject*>(owner.ptr());
  const std::string got = expected + typeOf(array) + " of shape " + shapeOf(array);
  if (!PyArray_ISINTEGER(array)) throw ArgumentTypeError(got);
  if (PyArray_NDIM(array) != 2 || PyArray_DIM(array, 1) != static_cast<npy_intp>(columns))
    throw std::invalid_argument(got);
  const py::object wide = py::reinterpret_steal<py::object>(
      PyArray_FROM_OTF(owner.ptr(), NPY_INT64, NPY_ARRAY_CARRAY_RO | NPY_ARRAY_FORCECAST));
  if (!wide) throw py::error_already_set();
  const auto* given = static_cast<const std::int64_t*>(memoryOf(wide));
  std::vector<std::uint32_t> indices(static_cast<std::size_t>(PyArray_DIM(array, 0)) * columns);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    if (given[i] < 0 || static_cast<std::uint64_t>(given[i]) >= end)
      throw std::invalid_argument(std::string(argument) + ": expected indices from 0 to " +
                                  std::to_string(end) + " - 1; got " + std::to_string(given[i]) +
                                  " at [" + std::to_string(i / columns) + ", " +
                                  std::to_string(i % columns) + "]");
    indices[i] = static_cast<std::uint32_t>(given[i]);
  }
  return indices;
}

std::vector<Eigen::Vector3i> readTriangles(py::handle value, const char* argument,
                                           std::size_t end) {
  const std::vector<std::uint32_t> indices = readIndices(value, argument, 3, end);
  std::vector<Eigen::Vector3i> triangles(indices.size() / 3);
  for (std::size_t i = 0; i < indices.size(); ++i)
    triangles[i / 3][static_cast<Eigen::Index>(i % 3)] = static_cast<int>(indices[i]);
  return triangles;
}

Eigen::Vector3d readPoint(py::handle value, const char* argument) {
  return Eigen::Vector3d(readVector(value, argument, 3).numbers().data());
}

Eigen::Isometry3d readPose(py::handle value, const char* argument) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (value.is_none()) return pose;
  const Table table = read(value, argument, 4, 4, false);
  const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> matrix(
      table.numbers().data());
  if (matrix.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    throw std::invalid_argument(std::string(argument) +
                                ": expected a pose, whose last row is 0 0 0 1");
  pose.matrix() = matrix;
  return pose;
}

py::object makeDoubles(std::size_t size, double*& memory) {
  npy_intp shape = static_cast<npy_intp>(size);
  py::object array = newArray(1, &shape, NPY_DOUBLE);
  memory = doublesOf(array);
  return array;
}

py::object makeBytes(std::size_t size, std::uint8_t*& memory) {
  npy_intp shape = static_cast<npy_intp>(size);
  py::object array = newArray(1, &shape, NPY_UINT8);
  memory = static_cast<std::uint8_t*>(memoryOf(array));
  return array;
}

py::object makeIndices(std::span<const std::uint32_t> values, std::size_t columns) {
  npy_intp shape[] = {static_cast<npy_intp>(values.size() / columns),
                      static_cast<npy_intp>(columns)};
  py::object array = newArray(2, shape, NPY_UINT32);
  std::ranges::copy(values, static_cast<std::uint32_t*>(memoryOf(array)));
  return array;
}

py::object makeArray(std::span<const double> values) {
  double* memory = nullptr;
  py::object array = makeDoubles(values.size(), memory);
  std::ranges::copy(values, memory);
  return array;
}

py::object makeArray(const Eigen::Vector3d& point) {
  return makeArray(std::span<const double>(point.data(), 3));
}

py::object makeArray(const Eigen::MatrixXd& matrix) {
  py::object array = newTable(matrix.rows(), matrix.cols());
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      doublesOf(array), matrix.rows(), matrix.cols()) = matrix;
  return array;
}

py::object makeArray(const Eigen::Isometry3d& pose) {
  return makeArray(Eigen::MatrixXd(pose.matrix()));
}

py::object makeArray(std::span<const std::vector<double>> rows, std::size_t columns) {
  py::object array = newTable(rows.size(), columns);
  double* memory = doublesOf(array);
  for (const std::vector<double>& row : rows) memory = std::ranges::copy(row, memory).out;
  return array;
}

py::object makeArray(std::span<const Eigen::Vector3d> points) {
  py::object array = newTable(points.size(), 3);
  double* memory = doublesOf(array);
  for (const Eigen::Vector3d& point : points)
    memory = std::copy(point.data(), point.data() + 3, memory);
  return array;
}

py::object viewDoubles(const double* first, std::size_t size, std::size_t stride,
                       py::object owner) {
  return view(first, size, stride, NPY_DOUBLE, std::move(owner));
}

py::object viewBytes(const std::uint8_t* first, std::size_t size, std::size_t stride,
                     py::object owner) {
  return view(first, size, stride, NPY_UINT8, std::move(owner));
}

}  // namespace swept::python
