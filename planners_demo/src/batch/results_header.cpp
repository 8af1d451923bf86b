// SPDX-License-Identifier: BSD-3-Clause
#include "batch/results_header.hpp"

#include <unistd.h>

#include <array>
#include <ctime>
#include <fstream>
#include <iterator>
#include <string_view>

#include "input/read_again.hpp"
#include "input/work_cells.hpp"
#include "swept/robot_model/input.hpp"
#include "verify/encoding.hpp"

namespace swept {
namespace {

/// SHA-256 of a file's bytes.
std::string fileDigest(const std::string& file) {
  requireReadAgain(file);
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw InputError(file, 0, "file cannot be read");
  return verify::digestOf(bytes);
}

constexpr const char* kFormat = "swept bench planners";
constexpr int kVersion = 1;
constexpr const char* kWithoutContacts = "without_default_contacts";

// The planner and the simplification have the time limit each, and the rest is quick.
constexpr double kHardLimitBase = 30.0;  // s
constexpr double kHardLimitFactor = 5.0;

void requireText(const JsonValue& place) {
  place.text();
}

void requireTextOrNull(const JsonValue& place) {
  if (!place.isNull()) place.text();
}

void requireTexts(const JsonValue& place) {
  for (const JsonValue& item : place.elements()) item.text();
}

void requireNumber(const JsonValue& place) {
  place.notNegative();
}

void requireTruth(const JsonValue& place) {
  place.boolean();
}

/// The fields that headers must have in common: all that resultsHeader() writes except `time`.
struct Field {
  const char* name;
  void (*require)(const JsonValue&);
};
constexpr std::array kFields{
    Field{"format", requireText},         Field{"version", requireNumber},
    Field{"swept", requireText},          Field{"robot", requireText},
    Field{"urdf", requireText},           Field{"srdf", requireTextOrNull},
    Field{"group", requireText},          Field{"problems", requireText},
    Field{"margin", requireNumber},       Field{"margin_self", requireNumber},
    Field{"margin_world", requireNumber}, Field{"tolerance", requireNumber},
    Field{"pad", requireTexts},           Field{"scale", requireTexts},
    Field{"allow", requireTexts},         Field{"attach", requireTexts},
    Field{"stand", requireTexts},         Field{kWithoutContacts, requireTruth},
    Field{"time_limit", requireNumber},   Field{"hard_limit", requireNumber},
    Field{"simplify", requireTruth},      Field{"clearance", requireTruth}};

/// Completes an older header. Files from before --attach lack that field, and files without --stand
/// that one. Files older than the
/// fields for contacts and for the two margins mean that no contacts of robots without an SRDF are
/// left out, and that both kinds of pairs have the margin `margin`.
bool isOptional(std::string_view field) {
  return field == "attach" || field == "stand" || field == kWithoutContacts ||
         field == "margin_self" || field == "margin_world";
}

Json valueOf(const Json& header, std::string_view field) {
  if (!isOptional(field) || header.contains(field)) return header.at(field);
  if (field == "attach" || field == "stand") return Json::array();
  return field == kWithoutContacts ? Json(false) : header.at("margin");
}

void requireTypes(const Json& header, const std::string& source) {
  const nlohmann::json unordered(header);
  const JsonValue whole(unordered, "", source);
  for (const Field& field : kFields)
    if (whole.has(field.name)) field.require(whole.at(field.name));
  if (!whole.has("time")) return;
  const JsonValue time = whole.at("time");
  if (!time.isObject()) time.fail("must be an object");
  for (const char* note : {"host", "started"})
    if (time.has(note)) requireText(time.at(note));
}

Json startJson() {
  std::array<char, 256> host{};
  if (gethostname(host.data(), host.size() - 1) != 0) host[0] = '\0';
  std::array<char, 40> date{};
  const std::time_t now = std::time(nullptr);
  std::tm parts = {};
  gmtime_r(&now, &parts);
  std::strftime(date.data(), date.size(), "%Y-%m-%d %H:%M:%S", &parts);
  return {{"host", host.data()}, {"started", std::string(date.data()) + " UTC"}};
}

}  // namespace

double hardLimitOf(const Arguments& args) {
  return args.batch.hardLimit.value_or(kHardLimitBase + kHardLimitFactor * args.time);
}

Json resultsHeader(const Batch& batch) {
  const Arguments& args = *batch.args;
  const std::string& srdf = batch.model.srdf.file;
  Json header = {{"format", kFormat},
                 {"version", kVersion},
                 {"swept", SWEPT_VERSION},
                 {"robot", batch.model.robot->name()},
                 {"urdf", args.xacro || isWorkCell(args) ? verify::digestOf(batch.model.urdf->text)
                                                         : fileDigest(args.robot)},
                 {"srdf", srdf.empty() ? Json(nullptr) : Json(fileDigest(srdf))},
                 {"group", batch.group},
                 {"problems", fileDigest(args.problems)},
                 {"margin", args.margin}};
  if (!args.standing.empty()) header["stand"] = args.standing;
  if (args.selfMargin) header["margin_self"] = *args.selfMargin;
  if (args.worldMargin) header["margin_world"] = *args.worldMargin;
  header.update({{"tolerance", args.tolerance},
                 {"pad", args.pads},
                 {"scale", args.scales},
                 {"allow", args.allowed},
                 {kWithoutContacts, leavesOutDefaultContacts(args)},
                 {"attach", args.attached},
                 {"time_limit", args.time},
                 {"hard_limit", hardLimitOf(args)},
                 {"simplify", !args.noSimplify},
                 {"clearance", !args.batch.noClearance}});
  if (!args.batch.noTimes) header["time"] = startJson();
  // As it will be read back, with invalid names repaired.
  return Json::parse(lineOf(header));
}

void requireHeader(const Json& header, const std::string& source) {
  if (!header.is_object() || !header.contains("format") || header["format"] != kFormat)
    throw InputError(source, 1,
                     std::string("not a results file: the first line must be a header with the "
                                 "format \"") +
                         kFormat + "\"");
  for (const Field& field : kFields)
    if (!header.contains(field.name) && !isOptional(field.name))
      throw InputError(source, 1, std::string("the header has no ") + field.name);
  if (header["version"] != kVersion)
    throw InputError(source, 1,
                     "version is " + lineOf(header["version"]) + "; this program reads " +
                         std::to_string(kVersion));
  try {
    requireTypes(header, source);
  } catch (const InputError& error) {
    throw InputError(source, 1, error.message());
  }
}

void requireSameHeader(const Json& header, const std::string& source, const Json& expected,
                       const std::string& where) {
  for (const Field& field : kFields) {
    const Json own = valueOf(header, field.name), other = valueOf(expected, field.name);
    if (own != other)
      throw InputError(source, 1,
                       std::string(field.name) + " is " + lineOf(own) + "; it is " + lineOf(other) +
                           " " + where);
  }
}

}  // namespace swept
