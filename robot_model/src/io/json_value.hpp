// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace swept {

/// A whole file, keys in the order of the file. Throws InputError; messages about its syntax name
/// the line.
nlohmann::ordered_json parseOrderedJson(const std::string& file);

/// A value of a JSON file, and the path to it, which messages name: `case 'a': shapes[0].size`.
/// Each function throws InputError if the value is not of the kind that is asked for.
class JsonValue {
 public:
  /// `file` and `value` must outlive this.
  JsonValue(const nlohmann::json& value, std::string name, const std::string& file)
      : value_(&value), name_(std::move(name)), file_(&file) {}

  /// The whole file, as JSON. Messages about its syntax name the line.
  static nlohmann::json parseFile(const std::string& file);

  /// `NAME is VALUE; it must be WHAT`.
  [[noreturn]] void refuse(const std::string& what) const;
  /// `NAME MESSAGE`.
  [[noreturn]] void fail(const std::string& message) const;

  /// The same value under another name.
  JsonValue renamed(const std::string& name) const { return {*value_, name, *file_}; }
  bool has(const std::string& key) const { return value_->is_object() && value_->contains(key); }
  JsonValue at(const std::string& key) const;
  std::vector<JsonValue> elements() const;
  std::vector<JsonValue> elements(std::size_t count) const;

  const std::string& file() const { return *file_; }
  bool isObject() const { return value_->is_object(); }
  bool isText() const { return value_->is_string(); }
  bool isNull() const { return value_->is_null(); }
  bool boolean() const;
  std::string text() const;
  double number() const;
  double notNegative() const;
  /// A whole number, both bounds included.
  std::int64_t whole(std::int64_t low, std::int64_t high) const;
  Eigen::Vector3d vector3() const;

 private:
  const nlohmann::json* value_;
  std::string name_;
  const std::string* file_;
};

}  // namespace swept
