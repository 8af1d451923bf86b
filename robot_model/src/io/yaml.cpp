// SPDX-License-Identifier: BSD-3-Clause
#include "io/yaml.hpp"

#include <yaml-cpp/depthguard.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "io/yaml_documents.hpp"
#include "swept/robot_model/foreign_text.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

std::string listed(YamlPlace::Keys keys) {
  std::string text;
  for (auto key = keys.begin(); key != keys.end(); ++key) {
    if (key != keys.begin()) text += key + 1 == keys.end() ? " and " : ", ";
    text += *key;
  }
  return text;
}

/// 8 in YAML 1.1, 10 in YAML 1.2.
bool mayBeOctal(std::string_view number) {
  if (number.starts_with('+') || number.starts_with('-')) number.remove_prefix(1);
  return number.size() > 1 && number.front() == '0' &&
         number.find_first_not_of("0123456789") == std::string_view::npos;
}

/// What `parse` returns. The library's errors become InputErrors.
template <typename Parse>
auto parseWith(const InputSource& source, const Parse& parse) {
  try {
    return parse();
  } catch (const YAML::DeepRecursion& error) {
    source.fail(error.mark.line + 1, "malformed YAML: mappings and lists are nested too deeply");
  } catch (const YAML::Exception& error) {
    source.fail(error.mark.line + 1, "malformed YAML: " + foreignText(error.msg));
  }
}

}  // namespace

YamlPlace::YamlPlace(const YAML::Node& node, std::string name, int line, const InputSource* source)
    : node_(node), name_(std::move(name)), line_(line), source_(source) {
  // yaml-cpp counts lines from 0 and gives -1 for what is not in the text.
  if (node_.Mark().line >= 0) line_ = node_.Mark().line + 1;
}

YamlPlace YamlPlace::parse(const std::string& text, const InputSource& source) {
  return parseWith(source, [&]() -> YamlPlace {
    if (const auto line = lineOfSecondDocument(text))
      source.fail(*line, "a second document begins; one is allowed");
    return {YAML::Load(text), "", 1, &source};
  });
}

std::vector<YamlPlace> YamlPlace::parseAll(const std::string& text, const InputSource& source) {
  return parseWith(source, [&] {
    requireDocumentsEnd(text);
    std::vector<YamlPlace> documents;
    for (const YAML::Node& node : YAML::LoadAll(text))
      if (!node.IsNull()) documents.push_back({node, "", 1, &source});
    return documents;
  });
}

void YamlPlace::fail(const std::string& message) const {
  source_->fail(line_, name_.empty() ? message : name_ + " " + message);
}

void YamlPlace::warn(const std::string& message) const {
  source_->warn(line_, name_.empty() ? message : name_ + " " + message);
}

void YamlPlace::failAt(const YAML::Node& key, const std::string& message) const {
  source_->fail(key.Mark().line + 1, (name_.empty() ? "the file" : name_) + " " + message);
}

const YamlPlace& YamlPlace::allowOnly(Keys keys) const {
  if (!isMap()) return *this;
  std::vector<bool> seen(keys.size());
  for (const auto& entry : node_) {
    const YAML::Node& key = entry.first;
    if (!key.IsScalar()) failAt(key, "has a key that is not a single value");
    const auto known = std::find(keys.begin(), keys.end(), key.Scalar());
    if (known == keys.end()) {
      failAt(key, "has the unknown key '" + key.Scalar() + "'; allowed are " + listed(keys));
    }
    std::vector<bool>::reference mark = seen[static_cast<std::size_t>(known - keys.begin())];
    if (mark) failAt(key, "has the key '" + key.Scalar() + "' twice");
    mark = true;
  }
  return *this;
}

YamlPlace YamlPlace::called(std::string name) const {
  return {node_, std::move(name), line_, source_};
}

std::string YamlPlace::join(const std::string& part) const {
  if (name_.empty()) return part;
  return name_ + (name_.back() == ':' ? " " : part.front() == '[' ? "" : ".") + part;
}

