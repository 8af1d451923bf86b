// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "report/report.hpp"

namespace swept {

/// An answer that is a length or a time, against the truth.
struct LengthAnswer {
  bool missed = false;          ///< there is none, although there should be
  double error = 0.0;           ///< m
  std::optional<double> bound;  ///< m, what the method says that the error is at most
};

/// Errors and times of one part, by method.
class LengthTally {
 public:
  LengthTally(ReportPart part, std::vector<ReportMethod> methods);
  /// `time` in ns.
  void add(std::size_t method, const LengthAnswer& answer, double time);
  const std::vector<ReportMethod>& methods() const { return methods_; }
  /// None without any answer.
  std::vector<ReportRow> rows() const;

 private:
  struct Entry {
    std::vector<double> errors, bounds, times;
    std::size_t missed = 0;
  };
  ReportPart part_;
  std::vector<ReportMethod> methods_;
  std::vector<Entry> entries_;
};

}  // namespace swept
