// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "batch/run_result.hpp"
#include "input/task.hpp"

namespace swept {

/// The content of a results file: a header and a result per line.
// NOLINTNEXTLINE(bugprone-exception-escape): Json's move is noexcept, which is not believed of it.
struct Results {
  Json header;                  ///< null: there is none yet
  std::vector<RunResult> runs;  ///< in the order of the lines, each key once
  std::size_t wholeBytes = 0;   ///< up to and with the last line break
  std::size_t tornBytes = 0;    ///< of a last line without one: its writer was killed
};

/// Reads a results file. A repeated identical line counts once. Warns of a torn line. Throws
/// InputError for a file that is not a results file, a line that is not a result or has more than
/// kMaxTextBytes, and two different results of one run.
Results readResults(const std::string& file, Warnings& warnings);

/// A results file that grows. Each line is on the disk before the next is written.
class ResultsFile {
 public:
  /// Reads the existing results and drops a torn line, with a warning. To a pipe or a device, which
  /// cannot be read again, it writes the header and the results. It writes nothing to a file that
  /// it refuses. Throws InputError or UsageError: as readResults, for a header other than `header`,
  /// and for a file that cannot be written or that another process writes to.
  ResultsFile(const std::string& file, const Json& header, Warnings& warnings);
  ~ResultsFile();
  ResultsFile(const ResultsFile&) = delete;
  ResultsFile& operator=(const ResultsFile&) = delete;

  /// The existing file's own header, if there was a file.
  const Json& header() const { return results_.header.is_null() ? header_ : results_.header; }
  const std::vector<RunResult>& runs() const { return results_.runs; }
  /// Creates the file if there was none. Throws UsageError.
  void append(const RunResult& result);

 private:
  void openForWriting(int flags);
  void openPipe();
  void writeLine(const std::string& line);
  [[noreturn]] void refuse(const std::string& reason) const;

  std::string file_;
  Json header_;
  Results results_;
  int descriptor_ = -1;  ///< -1: there is no file yet
};

}  // namespace swept
