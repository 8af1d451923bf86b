// SPDX-License-Identifier: BSD-3-Clause
#include "io/yaml.hpp"

#include <yaml-cpp/depthguard.h>

#include <cmath>
#include <utility>

#include "io/numbers.hpp"

namespace swept::detail {

YamlPlace::YamlPlace(const YAML::Node& node, std::string name, int line, const InputSource* source)
    : node_(node), name_(std::move(name)), line_(line), source_(source) {
  // yaml-cpp counts lines from 0 and gives -1 for what is not in the text.
  if (node_.Mark().line >= 0) line_ = node_.Mark().line + 1;
}

YamlPlace YamlPlace::parse(const std::string& text, const InputSource& source) {
  try {
    return {YAML::Load(text), "", 1, &source};
  } catch (const YAML::DeepRecursion& error) {
    source.fail(error.mark.line + 1, "malformed YAML: mappings and lists are nested too deeply");
  } catch (const YAML::Exception& error) {
    source.fail(error.mark.line + 1, "malformed YAML: " + error.msg);
  }
}

void YamlPlace::fail(const std::string& message) const {
  source_->fail(line_, name_.empty() ? message : name_ + " " + message);
}

void YamlPlace::warn(const std::string& message) const {
  source_->warn(line_, name_.empty() ? message : name_ + " " + message);
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
  return *value;
}

int YamlPlace::integer() const {
  const double value = number();
  if (!(std::abs(value) <= 2e9) || value != std::floor(value)) {
    fail("is '" + text() + "'; it must be a whole number");
  }
  return static_cast<int>(value);
}

std::vector<double> YamlPlace::numbers(std::initializer_list<const char*> keys) const {
  std::vector<double> values;
  if (isMap()) {
    for (const char* key : keys) values.push_back(at(key).number());
    return values;
  }
  if (!isSequence() || node_.size() != keys.size()) {
    std::string names;
    for (const char* key : keys) names += (names.empty() ? "" : ", ") + std::string(key);
    fail("must be " + std::to_string(keys.size()) + " numbers [" + names + "]");
  }
  for (const YamlPlace& element : elements()) values.push_back(element.number());
  return values;
}

Eigen::Vector3d YamlPlace::vector() const {
  const auto values = numbers({"x", "y", "z"});
  return {values[0], values[1], values[2]};
}

Eigen::Isometry3d YamlPlace::pose(const char* translation, const char* rotation) const {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (!present()) return pose;
  if (const YamlPlace p = at(translation); p.present()) pose.translation() = p.vector();
  if (const YamlPlace r = at(rotation); r.present()) {
    const auto q = r.numbers({"x", "y", "z", "w"});
    const auto unit = unitQuaternion({q[0], q[1], q[2], q[3]});
    if (!unit) {
      const double norm = Eigen::Vector4d(q[0], q[1], q[2], q[3]).norm();
      r.fail("is a quaternion (x, y, z, w) of length " + formatNumber(norm) +
             "; it must be 1 to within 0.01");
    }
    pose.linear() = unit->toRotationMatrix();
  }
  return pose;
}

}  // namespace swept::detail