YamlPlace YamlPlace::at(const std::string& key) const {
  if (!isMap()) fail("must be a mapping");
  const YAML::Node& self = node_;  // const: looking must not insert
  const YAML::Node entry = self[key];
  return {entry.IsDefined() ? entry : YAML::Node(), join(key), line_, source_};
}

std::vector<std::pair<YamlPlace, YamlPlace>> YamlPlace::entries() const {
  if (!present()) return {};
  if (!isMap()) fail("must be a mapping");
  std::vector<std::pair<YamlPlace, YamlPlace>> result;
  std::set<std::string> seen;
  for (const auto& entry : node_) {
    const YAML::Node& key = entry.first;
    if (!key.IsScalar()) failAt(key, "has a key that is not a single value");
    if (!seen.insert(key.Scalar()).second) failAt(key, "has the key '" + key.Scalar() + "' twice");
    result.push_back({{key, name_, line_, source_},
                      {entry.second, join(key.Scalar()), key.Mark().line + 1, source_}});
  }
  return result;
}

std::vector<YamlPlace> YamlPlace::elements() const {
  if (!present()) return {};
  if (!isSequence()) fail("must be a list");
  std::vector<YamlPlace> result;
  for (std::size_t i = 0; i < node_.size(); ++i) {
    result.push_back(
        {node_[i], join(std::string("[").append(std::to_string(i)).append("]")), line_, source_});
  }
  return result;
}

std::string YamlPlace::text() const {
  if (!present()) fail("is missing");
  if (!node_.IsScalar()) fail("must be a single value");
  return node_.Scalar();
}

double YamlPlace::number() const {
  const std::string given = text();
  const auto value = parseNumber(given);
  if (!value) fail("is '" + given + "'; it must be a finite number");
  if (mayBeOctal(given)) fail("is '" + given + "'; it must not begin with 0");
  return *value;
}

int YamlPlace::integer() const {
  const double value = number();
  if (!(std::abs(value) <= 2e9) || value != std::floor(value)) {
    fail("is '" + text() + "'; it must be a whole number");
  }
  return static_cast<int>(value);
}

bool YamlPlace::boolean() const {
  const std::string given = text();
  if (given == "true" || given == "True" || given == "1") return true;
  if (given == "false" || given == "False" || given == "0") return false;
  fail("is '" + given + "'; allowed are true and false");
}

std::vector<double> YamlPlace::numbers(Keys keys) const {
  std::vector<double> values;
  if (isMap()) {
    allowOnly(keys);
    for (const std::string_view key : keys) values.push_back(at(std::string(key)).number());
    return values;
  }
  if (!isSequence() || node_.size() != keys.size()) {
    std::string names;
    for (const std::string_view key : keys) names += (names.empty() ? "" : ", ") + std::string(key);
    fail("must be " + std::to_string(keys.size()) + " numbers [" + names + "]");
  }
  for (const YamlPlace& element : elements()) values.push_back(element.number());
  return values;
}

Eigen::Vector3d YamlPlace::vector() const {
  const auto values = numbers({"x", "y", "z"});
  return {values[0], values[1], values[2]};
}

Eigen::Matrix3d YamlPlace::rotation() const {
  const auto q = numbers({"x", "y", "z", "w"});
  const auto unit = unitQuaternion({q[0], q[1], q[2], q[3]});
  if (!unit) {
    const double norm = Eigen::Vector4d(q[0], q[1], q[2], q[3]).norm();
    fail("is a quaternion (x, y, z, w) of length " + formatNumber(norm) +
         "; it must be 1 to within 0.01");
  }
  return unit->toRotationMatrix();
}

Eigen::Isometry3d YamlPlace::pose(const char* translation, const char* rotation) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (!present()) return pose;
  allowOnly({translation, rotation});
  if (const YamlPlace p = at(translation); p.present()) pose.translation() = p.vector();
  if (const YamlPlace r = at(rotation); r.present()) pose.linear() = r.rotation();
  return pose;
}

}  // namespace swept::detail
