// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstddef>
#include <iostream>
#include <limits>
#include <string>

#include "acm/acm_output.hpp"
#include "command_line/commands.hpp"
#include "input/read_again.hpp"
#include "input/work_cells.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "output/whole_file.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

/// Warns of options that hide collisions.
void warnOfDefaults(const AcmResult& result, Warnings& warnings) {
  const std::vector<Link>& links = result.model.robot->links();
  std::vector<std::string> pairs;
  for (const LinkPairReport& pair : result.pairs)
    if (pair.status == PairStatus::Default)
      pairs.push_back(links[pair.linkA].name + " - " + links[pair.linkB].name);
  if (!pairs.empty())
    warnings("swept: warning: disabled as Default, though not in contact in all samples: " +
             joined(pairs));
}

/// Seconds. Robots with fewer links finish within this time, or nearly. For larger ones each hour
/// helps.
double timeOf(const Arguments& args, const Robot& robot) {
  constexpr double kTime = 20.0;
  constexpr std::size_t kFewLinks = 40;
  const bool few = robot.links().size() < kFewLinks;
  return args.acmTime.value_or(few ? kTime : std::numeric_limits<double>::infinity());
}

ExitCode exitCodeOf(const std::vector<AcmDisagreement>& differences) {
  ExitCode code = ExitCode::Free;
  for (const AcmDisagreement& difference : differences) {
    if (difference.kind == AcmDisagreement::Kind::Collides) code = worse(code, ExitCode::Collision);
    if (difference.kind == AcmDisagreement::Kind::Open) code = worse(code, ExitCode::Undecided);
  }
  return code;
}

}  // namespace

ExitCode runAcm(const Arguments& args) {
  Warnings warnings(args.quiet);
  if (isWorkCell(args))
    throw UsageError("'" + args.robot + "' is a work cell, which names the SRDF of each of its " +
                     "robots: run `swept acm` on their URDFs");
  if (!args.output.empty()) requireWritable(args.output);
  const std::string srdfFile = chooseSrdf(args).file;
  if (!srdfFile.empty()) requireReadAgain(srdfFile);
  const Model model = loadModel(args, warnings);
  const std::string srdf = model.srdf.file.empty() ? "" : readTextFile(model.srdf.file);
  AllowedCollisionMatrixOptions options;
  options.margin = args.margin;
  options.budget = args.budget;
  options.samples = args.samples;
  options.seed = args.seed;
  options.seconds = timeOf(args, *model.robot);
  AcmResult result{.args = args, .model = model, .pairs = {}, .limit = options.seconds};
  {
    Progress progress("looking at pairs of links", args.quiet);
    options.progress = [&](std::size_t done, std::size_t all) {
      progress.setLabel("looking at pairs of links: " + std::to_string(done) + " of " +
                        std::to_string(all));
    };
    const auto start = std::chrono::steady_clock::now();
    result.pairs = computeAllowedCollisionMatrix(*model.robot, options);
    result.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  }
  if (!args.output.empty()) {
    writeWholeFile(args.output, srdfWithPairs(*model.robot, result.pairs, srdf, model.srdf.file));
    warnOfDefaults(result, warnings);
  }
  const std::vector<AcmDisagreement> differences = compareWithSrdf(result);
  if (args.json) {
    std::cout << dumped(acmJson(result, differences)) << '\n';
  } else {
    printText(acmText(result, differences));
  }
  return exitCodeOf(differences);
}

}  // namespace swept
