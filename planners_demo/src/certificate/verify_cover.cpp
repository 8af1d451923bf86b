// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/verify_cover.hpp"

#include <iostream>
#include <string>

#include "certificate/model_json.hpp"
#include "certificate/shape_json.hpp"
#include "input/task.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "verify/cover.hpp"

namespace swept {
namespace {

Json linkBodies(const Robot& robot) {
  Json bodies = Json::array();
  for (const Link& link : robot.links()) {
    if (link.collision.empty()) continue;
    Json body = {{"name", link.name}, {"shapes", Json::array()}};
    for (const CollisionGeometry& geometry : link.collision) {
      body["shapes"].push_back(exactShapeJson(geometry.shape));
      body["shapes"].back()["pose"] = poseJson(geometry.link_from_shape);
    }
    bodies.push_back(std::move(body));
  }
  return bodies;
}

}  // namespace

bool isCoverFile(const Json& file) {
  return file.is_object() && file.contains("links") && !file.contains("proof");
}

ExitCode verifyCover(const Arguments& args, const Json& cover) {
  if (args.verify.robot.empty())
    throw UsageError("'" + args.verify.path +
                     "' is a model of swept cover; say of which robot: "
                     "--robot ROBOT.urdf");
  if (!args.page.file.empty()) throw UsageError("--html is for paths; swept cover --html shows it");
  Warnings warnings(args.quiet);
  Arguments inputs = args;
  inputs.robot = args.verify.robot;
  verify::CoverSummary summary;
  std::string refusal;
  {
    Progress progress("verifying", args.quiet);
    const Model model = loadModel(inputs, warnings);
    try {
      summary = verify::checkCover(cover, linkBodies(*model.robot));
    } catch (const verify::Refusal& refused) {
      refusal = refused.what();
    }
  }
  const bool holds = refusal.empty();
  if (args.json) {
    std::cout << dumped({{"verified", holds},
                         {"refusal", holds ? Json(nullptr) : Json(refusal)},
                         {"links", summary.links},
                         {"shapes", summary.shapes},
                         {"cells", summary.cells}})
              << '\n';
  } else if (holds) {
    printText(painted(Hue::Good, "verified") + ": " + countedText(summary.links, "link") +
              " contained in " + countedText(summary.shapes, "shape") + ", " +
              countedText(summary.cells, "cell") + "\n");
  } else {
    printText(painted(Hue::Bad, "refused") + ": " + escapedLine(refusal) + "\n");
  }
  return holds ? ExitCode::Free : ExitCode::Collision;
}

}  // namespace swept
