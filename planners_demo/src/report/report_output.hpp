// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "command_line/arguments.hpp"
#include "output/text_output.hpp"
#include "output/text_table.hpp"
#include "report/plot.hpp"
#include "report/report.hpp"

namespace swept {

/// Throws UsageError when a file of -o, --csv, --svg or --html could not be written.
void requireReportFiles(const Arguments& args);
/// To stdout, and into the files that are asked for. Throws UsageError.
void writeReport(const Arguments& args, const ErrorReport& report);

std::string reportText(const ErrorReport& report);
std::string reportCsv(const ErrorReport& report);
/// The random motions, a row each.
std::string motionsCsv(const ErrorReport& report);
Json reportJson(const ErrorReport& report, const std::string& commandLine);
std::string reportHtml(const ErrorReport& report, const std::string& commandLine);

/// What is shown of one part, in text and on the page.
struct ReportTable {
  std::string title;
  std::string remark;  ///< what the numbers are; one or two sentences
  std::vector<TextTable::Column> columns;
  std::vector<std::vector<std::string>> rows;
};
/// Of the parts that there are.
std::vector<ReportTable> reportTables(const ErrorReport& report);
/// `1000 random motions in 1 world: 620 free, ...`
std::string countsText(const ErrorReport& report);

struct ReportPicture {
  std::string name;  ///< of its file, behind the prefix
  Plot plot;
};
std::vector<ReportPicture> reportPictures(const ErrorReport& report);

}  // namespace swept
