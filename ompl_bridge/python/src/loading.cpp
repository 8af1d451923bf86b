// SPDX-License-Identifier: BSD-3-Clause
#include "loading.hpp"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <map>

#include "errors.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace py = pybind11;

namespace swept::python {

LoadOptions Remarks::optionsFor(const Source& source) {
  LoadOptions options;
  for (const auto& [name, folder] : source.packages) options.packages.push_back({name, folder});
  options.modelFrame = source.modelFrame;
  options.cache = source.cache;
  options.childProcess = source.childProcess;
  options.warn = [this](const std::string& line) {
    const std::lock_guard lock(mutex_);
    lines_.push_back(line);
  };
  return options;
}

void Remarks::warn() const {
  if (lines_.empty()) return;
  const py::object type = py::module_::import("swept.errors").attr("InputWarning");
  for (const std::string& line : lines_)
    if (PyErr_WarnEx(type.ptr(), line.c_str(), 1) != 0) throw py::error_already_set();
}

Source sourceOf(const std::filesystem::path& file, const py::object& srdf,
                const py::object& packages, const py::object& cache, const std::string& modelFrame,
                bool childProcess) {
  const auto absolute = [](const py::object& value) {
    return value.is_none() ? std::filesystem::path() : std::filesystem::absolute(pathOf(value));
  };
  Source source{.file = file.empty() ? file : std::filesystem::absolute(file),
                .srdf = absolute(srdf),
                .packages = {},
                .cache = absolute(cache),
                .modelFrame = modelFrame,
                .childProcess = childProcess};
  if (!packages.is_none())
    for (const auto& [name, folder] : valueOf<std::map<std::string, std::filesystem::path>>(
             packages, "packages", "a dict of names and folders"))
      source.packages.emplace_back(name, std::filesystem::absolute(folder));
  return source;
}

py::object toPython(const std::filesystem::path& file) {
  if (file.empty()) return py::none();
  return py::cast(file);
}

std::filesystem::path pathOf(const py::handle& value) {
  if (value.is_none()) return {};
  return valueOf<std::filesystem::path>(value, "a file", "a path");
}

std::string endingOf(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

void writeText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream output(file, std::ios::binary);
  output << text;
  output.close();
  if (!output) throw UsageError("'" + file.string() + "' cannot be written");
}

const std::filesystem::path& urdfOf(const RobotHandle& robot) {
  if (robot.source.file.empty())
    throw UsageError("robot '" + robot.robot->name() +
                     "' has no URDF of its own, whose other elements a .urdf "
                     "would keep: write another format");
  return robot.source.file;
}

}  // namespace swept::python
