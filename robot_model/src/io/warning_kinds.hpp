// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/input_source.hpp"

namespace swept::detail {

/// Warnings of one file, kept until all are known: of many that differ in their lines alone one
/// line says how many there are. With LoadOptions::everyWarning they go out one by one.
class WarningKinds {
 public:
  explicit WarningKinds(const InputSource& source) : source_(source) {}
  WarningKinds(const WarningKinds&) = delete;
  WarningKinds& operator=(const WarningKinds&) = delete;

  /// `one` is the text of this warning. `kind` is that of several, with a `#` for their number.
  void add(int line, const std::string& one, const std::string& kind);
  /// In the order in which the first of each kind came.
  void flush();

 private:
  struct Entry {
    std::string kind, one;
    int line = 0;
    int count = 0;
  };
  const InputSource& source_;
  std::vector<Entry> entries_;
};

/// `options`, with warnings kept until `action` has ended, however it ends. Of those that differ in
/// what stands in quotation marks, in numbers and in places alone the first few go out, and how
/// many more there are: a robot may have a hundred meshes with the same flaw.
void withFewWarnings(const LoadOptions& options,
                     const std::function<void(const LoadOptions&)>& action);

}  // namespace swept::detail
