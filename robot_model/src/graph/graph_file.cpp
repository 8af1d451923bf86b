// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "graph/model_digest.hpp"
#include "graph/proven_graph_data.hpp"
#include "io/json_place.hpp"
#include "output/whole_file.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/text_file.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "text/numbers.hpp"

namespace swept {

namespace detail {

namespace {

constexpr int kVersion = 1;

/// Of all that the file says of states and motions.
std::string contentDigest(const ProvenGraphData& graph) {
  ContentHash hash;
  const auto add = [&hash](std::size_t value) {
    const auto wide = static_cast<std::uint64_t>(value);
    hash.addItems(std::span<const std::uint64_t>(&wide, 1));
  };
  add(graph.stateCount);
  hash.addItems(std::span<const double>(graph.values));
  add(graph.motions.size());
  for (std::size_t i = 0; i < graph.motions.size(); ++i) {
    add(graph.motions[i].from);
    add(graph.motions[i].to);
    add(graph.blocks[i].size());
    for (const MotionBlock& block : graph.blocks[i]) {
      add(graph.names[block.body].size());
      hash.add(graph.names[block.body]);
      add(static_cast<std::size_t>(block.verdict));
    }
  }
  return hexadecimal(hash.digest());
}

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
}

/// Of things separated by commas, each in a line of its own.
template <typename Items, typename TextOf>
std::string lines(const Items& items, const TextOf& textOf) {
  std::string text = "[";
  bool first = true;
  for (const auto& item : items) {
    text += std::string(first ? "" : ",") + "\n  " + textOf(item);
    first = false;
  }
  return text + "\n ]";
}

std::string fileText(const ProvenGraphData& graph) {
  const Checker& checker = *graph.checker;
  std::vector<std::size_t> states(graph.stateCount), blocked;
  for (std::size_t i = 0; i < states.size(); ++i) states[i] = i;
  for (std::size_t i = 0; i < graph.motions.size(); ++i)
    if (!graph.blocks[i].empty()) blocked.push_back(i);
  std::string text = "{\n \"swept_roadmap\": " + std::to_string(kVersion) +
                     ",\n \"robot\": " + quoted(checker.robot().name()) +
                     ",\n \"group\": " + quoted(checker.group().name) + ",\n \"robot_digest\": \"" +
                     hexadecimal(robotDigest(checker.robot())) + "\",\n \"options_digest\": \"" +
                     hexadecimal(questionDigest(checker)) + "\",\n \"content_digest\": \"" +
                     contentDigest(graph) + "\"";
  text += ",\n \"bodies\": " + lines(checker.world().bodies(), [&](const WorldBody& body) {
            return "{\"name\": " + quoted(body.name) + ", \"digest\": \"" +
                   hexadecimal(bodyDigest(checker, body)) + "\"}";
          });
  text += ",\n \"states\": " + lines(states, [&](std::size_t i) {
            std::string state = "[";
            for (const double value : graph.state(i))
              state += (state.size() > 1 ? ", " : "") + formatNumber(value);
            return state + "]";
          });
  text += ",\n \"motions\": " + lines(graph.motions, [](const ProvenGraph::Motion& motion) {
            return "[" + std::to_string(motion.from) + ", " + std::to_string(motion.to) + "]";
          });
  text += ",\n \"blocked\": " + lines(blocked, [&](std::size_t i) {
            std::string names;
            for (const MotionBlock& block : graph.blocks[i])
              names += std::string(names.empty() ? "" : ", ") +
                       "{\"body\": " + quoted(graph.names[block.body]) + ", \"verdict\": \"" +
                       (block.verdict == Verdict::Collision ? "collision" : "undecided") + "\"}";
            return "{\"motion\": " + std::to_string(i) + ", \"by\": [" + names + "]}";
          });
  return text + "\n}\n";
}

std::uint32_t indexOf(const JsonPlace& place, std::size_t count, const char* what) {
  const bool isWhole = place.value.is_number_unsigned();
  if (!isWhole || place.value.get<std::uint64_t>() >= count)
    place.fail("is " + place.shown() + "; it must be the number of a " + what +
               ", from 0 to below " + std::to_string(count));
  return place.value.get<std::uint32_t>();
}

/// A file's bodies, as far as they are not those of the checker's world.
struct WorldChange {
  std::vector<std::string> gone;
  std::vector<const WorldBody*> added;
};

class GraphReader {
 public:
  GraphReader(const std::string& file, const std::string& text) : file_(file) {
    parsed_ = parseJson(text, file_);
  }

