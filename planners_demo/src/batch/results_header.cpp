// SPDX-License-Identifier: BSD-3-Clause
#include "batch/results_header.hpp"

#include <unistd.h>

#include <array>
#include <ctime>
#include <fstream>
#include <iterator>

#include "swept/robot_model/input.hpp"
#include "verify/encoding.hpp"

namespace swept {
namespace {

/// SHA-256 of a file's bytes.
std::string fileDigest(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!stream) throw InputError(file, 0, "file cannot be read");
  return verify::digestOf(bytes);
}

constexpr const char* kFormat = "swept bench planners";
constexpr int kVersion = 1;

// A planner and its simplification have the time limit each, and what else there is is quick.
constexpr double kHardLimitBase = 30.0;  // s
constexpr double kHardLimitFactor = 5.0;

constexpr std::array kFields{"format", "version",    "swept",      "robot",     "urdf",     "srdf",
                             "group",  "problems",   "margin",     "tolerance", "pad",      "scale",
                             "allow",  "time_limit", "hard_limit", "simplify",  "clearance"};

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
                 {"urdf", fileDigest(args.robot)},
                 {"srdf", srdf.empty() ? Json(nullptr) : Json(fileDigest(srdf))},
                 {"group", batch.group},
                 {"problems", fileDigest(args.problems)},
                 {"margin", args.margin},
                 {"tolerance", args.tolerance},
                 {"pad", args.pads},
                 {"scale", args.scales},
                 {"allow", args.allowed},
                 {"attach", args.attached},
                 {"time_limit", args.time},
                 {"hard_limit", hardLimitOf(args)},
                 {"simplify", !args.noSimplify},
                 {"clearance", !args.batch.noClearance}};
  if (!args.batch.noTimes) header["time"] = startJson();
  return header;
}

void requireHeader(const Json& header, const std::string& source) {
  if (!header.is_object() || !header.contains("format") || header["format"] != kFormat)
    throw InputError(source, 1,
                     std::string("not a results file: the first line must be a header with the "
                                 "format \"") +
                         kFormat + "\"");
  for (const char* field : kFields)
    if (!header.contains(field))
      throw InputError(source, 1, std::string("the header has no ") + field);
  if (header["version"] != kVersion)
    throw InputError(source, 1,
                     "version is " + header["version"].dump() + "; this program reads " +
                         std::to_string(kVersion));
}

void requireSameHeader(const Json& header, const std::string& source, const Json& expected,
                       const std::string& where) {
  for (const char* field : kFields)
    if (header.at(field) != expected.at(field))
      throw InputError(source, 1,
                       std::string(field) + " is " + header.at(field).dump() + "; it is " +
                           expected.at(field).dump() + " " + where);
}

}  // namespace swept
