// SPDX-License-Identifier: BSD-3-Clause
#include "output/text_output.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "swept/robot_model/usage_error.hpp"
#include "text/escaped_text.hpp"
#include "text/numbers.hpp"

namespace swept {
namespace {

bool isUtf8(const std::string& text) {
  const auto with = [&](Json::error_handler_t handler) {
    return Json(text).dump(-1, ' ', false, handler);
  };
  return with(Json::error_handler_t::ignore) == with(Json::error_handler_t::replace);
}

}  // namespace

std::string shortNumber(double value) {
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.6g", value);
  return buffer.data();
}

std::string secondsText(double seconds) {
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.3g s", seconds);
  return buffer.data();
}

std::string exactNumber(double value) {
  return detail::formatNumber(value);
}

std::string countedText(std::size_t count, const std::string& what, const std::string& several) {
  const std::string number = std::to_string(count) + " ";
  if (count == 1) return number + what;
  return number + (several.empty() ? what + "s" : several);
}

std::string lengthText(double metres) {
  // Adding zero turns -0 into 0.
  return shortNumber(std::round(metres * 1e12) / 1e12 + 0.0);
}

std::string pointText(const Eigen::Vector3d& point) {
  return "[" + lengthText(point.x()) + " " + lengthText(point.y()) + " " + lengthText(point.z()) +
         "]";
}

std::string joined(std::span<const std::string> items, const std::string& separator) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : separator) + item;
  return text;
}

std::string csvCell(const std::string& text) {
  // Readers leave blanks at the ends away.
  const auto isBlank = [](char c) { return c == ' ' || c == '\t'; };
  const bool hasEnd = !text.empty() && (isBlank(text.front()) || isBlank(text.back()));
  if (!hasEnd && text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

bool keepsApart(const Witness& witness) {
  return witness.margin > 0.0 && witness.distance > 0.0;
}

bool keepApart(std::span<const Witness> contacts) {
  return !contacts.empty() && std::ranges::all_of(contacts, keepsApart);
}

std::string witnessText(const Witness& witness) {
  return escapedLine(witness.bodyA + " - " + witness.bodyB) + ": distance " +
         lengthText(witness.distance) + " m, " +
         (keepsApart(witness) ? "closer than the margin of " + lengthText(witness.margin) + " m, "
                              : "") +
         "at " + pointText(witness.pointA) + " and " + pointText(witness.pointB);
}

Json finiteOrNull(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json toJson(const Eigen::Vector3d& point) {
  return Json::array({point.x(), point.y(), point.z()});
}

Json toJson(std::span<const double> values) {
  Json array = Json::array();
  for (const double value : values) array.push_back(finiteOrNull(value));
  return array;
}

Json toJson(const Witness& witness) {
  return {{"t", witness.t},
          {"body_a", witness.bodyA},
          {"body_b", witness.bodyB},
          {"point_a", toJson(witness.pointA)},
          {"point_b", toJson(witness.pointB)},
          {"distance", finiteOrNull(witness.distance)},
          {"margin", witness.margin}};
}

std::string dumped(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace);
}

std::string lineOf(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

void requireUtf8(const Json& json, const std::string& where) {
  const auto require = [&](const std::string& text) {
    if (!isUtf8(text))
      throw UsageError(where + ": the name '" + text +
                       "' is not UTF-8, which all text in the file has to be");
  };
  if (json.is_string()) require(json.get_ref<const std::string&>());
  if (!json.is_structured()) return;
  for (const auto& [key, value] : json.items()) {
    require(key);
    requireUtf8(value, where);
  }
}

}  // namespace swept
