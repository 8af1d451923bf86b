// SPDX-License-Identifier: BSD-3-Clause
#include "io/scene_matrix.hpp"

#include <algorithm>
#include <stdexcept>

#include "rules/name_pattern.hpp"

namespace swept::detail {

namespace {

constexpr const char* kReason = "the scene's collision matrix";

void requireCount(const YamlPlace& list, std::size_t count, std::size_t wanted,
                  const std::string& of) {
  if (count == wanted) return;
  list.fail("has " + std::to_string(count) + " entries for " + std::to_string(wanted) + " " + of);
}

/// Writes the rules that are needed.
class Writer {
 public:
  explicit Writer(const SceneMatrix& matrix) : matrix_(matrix) {}

  /// Whatever the SRDF and the robot's joints say of these links.
  void links(const std::string& a, const std::string& b) {
    if (matrix_.isEmpty()) return;
    requireName(a);
    requireName(b);
    if (matrix_.allows(a, b))
      rules_.allow(a, b, kReason);
    else
      rules_.check(a, b, kReason);
  }
  /// The two are checked unless a rule says otherwise.
  void pair(const std::string& a, const std::string& b) {
    if (!matrix_.isEmpty() && matrix_.allows(a, b)) links(a, b);
  }
  void touching(const std::string& a, const std::string& b) {
    requireName(a);
    requireName(b);
    rules_.allow(a, b, "touch link of " + a);
  }
  CollisionRules rules() { return std::move(rules_); }

 private:
  static void requireName(const std::string& name) {
    if (isPattern(name))
      throw std::invalid_argument("speaks of '" + name + "'; a name with a '*' is not supported");
  }
  const SceneMatrix& matrix_;
  CollisionRules rules_;
};

}  // namespace

SceneMatrix::SceneMatrix(const YamlPlace& matrix) {
  if (!matrix.present()) return;
  if (!matrix.isMap()) matrix.fail("must be a mapping");
  matrix.allowOnly({"entry_names", "entry_values", "default_entry_names", "default_entry_values"});
  readEntries(matrix.at("entry_names"), matrix.at("entry_values"));
  readDefaults(matrix.at("default_entry_names"), matrix.at("default_entry_values"));
}

void SceneMatrix::readEntries(const YamlPlace& names, const YamlPlace& rows) {
  const std::vector<YamlPlace> given = names.elements();
  for (const YamlPlace& name : given)
    if (!places_.emplace(name.text(), places_.size()).second)
      name.fail("is '" + name.text() + "' a second time");
  const std::vector<YamlPlace> values = rows.elements();
  requireCount(rows, values.size(), given.size(), "entry_names");
  for (const YamlPlace& row : values) {
    row.allowOnly({"enabled"});
    const YamlPlace enabled = row.isMap() ? row.at("enabled") : row;
    const std::vector<YamlPlace> cells = enabled.elements();
    requireCount(enabled, cells.size(), given.size(), "entry_names");
    std::vector<bool>& line = allowed_.emplace_back();
    for (std::size_t j = 0; j < cells.size(); ++j) {
      line.push_back(cells[j].boolean());
      const std::size_t i = allowed_.size() - 1;
      if (j < i && line[j] != allowed_[j][i])
        cells[j].fail("is " + cells[j].text() + " and the other way round is not: '" +
                      given[i].text() + "' and '" + given[j].text() + "'");
    }
  }
}

void SceneMatrix::readDefaults(const YamlPlace& names, const YamlPlace& values) {
  const std::vector<YamlPlace> given = names.elements();
  const std::vector<YamlPlace> flags = values.elements();
  requireCount(values, flags.size(), given.size(), "default_entry_names");
  for (std::size_t i = 0; i < given.size(); ++i)
    if (!defaults_.emplace(given[i].text(), flags[i].boolean()).second)
      given[i].fail("is '" + given[i].text() + "' a second time");
}

std::optional<bool> SceneMatrix::defaultOf(const std::string& name) const {
  const auto found = defaults_.find(name);
  return found == defaults_.end() ? std::nullopt : std::optional<bool>(found->second);
}

bool SceneMatrix::allows(const std::string& a, const std::string& b) const {
  const auto placeA = places_.find(a);
  const auto placeB = places_.find(b);
  // The diagonal is not read: a link and an object of the world may have one name.
  if (a != b && placeA != places_.end() && placeB != places_.end())
    return allowed_[placeA->second][placeB->second];
  const std::optional<bool> defaultA = defaultOf(a);
  const std::optional<bool> defaultB = defaultOf(b);
  if (!defaultA && !defaultB) return false;
  return defaultA.value_or(true) && defaultB.value_or(true);
}

CollisionRules rulesOf(const SceneMatrix& matrix, const Robot& robot,
                       const std::vector<AttachedBody>& attached, const World& world,
                       const NamePairs& touching) {
  Writer writer(matrix);
  const auto count = static_cast<int>(robot.links().size());
  for (int i = 0; i < count; ++i) {
    const Link& link = robot.links()[static_cast<std::size_t>(i)];
    if (link.collision.empty()) continue;
    for (int j = i + 1; j < count; ++j) {
      const Link& other = robot.links()[static_cast<std::size_t>(j)];
      if (!other.collision.empty()) writer.links(link.name, other.name);
    }
    for (const AttachedBody& body : attached)
      if (body.link != link.name &&
          std::ranges::find(body.touchLinks, link.name) == body.touchLinks.end())
        writer.pair(link.name, body.name);
    for (const WorldBody& body : world.bodies()) writer.pair(link.name, body.name);
    for (const MovingObstacle& body : world.obstacles()) writer.pair(link.name, body.name);
  }
  for (auto body = attached.begin(); body != attached.end(); ++body) {
    for (const WorldBody& obstacle : world.bodies()) writer.pair(body->name, obstacle.name);
    for (const MovingObstacle& obstacle : world.obstacles()) writer.pair(body->name, obstacle.name);
    for (auto other = body + 1; other != attached.end(); ++other)
      if (other->link != body->link) writer.pair(body->name, other->name);
  }
  for (const auto& [a, b] : touching) writer.touching(a, b);
  return writer.rules();
}

}  // namespace swept::detail
