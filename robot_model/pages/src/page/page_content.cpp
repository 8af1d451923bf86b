// SPDX-License-Identifier: BSD-3-Clause
#include "page/page_content.hpp"

#include <algorithm>

#include "output/clearance_text.hpp"
#include "output/clouds_json.hpp"
#include "page/packed.hpp"
#include "page/page_bodies.hpp"
#include "page/page_clearances.hpp"
#include "page/page_constraints.hpp"
#include "page/page_curve_json.hpp"
#include "page/page_curves.hpp"
#include "page/page_frames.hpp"
#include "page/page_pieces.hpp"
#include "page/page_tree.hpp"
#include "page/page_visuals.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept {
namespace {

std::string_view toString(PageBody::Kind kind) {
  switch (kind) {
    case PageBody::Kind::Link:
      return "link";
    case PageBody::Kind::Attached:
      return "attached";
    case PageBody::Kind::Drawing:
      return "drawing";
    case PageBody::Kind::World:
      break;
  }
  return "world";
}

/// When a body of the world is where: position, then quaternion x, y, z, w.
Json waypointsJson(const MovingObstacle& obstacle) {
  std::vector<double> times, poses;
  for (const MovingObstacle::Waypoint& waypoint : obstacle.waypoints) {
    times.push_back(waypoint.time);
    const Eigen::Vector3d place = waypoint.world_from_body.translation();
    const Eigen::Quaterniond turn(waypoint.world_from_body.linear());
    poses.insert(poses.end(), place.begin(), place.end());
    poses.insert(poses.end(), {turn.x(), turn.y(), turn.z(), turn.w()});
  }
  return {{"times", packed<double>(times)}, {"poses", packed<double>(poses)}};
}

Json bodiesJson(const std::vector<PageBody>& bodies, const PageFrames& frames,
                PageGeometries& geometries) {
  Json json = Json::array();
  for (const PageBody& body : bodies) {
    const auto place = std::ranges::find(frames.links, body.link) - frames.links.begin();
    json.push_back({{"name", body.name},
                    {"kind", toString(body.kind)},
                    {"frame", body.link < 0 ? Json(nullptr) : Json(place)},
                    {"padding", body.padding},
                    {"colour", body.colour ? Json(cssColour(*body.colour)) : Json(nullptr)},
                    {"parts", geometries.partsJson(body)}});
    if (body.opacity < 1.0) json.back()["opacity"] = body.opacity;
    if (body.moving != nullptr) json.back()["motion"] = waypointsJson(*body.moving);
  }
  return json;
}

void addDrawings(const PageContent& content, std::vector<PageBody>& bodies) {
  for (const PageContent::Drawing& drawing : content.drawings) {
    PageBody body{.name = drawing.name,
                  .kind = PageBody::Kind::Drawing,
                  .link = drawing.link,
                  .moving = nullptr,
                  .parts = {},
                  .colour = drawing.colour,
                  .opacity = drawing.opacity};
    for (const auto& [shape, pose] : drawing.shapes) body.parts.push_back({shape, pose, nullptr});
    bodies.push_back(std::move(body));
  }
}

Json framesJson(const Robot& robot, const PageFrames& frames) {
  std::vector<float> numbers;
  for (const std::vector<Eigen::Isometry3d>& frame : frames.poses)
    for (const Eigen::Isometry3d& pose : frame) appendPose(numbers, pose);
  Json names = Json::array();
  for (const int link : frames.links)
    names.push_back(robot.links()[static_cast<std::size_t>(link)].name);
  return {{"links", std::move(names)},
          {"count", frames.poses.size()},
          {"poses", packed<float>(numbers)}};
}

/// Where a constraint does not hold: the share of the motion, and in words.
Json violationJson(const ConstraintViolation& violation, const Checker& checker) {
  return {{"t", violation.t}, {"text", describe(violation, checker.options().constraints)}};
}

/// The group's values of a configuration, which may have a time besides.
Json valuesJson(const Group& group, const std::vector<double>& q) {
  Json values = toJson(q);
  if (q.size() > group.variables.size()) values.erase(values.size() - 1);
  return values;
}

Json motionsJson(const Checker& checker, const PageContent& content,
                 const std::vector<PageSpan>& spans, const PageFrames& frames) {
  Json json = Json::array();
  for (std::size_t i = 0; i < content.motions.size(); ++i) {
    const PageContent::Motion& motion = content.motions[i];
    const MotionCertificate& certificate = motion.certificate;
    Json entry = {{"label", motion.label},
                  {"path", motion.path},
                  {"verdict", swept::toString(certificate.verdict)},
                  {"free_until", certificate.freeUntil},
                  {"from", valuesJson(checker.group(), motion.from)},
                  {"to", valuesJson(checker.group(), motion.to)},
                  {"first_frame", frames.firstFrame[i]},
                  {"steps", spans[i].steps}};
    if (!checker.world().obstacles().empty())
      entry["clock"] = {motion.from.back(), motion.to.back()};
    entry["contacts"] = Json::array();
    if (certificate.witness) entry["contacts"].push_back(toJson(*certificate.witness));
    entry["violation"] =
        certificate.violation ? violationJson(*certificate.violation, checker) : Json(nullptr);
    entry["pieces"] = piecesJson(piecesOf(checker, spans[i]));
    json.push_back(std::move(entry));
  }
  return json;
}

/// Each is one motion, whose t is the share of its duration.
Json trajectoriesJson(const Checker& checker, const PageContent& content,
                      const std::vector<PageSpan>& spans, const PageFrames& frames) {
  Json json = Json::array();
  for (std::size_t i = 0; i < content.trajectories.size(); ++i) {
    const PageContent::Trajectory& trajectory = content.trajectories[i];
    const TrajectoryCertificate& certificate = trajectory.certificate;
    const CurvePieces pieces = piecesOf(checker, trajectory.curve, trajectory.query.clock,
                                        spans[i].steps / kFramesPerPiece);
    const double proven = certificate.freeUntil - trajectory.curve.begin();
    Json entry = {{"label", trajectory.label},
                  {"path", i},
                  {"verdict", swept::toString(certificate.verdict)},
                  {"free_until", proven / trajectory.curve.duration()},
                  {"from", toJson(spans[i].from)},
                  {"to", toJson(spans[i].to)},
                  {"first_frame", frames.firstFrame[i]},
                  {"steps", spans[i].steps}};
    entry["contacts"] = Json::array();
    if (certificate.contact) entry["contacts"].push_back(toJson(certificate.contact->witness));
    entry["violation"] = certificate.violation
                             ? violationJson(certificate.violation->violation, checker)
                             : Json(nullptr);
    entry["pieces"] = piecesJson(pieces.pieces);
    entry["curve"] = curveJson(checker, trajectory, pieces);
    json.push_back(std::move(entry));
  }
  return json;
}

Json stateJson(const PageContent::State& state, const Group& group, const Checker* checker) {
  Json json = {{"label", state.label}, {"values", valuesJson(group, state.q)}};
  if (state.q.size() > group.variables.size()) json["clock"] = state.q.back();
  json["verdict"] = nullptr;
  json["contacts"] = Json::array();
  json["violations"] = Json::array();
  if (checker == nullptr) return json;
  Workspace workspace(*checker);
  const StateReport report = checker->reportState(state.q, workspace);
  json["verdict"] = swept::toString(report.verdict);
  json["clearance"] = finiteOrNull(report.clearance);
  json["nearest"] = Json::array({report.nearestA, report.nearestB});
  addClearances(swept::clearancesOf(report), json);
  for (const Witness& contact : report.contacts) json["contacts"].push_back(toJson(contact));
  for (const ConstraintViolation& violation : report.violations)
    json["violations"].push_back(describe(violation, checker->options().constraints));
  return json;
}

std::vector<PageSpan> spansOf(const PageContent& content) {
  std::vector<PageSpan> spans;
  const int steps = kFramesPerPiece * piecesPerMotion(content.motions.size());
  for (const PageContent::Motion& motion : content.motions)
    spans.push_back({.from = motion.from, .to = motion.to, .steps = steps});
  for (const PageContent::Trajectory& trajectory : content.trajectories) {
    const auto ends = [&](double time) {
      const Eigen::VectorXd q = trajectory.curve.position(time);
      return std::vector<double>(q.begin(), q.end());
    };
    spans.push_back({.from = ends(trajectory.curve.begin()),
                     .to = ends(trajectory.curve.end()),
                     .steps = kFramesPerPiece * piecesPerTrajectory(content.trajectories.size()),
                     .curve = &trajectory.curve,
                     .clock = trajectory.query.clock});
  }
  if (spans.empty())
    for (const PageContent::State& state : content.states)
      spans.push_back({.from = state.q, .to = state.q, .steps = 0});
  return spans;
}

/// Links that bodies move with, the tip, and those that are shown.
std::vector<int> linksOf(const std::vector<PageBody>& bodies, int tipLink,
                         const std::vector<int>& shown) {
  std::vector<int> links;
  const auto add = [&](int link) {
    if (link >= 0 && std::ranges::find(links, link) == links.end()) links.push_back(link);
  };
  for (const PageBody& body : bodies) add(body.link);
  add(tipLink);
  for (const int link : shown) add(link);
  return links;
}

Json variablesJson(const Robot& robot, const Group& group) {
  Json json = Json::array();
  for (const int v : group.variables) {
    const Variable& variable = robot.variables()[static_cast<std::size_t>(v)];
    json.push_back({{"name", variable.name}, {"unit", unitOf(robot, variable)}});
  }
  return json;
}

/// What every page says.
Json factsJson(const Robot& robot, const World& world, const Checker* checker,
               const PageContent& content, const VisualModel& visuals) {
  Json json = Json::array();
  const auto add = [&](const std::string& name, const std::string& value) {
    json.push_back(Json::array({name, value}));
  };
  for (const auto& [name, value] : content.facts) add(name, value);
  add("robot", robot.name());
  if (checker != nullptr) {
    add("group", checker->group().name);
    const CheckerOptions& options = checker->options();
    add("margin", shortNumber(options.margin) + " m");
    if (options.selfMargin) add("margin to itself", shortNumber(*options.selfMargin) + " m");
    if (options.worldMargin) add("margin to the world", shortNumber(*options.worldMargin) + " m");
    add("tolerance", shortNumber(checker->options().tolerance) + " m");
    add("pairs checked", std::to_string(checker->checkedPairs().size()) + ", left out " +
                             std::to_string(checker->skippedPairs().size()));
    if (checker->checksNothing()) add("not checked", "nothing was checked");
  }
  if (const auto links = robot.linksWithoutGeometry(); !links.empty())
    add("not checked (no collision geometry)", joined(links));
  if (const std::string text = visualsText(visuals); !text.empty()) add("visual", text);
  add("bodies in the world", std::to_string(world.bodies().size() + world.obstacles().size()));
  if (!content.command.empty()) add("command", content.command);
  add("swept", SWEPT_VERSION);
  return json;
}

}  // namespace

