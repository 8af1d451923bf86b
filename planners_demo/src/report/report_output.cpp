// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_output.hpp"

#include <filesystem>
#include <iostream>

#include "command_line/exit_code.hpp"
#include "output/terminal_text.hpp"
#include "output/whole_file.hpp"

namespace swept {
namespace {

std::filesystem::path pictureFile(const Arguments& args, const std::string& name) {
  return args.report.svg + "-" + name + ".svg";
}

}  // namespace

void requireReportFiles(const Arguments& args) {
  if (!args.output.empty()) requireWritable(args.output);
  if (!args.report.csv.empty()) requireWritable(args.report.csv);
  if (!args.report.svg.empty()) requireWritable(pictureFile(args, "missed"));
  if (args.report.html.empty()) return;
  const std::filesystem::path page = args.report.html;
  if (page.extension() != ".html" && page.extension() != ".htm")
    throw UsageError("'" + args.report.html + "': a page ends in .html or .htm");
  requireWritable(page);
}

void writeReport(const Arguments& args, const ErrorReport& report) {
  const std::string& command = args.page.commandLine;
  std::vector<std::string> written;
  const auto write = [&](const std::filesystem::path& file, const std::string& text) {
    writeWholeFile(file, text);
    written.push_back(file.string());
  };
  if (!args.output.empty()) write(args.output, motionsCsv(report));
  if (!args.report.csv.empty()) write(args.report.csv, reportCsv(report));
  if (!args.report.svg.empty())
    for (const ReportPicture& picture : reportPictures(report))
      write(pictureFile(args, picture.name), svgText(picture.plot));
  if (!args.report.html.empty()) write(args.report.html, reportHtml(report, command));
  if (args.json) {
    std::cout << reportJson(report, command).dump(2, ' ', false, Json::error_handler_t::replace)
              << '\n';
    return;
  }
  printText(reportText(report));
  for (const std::string& file : written) printText("written to " + escapedLine(file) + "\n");
}

}  // namespace swept
