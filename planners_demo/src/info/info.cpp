// SPDX-License-Identifier: BSD-3-Clause
#include "info/info.hpp"

#include <algorithm>
#include <iostream>
#include <stdexcept>
#include <utility>

#include "command_line/commands.hpp"
#include "command_line/exit_code.hpp"
#include "input/rules.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "page/pages.hpp"
#include "swept/robot_model/did_you_mean.hpp"

namespace swept {

std::vector<std::string> explanations(const Arguments& args, const Checker& checker) {
  std::vector<std::string> sentences;
  for (const std::string& text : args.explained) {
    const auto [a, b] = namesOfPair("--explain", text);
    try {
      sentences.push_back(checker.explain(a, b));
    } catch (const std::invalid_argument& error) {
      std::vector<std::string> known;
      for (const Link& link : checker.robot().links()) known.push_back(link.name);
      for (const AttachedBody& body : checker.options().attached) known.push_back(body.name);
      for (const WorldBody& body : checker.world().bodies()) known.push_back(body.name);
      for (const MovingObstacle& body : checker.world().obstacles()) known.push_back(body.name);
      const bool isA = std::ranges::find(known, a) != known.end();
      throw UsageError(error.what() + didYouMean(isA ? b : a, known));
    }
  }
  return sentences;
}

namespace {

/// Those that would be of no account without a group.
void refuseRules(const Arguments& args) {
  for (const auto& [option, given] : {std::pair{"--explain", !args.explained.empty()},
                                      {"--pad", !args.pads.empty()},
                                      {"--scale", !args.scales.empty()},
                                      {"--allow", !args.allowed.empty()},
                                      {"--attach", !args.attached.empty()},
                                      {"--stand", !args.standing.empty()},
                                      {"--margin", args.margin > 0.0},
                                      {"--margin-self", args.selfMargin.has_value()},
                                      {"--margin-world", args.worldMargin.has_value()}})
    if (given)
      throw UsageError(std::string(option) +
                       " needs --group: which pairs are checked depends on what moves");
}

}  // namespace

ExitCode runInfo(const Arguments& args) {
  requirePageFile(args);
  Warnings warnings(args.quiet);
  const Model model = loadModel(args, warnings);
  const std::shared_ptr<const Checker> checker = makeCheckerOfGroup(args, model, warnings);
  if (checker == nullptr) refuseRules(args);
  if (args.json) {
    std::cout << dumped(infoJson(args, model, checker.get())) << '\n';
  } else {
    printText(infoText(args, model, checker.get()));
  }
  writeInfoPage(args, model, checker.get());
  return ExitCode::Free;
}

}  // namespace swept