std::string_view toString(PageContent::Tone tone) {
  switch (tone) {
    case PageContent::Tone::Good:
      return "good";
    case PageContent::Tone::Bad:
      return "bad";
    case PageContent::Tone::Unsure:
      return "unsure";
    case PageContent::Tone::Plain:
      break;
  }
  return "plain";
}

Json pageJson(const Robot& robot, const World& world, const Checker* checker,
              const PageContent& content, const VisualModel& visuals) {
  const Group& group = checker == nullptr ? robot.groups().front() : checker->group();
  const auto reference = checker == nullptr ? std::nullopt : checker->options().reference;
  std::vector<PageBody> bodies = pageBodies(robot, world, checker, &visuals);
  addDrawings(content, bodies);
  const std::vector<PageSpan> spans = spansOf(content);
  const std::vector<int> links = linksOf(bodies, group.tipLink, linksWithVisuals(robot, visuals));
  const PageFrames frames = framesOf(robot, group, reference, spans, links);
  PageGeometries geometries;
  Json json = {{"title", content.title},
               {"tone", toString(content.tone)},
               {"headline", content.headline},
               {"facts", factsJson(robot, world, checker, content, visuals)},
               {"clouds", cloudsText(world)},
               {"variables", variablesJson(robot, group)},
               {"bodies", bodiesJson(bodies, frames, geometries)}};
  json["reason"] = content.reason;
  json["opens_at"] = content.opensAt ? Json(*content.opensAt) : Json(nullptr);
  json["paths"] = Json::array();
  for (const PageContent::Path& path : content.paths)
    json["paths"].push_back({{"label", path.label}, {"tone", toString(path.tone)}});
  json["tree"] = treeJson(robot, group, reference);
  json["visuals"] = visualsJson(robot, visuals, frames, geometries);
  json["geometries"] = geometries.geometriesJson();
  json["covers"] = geometries.coversJson();
  json["frames"] = framesJson(robot, frames);
  json["tip"] = group.tipLink < 0
                    ? Json(nullptr)
                    : Json(robot.links()[static_cast<std::size_t>(group.tipLink)].name);
  json["motions"] = Json::array();
  json["states"] = Json::array();
  if (!content.motions.empty())
    json["motions"] = motionsJson(*checker, content, spans, frames);
  else if (!content.trajectories.empty())
    json["motions"] = trajectoriesJson(*checker, content, spans, frames);
  else
    for (const PageContent::State& state : content.states)
      json["states"].push_back(stateJson(state, group, checker));
  json["constraints"] = checker == nullptr ? Json::array() : pageConstraintsJson(*checker);
  json["clearances"] =
      checker == nullptr ? Json(nullptr) : clearancesOf(*checker, bodies, frames).json();
  return json;
}

}  // namespace swept
