// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "swept/robot_model/input.hpp"

namespace swept::detail {

/// One input file as its messages see it: the name to print, the folder that relative paths start
/// from, and where warnings go.
class InputSource {
 public:
  InputSource(std::string name, const LoadOptions& options);

  const std::string& name() const { return name_; }
  std::filesystem::path folder() const;
  const LoadOptions& options() const { return options_; }

  [[noreturn]] void fail(int line, const std::string& message) const;
  void warn(int line, const std::string& message) const;
  /// To LoadOptions::warnOfUnchecked.
  void warnOfUnchecked(int line, const std::string& message) const;

 private:
  std::string warning(int line, const std::string& message) const;
  std::string name_;
  LoadOptions options_;
};

}  // namespace swept::detail
