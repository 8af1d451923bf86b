// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>
#include <string_view>

#include "io/srdf.hpp"
#include "io/xml_places.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/allowed_collision_matrix.hpp"

namespace swept {

namespace {

using detail::XmlPlaces;

/// Empty for pairs that are not to be disabled.
std::string_view reasonOf(PairStatus status) {
  switch (status) {
    case PairStatus::Adjacent:
      return "Adjacent";
    case PairStatus::Never:
      return "Never";
    case PairStatus::Default:
      return "Default";
    case PairStatus::Always:
      return "Always";
    case PairStatus::Unknown:
    case PairStatus::MayCollide:
      break;
  }
  return {};
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

using Names = std::pair<std::string, std::string>;

Names ordered(const std::string& a, const std::string& b) {
  return {std::min(a, b), std::max(a, b)};
}

std::vector<std::string> elementsFor(const Robot& robot, std::span<const LinkPairReport> pairs,
                                     const std::set<Names>& enabled) {
  std::vector<std::string> elements;
  for (const LinkPairReport& pair : pairs) {
    const std::string_view reason = reasonOf(pair.status);
    const std::string& a = robot.links()[pair.linkA].name;
    const std::string& b = robot.links()[pair.linkB].name;
    if (reason.empty() || enabled.contains(ordered(a, b))) continue;
    elements.push_back("<disable_collisions link1=\"" + escaped(a) + "\" link2=\"" + escaped(b) +
                       "\" reason=\"" + std::string(reason) + "\"/>");
  }
  return elements;
}

std::string inLines(const std::vector<std::string>& elements, const std::string& indent,
                    const std::string& end) {
  std::string text;
  for (const std::string& element : elements) text.append(indent).append(element).append(end);
  return text;
}

/// Replaces the elements with these numbers by the new ones.
std::string replaced(const std::string& text, const XmlPlaces& places,
                     const std::vector<std::size_t>& numbers,
                     const std::vector<std::string>& elements) {
  std::string result;
  std::size_t done = 0;
  for (const std::size_t number : numbers) {
    const XmlPlaces::Range range = places.elements[number];
    const XmlPlaces::Range line = wholeLine(text, range);
    const bool alone = line.begin != range.begin || line.end != range.end;
    const XmlPlaces::Range out = alone ? line : range;
    result.append(text, done, out.begin - done);
    if (number == numbers.front()) {
      const std::string end = text.substr(range.end, line.end - range.end);
      result += alone ? inLines(elements, text.substr(line.begin, range.begin - line.begin), end)
                      : inLines(elements, "", "");
    }
    done = out.end;
  }
  return result.append(text, done);
}

std::string appended(const std::string& text, const XmlPlaces& places,
                     const std::vector<std::string>& elements) {
  if (elements.empty()) return text;
  const std::string lines = inLines(elements, "  ", "\n");
  if (places.rootIsEmpty) {
    // <robot .../> becomes <robot ...> with a closing tag.
    const std::size_t slash = text.rfind('/', places.rootEnd.begin);
    return text.substr(0, slash) + ">\n" + lines + "</robot>" + text.substr(places.rootEnd.end);
  }
  const std::size_t lineStart = text.rfind('\n', places.rootEnd.begin);
  const std::size_t indent = lineStart == std::string::npos ? 0 : lineStart + 1;
  const bool alone = text.find_first_not_of(" \t", indent) == places.rootEnd.begin && indent > 0;
  const std::size_t at = alone ? indent : places.rootEnd.begin;
  return text.substr(0, at) + (alone ? "" : "\n") + lines + text.substr(at);
}

}  // namespace

std::string srdfWithPairs(const Robot& robot, std::span<const LinkPairReport> pairs,
                          const std::string& srdfText, const std::string& srdfName) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, pairs] { return srdfWithPairs(robot, pairs, srdfText, srdfName); });
  }
  if (srdfText.empty()) {
    return "<?xml version=\"1.0\"?>\n<robot name=\"" + escaped(robot.name()) + "\">\n" +
           inLines(elementsFor(robot, pairs, {}), "  ", "\n") + "</robot>\n";
  }
  const detail::InputSource source(srdfName, {});
  const detail::SrdfDocument document = detail::readSrdf(srdfText, source);
  const XmlPlaces places = detail::placesOf(srdfText, "disable_collisions");
  std::set<Names> enabled;
  std::vector<std::size_t> known;  // elements that name links the robot has
  std::size_t number = 0;
  for (const auto& pair : document.pairs) {
    if (pair.enable) {
      enabled.insert(ordered(pair.link1, pair.link2));
      continue;
    }
    if (robot.findLink(pair.link1) && robot.findLink(pair.link2)) known.push_back(number);
    ++number;
  }
  if (number != places.elements.size() || !places.rootFound)
    source.fail(1, "its <disable_collisions> elements cannot be told apart");
  const std::vector<std::string> elements = elementsFor(robot, pairs, enabled);
  return known.empty() ? appended(srdfText, places, elements)
                       : replaced(srdfText, places, known, elements);
}

}  // namespace swept
