// SPDX-License-Identifier: BSD-3-Clause
#include "report/machine.hpp"

#include <ompl/config.h>
#include <sys/utsname.h>

#include <fstream>
#include <thread>

#include "bench/fcl.hpp"

namespace swept {
namespace {

/// The value of the first line `key   : value` or `key="value"`; empty without one.
std::string valueIn(const std::string& file, const std::string& key, char separator) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t at = line.find(separator);
    if (at == std::string::npos || !line.starts_with(key)) continue;
    const std::size_t begin = line.find_first_not_of(" \"", at + 1);
    const std::size_t end = line.find_last_not_of(" \"");
    if (begin != std::string::npos) return line.substr(begin, end + 1 - begin);
  }
  return {};
}

std::string processor() {
  std::string model = valueIn("/proc/cpuinfo", "model name", ':');
  utsname system{};
  if (model.empty() && uname(&system) == 0) return system.machine;
  return model;
}

std::string systemName() {
  utsname system{};
  if (uname(&system) != 0) return "unknown";
  const std::string kernel = std::string(system.sysname) + " " + system.release;
  const std::string name = valueIn("/etc/os-release", "PRETTY_NAME", '=');
  return name.empty() ? kernel : name + ", " + kernel;
}

/// Distributions leave the macro for the whole of it empty.
std::string omplVersion() {
  return std::to_string(OMPL_MAJOR_VERSION) + "." + std::to_string(OMPL_MINOR_VERSION) + "." +
         std::to_string(OMPL_PATCH_VERSION);
}

std::string compiler() {
#if defined(__clang__)
  return std::string("clang ") + __clang_version__;
#elif defined(__GNUC__)
  return std::string("g++ ") + __VERSION__;
#else
  return "unknown";
#endif
}

}  // namespace

std::vector<std::pair<std::string, std::string>> machineFacts() {
  std::vector<std::pair<std::string, std::string>> facts{
      {"processor", processor()}, {"cores", std::to_string(std::thread::hardware_concurrency())},
      {"system", systemName()},   {"compiler", compiler()},
      {"swept", SWEPT_VERSION},   {"OMPL", omplVersion()}};
  if (builtWithFcl()) facts.emplace_back("FCL", fclVersion());
  return facts;
}

}  // namespace swept
