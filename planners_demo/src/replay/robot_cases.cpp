// SPDX-License-Identifier: BSD-3-Clause
#include "replay/robot_cases.hpp"

#include <array>
#include <utility>

#include "input/inputs.hpp"
#include "output/text_output.hpp"

namespace swept {
namespace {

constexpr std::array kVerdicts{Verdict::Free, Verdict::Collision, Verdict::Undecided};

Verdict readVerdict(const JsonValue& place) {
  const std::string text = place.text();
  for (const Verdict verdict : kVerdicts)
    if (text == toString(verdict)) return verdict;
  place.refuse("free, collision or undecided");
}

std::vector<double> readValues(const JsonValue& place, std::size_t joints) {
  std::vector<double> values;
  for (const JsonValue& item : joints == 0 ? place.elements() : place.elements(joints))
    values.push_back(item.number());
  return values;
}

void readFirstContact(const JsonValue& place, RobotQuestion& question) {
  const std::vector<JsonValue> ends = place.elements(2);
  question.contactAfter = ends[0].number();
  question.contactBy = ends[1].number();
  if (!(0.0 <= question.contactAfter && question.contactAfter <= question.contactBy &&
        question.contactBy <= 1.0))
    place.refuse("two times between 0 and 1, the earlier one first");
}

Json expectedJson(const RobotQuestion& question) {
  Json json = {{"verdict", toString(question.expected)}};
  if (question.states.size() == 2 && question.expected == Verdict::Collision)
    json["first_contact"] = {question.contactAfter, question.contactBy};
  return json;
}

}  // namespace

bool isRobotQuery(const std::string& query) {
  return query == "state" || query == "motion";
}

RobotQuestion readRobotQuestion(const std::string& query, const JsonValue& entry) {
  RobotQuestion question;
  question.inputs = inputsOf(entry.at("inputs"));
  if (entry.has("joint_names"))
    for (const JsonValue& name : entry.at("joint_names").elements())
      question.jointNames.push_back(name.text());
  const std::size_t joints = question.jointNames.size();
  if (query == "state") {
    question.states = {readValues(entry.at("state"), joints)};
    if (entry.has("time")) question.times = {entry.at("time").number()};
  } else {
    question.states = {readValues(entry.at("from"), joints), readValues(entry.at("to"), joints)};
    if (entry.has("times")) question.times = readValues(entry.at("times"), 2);
  }
  const JsonValue expected = entry.at("expected");
  question.expected = readVerdict(expected.at("verdict"));
  if (query == "motion" && expected.has("first_contact"))
    readFirstContact(expected.at("first_contact"), question);
  return question;
}

std::string robotCaseText(const std::string& id, const RobotQuestion& question,
                          const std::filesystem::path& file) {
  const bool motion = question.states.size() == 2;
  Json item = {{"id", id}, {"query", motion ? "motion" : "state"}};
  item["inputs"] = inputsJson(question.inputs, file);
  item["joint_names"] = question.jointNames;
  item[motion ? "from" : "state"] = toJson(question.states.front());
  if (motion) item["to"] = toJson(question.states.back());
  if (!question.times.empty())
    item[motion ? "times" : "time"] = motion ? toJson(question.times) : Json(question.times[0]);
  item["expected"] = expectedJson(question);
  std::string text = "{\"version\": 1, \"cases\": [{";
  for (const auto& [key, value] : item.items())
    text.append(text.back() == '{' ? "\n " : ",\n ")
        .append(Json(key).dump())
        .append(": ")
        .append(value.dump());
  return text + "}]}\n";
}

}  // namespace swept
