// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "swept/robot_model/foreign_text.hpp"
#include "swept/robot_model/input.hpp"

namespace swept::detail {

/// A value of the file, and the path to it, which messages name: `set 'cage' problem 3:
/// world.box[1].name`.
struct JsonPlace {
  const nlohmann::json& value;
  std::string name;
  const std::string& file;

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(file, 0, name + " " + message);
  }
  std::string join(const std::string& key) const {
    return name + (name.empty() ? "" : name.back() == ':' ? " " : ".") + key;
  }
  JsonPlace at(const std::string& key) const {
    if (!value.is_object()) fail("must be an object");
    const auto found = value.find(key);
    if (found == value.end()) throw InputError(file, 0, join(key) + " is missing");
    return {*found, join(key), file};
  }
  void allowOnly(std::initializer_list<std::string_view> keys) const {
    if (!value.is_object()) return;
    for (const auto& [key, ignored] : value.items()) {
      if (std::ranges::find(keys, key) != keys.end()) continue;
      std::string allowed;
      for (const std::string_view known : keys) {
        if (!allowed.empty()) allowed += known == *(keys.end() - 1) ? " and " : ", ";
        allowed += known;
      }
      fail("has the unknown key '" + key + "'; allowed are " + allowed);
    }
  }
  std::vector<JsonPlace> elements() const {
    if (!value.is_array()) fail("must be a list");
    std::vector<JsonPlace> result;
    for (std::size_t i = 0; i < value.size(); ++i) {
      result.push_back({value[i], name + "[" + std::to_string(i) + "]", file});
    }
    return result;
  }
  std::string shown() const { return foreignText(value.dump()); }
  std::string text() const {
    if (!value.is_string()) fail("is " + shown() + "; it must be text");
    return value.get<std::string>();
  }
  double number() const {
    if (!value.is_number()) fail("is " + shown() + "; it must be a finite number");
    return value.get<double>();
  }
  double notNegative() const {
    const double given = number();
    if (!(given >= 0.0)) fail("is " + shown() + "; it must be 0 or greater");
    return given;
  }
  std::vector<double> numbers(std::size_t count) const {
    const auto items = elements();
    if (items.size() != count) {
      fail("holds " + std::to_string(items.size()) + " values; it must hold " +
           std::to_string(count));
    }
    std::vector<double> values;
    for (const JsonPlace& item : items) values.push_back(item.number());
    return values;
  }
};

/// Throws InputError for text that is no JSON, is nested too deeply, or has a key twice in one
/// object.
nlohmann::json parseJson(const std::string& text, const std::string& file);

}  // namespace swept::detail
