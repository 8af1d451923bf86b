// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/verify_cover.hpp"

#include <iostream>
#include <string>

#include "certificate/model_json.hpp"
#include "certificate/shape_json.hpp"
#include "cover/covered.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "verify/cover.hpp"

namespace swept {
namespace {

Json bodiesJson(const Covered& covered) {
  Json bodies = Json::array();
  for (const NamedBody& named : covered.bodies) {
    Json body = {{"name", named.name}, {"shapes", Json::array()}};
    for (const PosedShape& posed : named.shapes) {
      body["shapes"].push_back(exactShapeJson(posed.shape));
      body["shapes"].back()["pose"] = poseJson(posed.body_from_shape);
    }
    bodies.push_back(std::move(body));
  }
  return bodies;
}

/// The file that the model is of.
std::string coveredFile(const Arguments& args, bool ofScene) {
  const std::string begin = "'" + args.verify.path + "' is a model of swept cover; say of which ";
  if (!ofScene) {
    if (args.verify.robot.empty()) throw UsageError(begin + "robot: --robot ROBOT.urdf");
    if (!args.verify.scene.empty())
      throw UsageError("--scene is for the model of a scene; '" + args.verify.path +
                       "' is one of a robot");
    return args.verify.robot;
  }
  if (args.verify.scene.empty()) throw UsageError(begin + "scene: --scene SCENE.yaml");
  if (!args.verify.robot.empty())
    throw UsageError("--robot is for the model of a robot; '" + args.verify.path +
                     "' is one of a scene");
  if (!isScene(args.verify.scene))
    throw UsageError("'" + args.verify.scene + "' is no scene (.yaml, .scene)");
  return args.verify.scene;
}

}  // namespace

bool isCoverFile(const Json& file) {
  return file.is_object() && (file.contains("links") || file.contains("bodies")) &&
         !file.contains("proof");
}

ExitCode verifyCover(const Arguments& args, const Json& cover) {
  if (!args.page.file.empty()) throw UsageError("--html is for paths; swept cover --html shows it");
  Warnings warnings(args.quiet);
  Arguments inputs = args;
  const bool ofScene = cover.contains("bodies");
  inputs.robot = coveredFile(args, ofScene);
  inputs.scene.clear();
  verify::CoverSummary summary;
  std::string refusal;
  {
    Progress progress("verifying", args.quiet);
    const Covered covered = loadCovered(inputs, false, warnings);
    try {
      summary = verify::checkCover(cover, bodiesJson(covered));
    } catch (const verify::Refusal& refused) {
      refusal = refused.what();
    }
  }
  const bool holds = refusal.empty();
  if (args.json) {
    std::cout << dumped({{"verified", holds},
                         {"refusal", holds ? Json(nullptr) : Json(refusal)},
                         {ofScene ? "bodies" : "links", summary.links},
                         {"shapes", summary.shapes},
                         {"cells", summary.cells}})
              << '\n';
  } else if (holds) {
    printText(painted(Hue::Good, "verified") + ": " +
              (ofScene ? countedText(summary.links, "body", "bodies")
                       : countedText(summary.links, "link")) +
              " contained in " + countedText(summary.shapes, "shape") + ", " +
              countedText(summary.cells, "cell") + "\n");
  } else {
    printText(painted(Hue::Bad, "refused") + ": " + escapedLine(refusal) + "\n");
  }
  return holds ? ExitCode::Free : ExitCode::Collision;
}

}  // namespace swept
