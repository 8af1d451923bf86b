// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <yaml-cpp/yaml.h>

#include <Eigen/Geometry>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/input_source.hpp"

namespace swept::detail {

/// A place in a YAML document, with what messages call it (`object 'can': primitive_poses[0]`). The
/// accessors are strict: each throws InputError with the place's line, the value seen and what is
/// allowed. An absent or null place counts as absent.
class YamlPlace {
 public:
  /// The whole document. Throws InputError when the text is no YAML, or has several documents.
  static YamlPlace parse(const std::string& text, const InputSource& source);
  /// All documents that are not empty. Throws InputError when the text is no YAML.
  static std::vector<YamlPlace> parseAll(const std::string& text, const InputSource& source);

  // Assigning a YAML::Node rewires the document it belongs to; copies only refer to it.
  YamlPlace(const YamlPlace&) = default;
  YamlPlace& operator=(const YamlPlace&) = delete;

  bool present() const { return !node_.IsNull(); }
  bool isSequence() const { return node_.IsSequence(); }
  bool isMap() const { return node_.IsMap(); }
  int line() const { return line_; }
  const std::string& name() const { return name_; }  ///< for messages; empty: the whole document
  [[noreturn]] void fail(const std::string& message) const;
  void warn(const std::string& message) const;

  using Keys = std::initializer_list<std::string_view>;
  /// Fails for a key of a mapping that is not among these, and for one that it has twice: what is
  /// misspelt would be ignored without a word. This, for chains; any but a mapping passes.
  const YamlPlace& allowOnly(Keys keys) const;

  /// Same place under another name for messages.
  YamlPlace called(std::string name) const;
  /// Entry `key` of a mapping; an error when this is none.
  YamlPlace at(const std::string& key) const;
  /// Keys and values of a mapping of any keys, as in the file; none when absent, an error when this
  /// is no mapping, and for a key that it has twice. A key's name for messages is the mapping's.
  std::vector<std::pair<YamlPlace, YamlPlace>> entries() const;
  /// Elements of a list; none when absent, an error when this is no list.
  std::vector<YamlPlace> elements() const;

  std::string text() const;  ///< of a scalar
  /// One that is finite and decimal. What YAML takes for a number besides (`.inf`, `0x10`, `1_000`,
  /// `1:30`), and `010`, which is 8 to some readers, is refused.
  double number() const;
  int integer() const;
  bool boolean() const;  ///< `true` or `false`, as Python prints them (`True`) or as 1 or 0
  /// `count` numbers from a list or from the `keys` of a mapping.
  std::vector<double> numbers(Keys keys) const;
  Eigen::Vector3d vector() const;
  /// A quaternion x, y, z, w of length 1 to within 0.01.
  Eigen::Matrix3d rotation() const;
  /// Rotation and translation by these keys, the only ones; what is absent is identity.
  Eigen::Isometry3d pose(const char* translation, const char* rotation) const;

 private:
  YamlPlace(const YAML::Node& node, std::string name, int line, const InputSource* source);
  std::string join(const std::string& part) const;
  [[noreturn]] void failAt(const YAML::Node& key, const std::string& message) const;

  YAML::Node node_;  ///< null when absent
  std::string name_;
  int line_;  ///< its own, or that of what it should stand in
  const InputSource* source_;
};

}  // namespace swept::detail
