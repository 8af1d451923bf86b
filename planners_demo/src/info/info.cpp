// SPDX-License-Identifier: BSD-3-Clause
#include "info/info.hpp"

#include <iostream>
#include <stdexcept>

#include "command_line/commands.hpp"
#include "command_line/exit_code.hpp"
#include "input/rules.hpp"
#include "page/pages.hpp"

namespace swept {

std::string_view toString(JointType type) {
  switch (type) {
    case JointType::Fixed:
      return "fixed";
    case JointType::Revolute:
      return "revolute";
    case JointType::Continuous:
      return "continuous";
    case JointType::Prismatic:
      return "prismatic";
    case JointType::Planar:
      return "planar";
    case JointType::Floating:
      return "floating";
  }
  return "unknown";
}

std::vector<std::string> explanations(const Arguments& args, const Checker& checker) {
  std::vector<std::string> sentences;
  for (const std::string& text : args.explained) {
    const auto [a, b] = namesOfPair("--explain", text);
    try {
      sentences.push_back(checker.explain(a, b));
    } catch (const std::invalid_argument& error) {
      throw UsageError(error.what());
    }
  }
  return sentences;
}

ExitCode runInfo(const Arguments& args) {
  requirePageFile(args);
  Warnings warnings(args.quiet);
  const Model model = loadModel(args, warnings);
  std::shared_ptr<const Checker> checker;
  if (!args.group.empty())
    checker =
        makeChecker(args, model, chooseGroup(*model.robot, args.group), model.world, warnings);
  if (!args.explained.empty() && checker == nullptr)
    throw UsageError("--explain needs --group: which pairs are checked depends on what moves");
  if (args.json) {
    std::cout << infoJson(args, model, checker.get()).dump(2) << '\n';
  } else {
    std::cout << infoText(args, model, checker.get());
  }
  writeInfoPage(args, model, checker.get());
  return ExitCode::Free;
}

}  // namespace swept
