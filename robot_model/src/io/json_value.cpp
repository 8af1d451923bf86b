// SPDX-License-Identifier: BSD-3-Clause
#include "io/json_value.hpp"

#include <algorithm>

#include "swept/robot_model/foreign_text.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

using nlohmann::json;

/// Without the library's own name and place in front.
std::string reasonOf(const json::exception& error, std::string_view front) {
  const std::string what = error.what();
  const auto at = what.find(front);
  return foreignText(at == std::string::npos ? what : what.substr(at + front.size()));
}

template <typename Value>
Value parsed(const std::string& file) {
  const std::string text = readTextFile(file);
  requireModestJson(text, file);
  try {
    return Value::parse(text);
  } catch (const json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw InputError(file, static_cast<int>(line), "malformed JSON: " + reasonOf(error, ": "));
  } catch (const json::exception& error) {  // a number beyond every double
    throw InputError(file, 0, "malformed JSON: " + reasonOf(error, "] "));
  }
}

}  // namespace

nlohmann::ordered_json parseOrderedJson(const std::string& file) {
  return parsed<nlohmann::ordered_json>(file);
}

json JsonValue::parseFile(const std::string& file) {
  return parsed<json>(file);
}

void JsonValue::refuse(const std::string& what) const {
  fail("is " + foreignText(value_->dump()) + "; it must be " + what);
}

void JsonValue::fail(const std::string& message) const {
  throw InputError(*file_, 0, name_ + " " + message);
}

JsonValue JsonValue::at(const std::string& key) const {
  if (!value_->is_object()) fail("must be an object");
  const std::string name = name_ + (name_.empty() ? "" : name_.back() == ':' ? " " : ".") + key;
  const auto found = value_->find(key);
  if (found == value_->end()) throw InputError(*file_, 0, name + " is missing");
  return {*found, name, *file_};
}

std::vector<JsonValue> JsonValue::elements() const {
  if (!value_->is_array()) fail("must be a list");
  std::vector<JsonValue> items;
  for (std::size_t i = 0; i < value_->size(); ++i)
    items.emplace_back((*value_)[i], name_ + "[" + std::to_string(i) + "]", *file_);
  return items;
}

std::vector<JsonValue> JsonValue::elements(std::size_t count) const {
  std::vector<JsonValue> items = elements();
  if (items.size() != count)
    fail("holds " + std::to_string(items.size()) + " values; it must hold " +
         std::to_string(count));
  return items;
}

bool JsonValue::boolean() const {
  if (!value_->is_boolean()) refuse("true or false");
  return value_->get<bool>();
}

std::string JsonValue::text() const {
  if (!value_->is_string()) refuse("text");
  return value_->get<std::string>();
}

double JsonValue::number() const {
  if (!value_->is_number()) refuse("a finite number");
  return value_->get<double>();
}

double JsonValue::notNegative() const {
  const double given = number();
  if (!(given >= 0.0)) refuse("0 or more");
  return given;
}

std::int64_t JsonValue::whole(std::int64_t low, std::int64_t high) const {
  // Beyond every signed number: read as unsigned, and too large for any bound.
  const bool fits = value_->is_number_integer() &&
                    (!value_->is_number_unsigned() || value_->get<std::uint64_t>() <= INT64_MAX);
  if (!fits || value_->get<std::int64_t>() < low || value_->get<std::int64_t>() > high)
    refuse("a whole number between " + std::to_string(low) + " and " + std::to_string(high));
  return value_->get<std::int64_t>();
}

Eigen::Vector3d JsonValue::vector3() const {
  const std::vector<JsonValue> items = elements(3);
  return {items[0].number(), items[1].number(), items[2].number()};
}

}  // namespace swept