  /// Throws InputError.
  WorldChange read(ProvenGraphData& graph) {
    const JsonPlace root{parsed_, "", file_};
    if (!parsed_.is_object()) fail("a roadmap must be an object");
    if (!parsed_.contains("swept_roadmap"))
      fail("swept_roadmap is missing; roadmaps are made by 'swept roadmap build'");
    const JsonPlace version = root.at("swept_roadmap");
    if (version.value != kVersion)
      version.fail("is " + version.shown() + "; it must be " + std::to_string(kVersion));
    JsonPlace{parsed_, "the roadmap", file_}.allowOnly(
        {"swept_roadmap", "robot", "group", "robot_digest", "options_digest", "content_digest",
         "bodies", "states", "motions", "blocked"});
    requireSameQuestion(root, *graph.checker);
    const WorldChange change = readBodies(root.at("bodies"), *graph.checker);
    readStates(root.at("states"), graph);
    readMotions(root.at("motions"), graph);
    readBlocked(root.at("blocked"), graph);
    const JsonPlace content = root.at("content_digest");
    if (content.text() != contentDigest(graph))
      fail(
          "states, motions or what blocks them are not what was written: content_digest is of "
          "others");
    return change;
  }

  [[noreturn]] void fail(const std::string& message) const { throw InputError(file_, 0, message); }

 private:
  void requireSameQuestion(const JsonPlace& root, const Checker& checker) const {
    const std::string robot = root.at("robot").text(), group = root.at("group").text();
    if (root.at("robot_digest").text() != hexadecimal(robotDigest(checker.robot())))
      fail("the roadmap is of robot '" + foreignText(robot) + "' as it was, which is not robot '" +
           checker.robot().name() +
           "': links, joints, limits or pairs that are not checked differ");
    if (group != checker.group().name)
      fail("the roadmap is of group '" + foreignText(group) + "', not of group '" +
           checker.group().name + "'");
    if (root.at("options_digest").text() != hexadecimal(questionDigest(checker)))
      fail(
          "the roadmap was made with other options: margins, tolerances, rules, attached bodies, "
          "constraints, or values of joints outside the group");
  }

  WorldChange readBodies(const JsonPlace& place, const Checker& checker) {
    WorldChange change;
    std::vector<std::string> same;
    for (const JsonPlace& body : place.elements()) {
      body.allowOnly({"name", "digest"});
      const std::string name = body.at("name").text(), digest = body.at("digest").text();
      if (std::ranges::find(names_, name) != names_.end())
        body.fail("is a second body '" + foreignText(name) + "'");
      names_.push_back(name);
      const WorldBody* const now = checker.world().find(name);
      if (now != nullptr && digest == hexadecimal(bodyDigest(checker, *now)))
        same.push_back(name);
      else
        change.gone.push_back(name);
    }
    for (const WorldBody& body : checker.world().bodies())
      if (std::ranges::find(same, body.name) == same.end()) change.added.push_back(&body);
    return change;
  }

  static void readStates(const JsonPlace& place, ProvenGraphData& graph) {
    const auto dimension = static_cast<std::size_t>(graph.checker->dimension());
    for (const JsonPlace& state : place.elements()) {
      const std::vector<double> values = state.numbers(dimension);
      graph.values.insert(graph.values.end(), values.begin(), values.end());
      ++graph.stateCount;
    }
  }

