// SPDX-License-Identifier: BSD-3-Clause
// forge: makes path files whose proofs claim more than is true, and sees whether the checker of
// proofs accepts one that exact arithmetic refutes. Exit code 1 when it does.
#include <CLI/CLI.hpp>
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "forgeries/campaign.hpp"
#include "in_parts.hpp"

// NOLINTNEXTLINE(bugprone-exception-escape): CLI throws where the options below are wrong.
int main(int argc, char** argv) {
  forgeries::CampaignOptions options;
  std::uint64_t report = 100000;
  bool print = false;
  std::vector<std::string> files;
  CLI::App app{"Tries to have false proofs verified."};
  app.add_option("--count", options.count, "how many files");
  app.add_option("--first", options.first, "index of the first; alone, only this one is made");
  app.add_option("--seed", options.seed);
  app.add_option("--report", report, "a line after so many files")->check(CLI::PositiveNumber);
  app.add_option("--file", files, "path files with models of few triangles, to make others of")
      ->check(CLI::ExistingFile);
  app.add_flag("--print", print, "print the first file, for `swept verify`");
  CLI11_PARSE(app, argc, argv);
  if (app.count("--first") > 0 && app.count("--count") == 0) options.count = 1;
  try {
    for (const std::string& file : files) {
      std::ifstream stream(file);
      options.originals.push_back(forgeries::Json::parse(stream));
      if (!options.originals.back().contains("model"))
        throw std::runtime_error(file + ": it has no model; `swept plan --embed` writes one");
    }
    if (print) {
      std::vector<forgeries::Field> fields;
      std::cout << forgeries::forge(options, options.first, fields).dump() << std::endl;
      return 0;
    }
    return runInParts(options, report, forgeries::runCampaign).failures.empty() ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 3;
  }
}
