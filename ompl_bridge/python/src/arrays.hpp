// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "swept/robot_model/configuration.hpp"

/// Arrays of numpy, in and out. An array of float64 in C order is read where it is, without a copy;
/// lists and tuples of numbers are copied. Everything else is refused: std::invalid_argument for
/// shapes, orders in memory, NaN and infinity, ArgumentTypeError for other types. Messages name the
/// argument, what is expected, and what came.
namespace swept::python {

/// Loads numpy's interface. Call it before all else of this file.
void importNumpy();

/// A table of numbers: a row for each configuration, point, or whatever else.
class Table {
 public:
  /// Of `owner`'s memory, which stays as long as this lives.
  Table(const double* data, std::size_t rows, std::size_t columns, pybind11::object owner)
      : data_(data), rows_(rows), columns_(columns), owner_(std::move(owner)) {}

  std::size_t rows() const { return rows_; }        ///< 1 for a vector
  std::size_t columns() const { return columns_; }  ///< in each row
  /// All numbers, row after row.
  std::span<const double> numbers() const { return {data_, rows_ * columns_}; }
  /// One row.
  ConfigurationView row(std::size_t i) const { return {data_ + i * columns_, columns_}; }
  /// All rows.
  std::vector<ConfigurationView> list() const;
  /// All rows, as points.
  std::vector<Eigen::Vector3d> points() const;

 private:
  const double* data_;
  std::size_t rows_, columns_;
  pybind11::object owner_;
};

///@{
/// The numbers of an argument: (size,) and (n, columns). All are finite. `columns` 0: any number.
Table readVector(pybind11::handle value, const char* argument, std::size_t size);
Table readTable(pybind11::handle value, const char* argument, std::size_t columns);
///@}
/// The same numbers as readVector() for a query that takes less than a microsecond. An array is
/// borrowed from the caller, and a list is copied to `copy`.
ConfigurationView readConfiguration(PyObject* value, const char* argument, std::size_t size,
                                    std::vector<double>& copy);
/// (m, columns) indices, of any integer type, each from 0 to `end` - 1: row after row.
std::vector<std::uint32_t> readIndices(pybind11::handle value, const char* argument,
                                       std::size_t columns, std::size_t end);
/// The same of (m, 3).
std::vector<Eigen::Vector3i> readTriangles(pybind11::handle value, const char* argument,
                                           std::size_t end);
/// A point or direction (m): (3,).
Eigen::Vector3d readPoint(pybind11::handle value, const char* argument);
/// A pose: (4, 4), the last row 0 0 0 1. None: the identity. Whether it is rigid is for those to
/// find out who use it.
Eigen::Isometry3d readPose(pybind11::handle value, const char* argument);

///@{
/// New arrays: (n,), (3,), (4, 4), (rows, columns).
pybind11::object makeArray(std::span<const double> values);
pybind11::object makeArray(const Eigen::Vector3d& point);
pybind11::object makeArray(const Eigen::Isometry3d& pose);
pybind11::object makeArray(const Eigen::MatrixXd& matrix);
pybind11::object makeArray(std::span<const std::vector<double>> rows, std::size_t columns);
pybind11::object makeArray(std::span<const Eigen::Vector3d> points);
///@}
/// A new array of `size` float64 that has yet to be filled, and its memory.
pybind11::object makeDoubles(std::size_t size, double*& memory);
/// The same of uint8.
pybind11::object makeBytes(std::size_t size, std::uint8_t*& memory);
/// A new array of uint32, (m, columns).
pybind11::object makeIndices(std::span<const std::uint32_t> values, std::size_t columns);
///@{
/// A read-only view (n,) of numbers in memory of `owner`, which lives as long as the view; `stride`
/// bytes from one to the next.
pybind11::object viewDoubles(const double* first, std::size_t size, std::size_t stride,
                             pybind11::object owner);
pybind11::object viewBytes(const std::uint8_t* first, std::size_t size, std::size_t stride,
                           pybind11::object owner);
///@}

}  // namespace swept::python
