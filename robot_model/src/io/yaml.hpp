// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <initializer_list>
#include <string>
#include <vector>

#include "io/input_source.hpp"

namespace swept::detail {

/// A place in a YAML document, with what messages call it (`object 'can': primitive_poses[0]`). The
/// accessors are strict: each throws InputError with the place's line, the value seen and what is
/// allowed. An absent or null place counts as absent.
class YamlPlace {
 public:
  /// The whole document. Throws InputError when the text is no YAML.
  static YamlPlace parse(const std::string& text, const InputSource& source);

  // Assigning a YAML::Node rewires the document it belongs to; copies only refer to it.
  YamlPlace(const YamlPlace&) = default;
  YamlPlace& operator=(const YamlPlace&) = delete;

  bool present() const { return !node_.IsNull(); }
  bool isSequence() const { return node_.IsSequence(); }
  bool isMap() const { return node_.IsMap(); }
  int line() const { return line_; }
  [[noreturn]] void fail(const std::string& message) const;
  void warn(const std::string& message) const;

  /// Same place under another name for messages.
  YamlPlace called(std::string name) const;
  /// Entry `key` of a mapping; an error when this is none.
  YamlPlace at(const std::string& key) const;
  /// Elements of a list; none when absent, an error when this is no list.
  std::vector<YamlPlace> elements() const;

  std::string text() const;  ///< of a scalar
  double number() const;
  int integer() const;
  /// `count` numbers from a list or from the `keys` of a mapping.
  std::vector<double> numbers(std::initializer_list<const char*> keys) const;
  Eigen::Vector3d vector() const;
  /// Rotation and translation by these keys; what is absent is identity.
  Eigen::Isometry3d pose(const char* translation, const char* rotation) const;

 private:
  YamlPlace(const YAML::Node& node, std::string name, int line, const InputSource* source);
  std::string join(const std::string& part) const;

  YAML::Node node_;  ///< null when absent
  std::string name_;
  int line_;  ///< its own, or that of what it should stand in
  const InputSource* source_;
};

}  // namespace swept::detail