  static void readMotions(const JsonPlace& place, ProvenGraphData& graph) {
    for (const JsonPlace& motion : place.elements()) {
      const std::vector<JsonPlace> ends = motion.elements();
      if (ends.size() != 2)
        motion.fail("holds " + std::to_string(ends.size()) + " values; it must hold 2");
      graph.motions.push_back({indexOf(ends[0], graph.stateCount, "state"),
                               indexOf(ends[1], graph.stateCount, "state")});
    }
    graph.blocks.resize(graph.motions.size());
  }

  void readBlocked(const JsonPlace& place, ProvenGraphData& graph) const {
    for (const JsonPlace& blocked : place.elements()) {
      blocked.allowOnly({"motion", "by"});
      const JsonPlace number = blocked.at("motion");
      std::vector<MotionBlock>& blocks =
          graph.blocks[indexOf(number, graph.motions.size(), "motion")];
      if (!blocks.empty()) number.fail("is " + number.shown() + " a second time");
      for (const JsonPlace& by : blocked.at("by").elements()) {
        by.allowOnly({"body", "verdict"});
        const JsonPlace body = by.at("body"), verdict = by.at("verdict");
        if (std::ranges::find(names_, body.text()) == names_.end())
          body.fail("is " + body.shown() + ", which is none of bodies");
        const bool meets = verdict.text() == "collision";
        if (!meets && verdict.text() != "undecided")
          verdict.fail("is " + verdict.shown() + "; it must be collision or undecided");
        blocks.push_back(
            {graph.numberOf(body.text()), meets ? Verdict::Collision : Verdict::Undecided});
      }
    }
  }

  const std::string& file_;
  nlohmann::json parsed_;
  std::vector<std::string> names_;  ///< of the bodies
};

}  // namespace

}  // namespace detail

void ProvenGraph::save(const std::filesystem::path& file) const {
  const std::string text = inDefaultEnvironment([this] { return detail::fileText(*data_); });
  if (text.size() > kMaxTextBytes)
    throw UsageError("'" + file.string() + "' would have " + std::to_string(text.size()) +
                     " bytes, more than the " + std::to_string(kMaxTextBytes) +
                     " that are read of a roadmap");
  writeWholeFile(file, text);
}

ProvenGraph ProvenGraph::load(const std::filesystem::path& file,
                              std::shared_ptr<const Checker> checker, unsigned threads) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return load(file, std::move(checker), threads); });
  }
  ProvenGraph graph(std::move(checker));
  const std::string name = file.string();
  detail::GraphReader reader(name, readTextFile(file));
  const detail::WorldChange change = reader.read(*graph.data_);
  if (!change.gone.empty() || !change.added.empty()) {
    const bool isGone = !change.gone.empty();
    const std::string& body = isGone ? change.gone.front() : change.added.front()->name;
    const bool isOther = isGone && graph.checker()->world().find(body) != nullptr;
    reader.fail("the roadmap is of another world: body '" + foreignText(body) + "' " +
                (isOther  ? "is not what it was"
                 : isGone ? "is gone"
                          : "is new") +
                "; 'swept roadmap update' takes it to this world");
  }
  graph.data_->findBoxes(0, threads);
  return graph;
}

ProvenGraph::Updated ProvenGraph::loadChanged(const std::filesystem::path& file,
                                              std::shared_ptr<const Checker> checker,
                                              unsigned threads) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return loadChanged(file, std::move(checker), threads); });
  }
  Updated result{.graph = ProvenGraph(checker), .change = {}};
  const std::string name = file.string();
  detail::GraphReader reader(name, readTextFile(file));
  const detail::WorldChange change = reader.read(*result.graph.data_);
  result.graph.data_->findBoxes(0, threads);
  result.change =
      result.graph.data_->change(std::move(checker), change.gone, change.added, threads);
  return result;
}

}  // namespace swept
