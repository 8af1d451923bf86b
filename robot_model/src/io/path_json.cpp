// SPDX-License-Identifier: BSD-3-Clause
#include <cstddef>
#include <vector>

#include "io/json_place.hpp"
#include "io/path_formats.hpp"

namespace swept::detail {

void readJsonPath(const std::string& text, const InputSource& source, PathRows& rows) {
  const nlohmann::json parsed = parseJson(text, source.name());
  const JsonPlace root{parsed, "", source.name()};
  if (!parsed.is_object()) throw InputError(source.name(), 0, "a path must be an object");
  JsonPlace{parsed, "the path", source.name()}.allowOnly(
      {"robot",        "group",           "planner",
       "tool",         "deviation",       "deviation_angle",
       "seed",         "margin",          "margin_self",
       "margin_world", "tolerance",       "clouds",
       "clock",        "joint_names",     "constraints",
       "lines",        "states",          "trajectory",
       "segments",     "nothing_checked", "links_without_geometry",
       "warnings",     "inputs",          "model",
       "proof"});
  const std::vector<JsonPlace> names = root.at("joint_names").elements();
  std::vector<std::string> texts;
  for (const JsonPlace& name : names) texts.push_back(name.text());
  rows.setColumns(
      texts, [&](std::size_t i, const std::string& message) { names[i].fail(message); },
      [&](const std::string& message) { throw InputError(source.name(), 0, message); });
  const std::vector<JsonPlace> states = root.at("states").elements();
  if (states.empty()) root.at("states").fail("has no state; one is needed");
  // Angles without limits are those of one turn, and mean the shorter way.
  for (const JsonPlace& state : states)
    rows.add(
        state.numbers(names.size()), 0,
        [&](const std::string& message) {
          throw InputError(source.name(), 0, state.name + ": " + message);
        },
        true);
}

}  // namespace swept::detail
