// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include "handles.hpp"
#include "swept/robot_model/input.hpp"

namespace swept::python {

/// Remarks about files, gathered while the GIL is released, on any thread.
class Remarks {
 public:
  /// Options for a source, whose remarks come here. This must outlive them.
  LoadOptions optionsFor(const Source& source);
  /// Warns of each remark (swept.InputWarning). Needs the GIL. Throws if the program's filter makes
  /// a warning an exception.
  void warn() const;

 private:
  std::mutex mutex_;
  std::vector<std::string> lines_;
};

/// The keyword arguments of loading functions. Paths become absolute, since a pickle may be read in
/// another folder. `file` may be empty.
Source sourceOf(const std::filesystem::path& file, const pybind11::object& srdf,
                const pybind11::object& packages, const pybind11::object& cache,
                const std::string& modelFrame, bool childProcess);

/// The ending in lower case: `.json`.
std::string endingOf(const std::filesystem::path& file);
/// Writes a file. Throws UsageError if it cannot be written.
void writeText(const std::filesystem::path& file, const std::string& text);
/// The robot's URDF. Throws UsageError for one that has none of its own, such as that of a cell.
const std::filesystem::path& urdfOf(const RobotHandle& robot);

///@{
/// A path as pathlib has it, and back. The empty path, which pathlib turns into `.`, is None.
pybind11::object toPython(const std::filesystem::path& file);
std::filesystem::path pathOf(const pybind11::handle& value);
///@}

}  // namespace swept::python
