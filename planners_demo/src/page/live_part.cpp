// SPDX-License-Identifier: BSD-3-Clause
#include "page/live_part.hpp"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "command_line/commands.hpp"
#include "input/inputs.hpp"
#include "input/state_lists.hpp"
#include "input/task.hpp"
#include "input/work_cells.hpp"
#include "io/read_files.hpp"
#include "page/packed.hpp"
#include "swept/robot_model/problems.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScript = "live.js";
constexpr const char* kCode = "live.wasm";

/// Empty: no page gets a module.
fs::path moduleFolder() {
  const char* const folder = std::getenv("SWEPT_LIVE");
  return folder == nullptr ? "" : folder;
}

std::string base64OfText(const std::string& bytes) {
  return base64Of(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()));
}

std::string compressed(const std::string& bytes) {
  constexpr int kGzip = 16, kWindow = 15, kMemory = 9;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWindow + kGzip, kMemory,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::runtime_error("zlib does not compress");
  std::string text(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(text.data());
  stream.avail_out = static_cast<uInt>(text.size());
  const int end = deflate(&stream, Z_FINISH);
  text.resize(stream.total_out);
  deflateEnd(&stream);
  if (end != Z_STREAM_END) throw std::runtime_error("zlib does not compress");
  return text;
}

/// The deepest folder that has all of these in it.
fs::path folderOfAll(const std::set<fs::path>& files) {
  fs::path common = files.begin()->parent_path();
  for (const fs::path& file : files) {
    const fs::path folder = file.parent_path();
    const auto [end, other] =
        std::mismatch(common.begin(), common.end(), folder.begin(), folder.end());
    fs::path shared;
    for (auto part = common.begin(); part != end; ++part) shared /= *part;
    common = shared;
  }
  return common;
}

/// What is read for the checker of these arguments.
std::set<fs::path> filesOf(const Arguments& args) {
  const detail::ReadFiles read;
  Warnings said = Warnings::none();
  static_cast<void>(loadModel(args, said));
  if (!args.problems.empty()) static_cast<void>(ProblemFile::load(args.problems));
  return read.files();
}

}  // namespace

bool isLive(const Arguments& args) {
  const bool ofCommandLine = args.command == &kCheckCommand || args.command == &kMotionCommand ||
                             args.command == &kPlanCommand;
  return ofCommandLine && !moduleFolder().empty() && args.request.empty() && !args.xacro;
}

void requireLive(const Arguments& args) {
  if (args.page.file.empty() || !isLive(args)) return;
  for (const char* name : {kScript, kCode}) {
    if (!fs::is_regular_file(moduleFolder() / name))
      throw UsageError("SWEPT_LIVE: the folder '" + moduleFolder().string() + "' has no " + name +
                       ", which tests/packaging/wasm.sh makes");
  }
}

Json liveJson(const Arguments& args, const Checker& checker, std::span<const double> start) {
  Arguments inputs = args;
  if (inputs.joints.empty() && inputs.chain.empty()) inputs.group = checker.group().name;
  inputs.states.clear();
  if (inputs.problems.empty()) inputs.states.push_back(stateText(start));
  const std::set<fs::path> files = filesOf(inputs);
  const fs::path folder = folderOfAll(files);
  Json contents = Json::object();
  for (const fs::path& file : files)
    contents[file.lexically_relative(folder).string()] = base64OfText(readTextFile(file));
  return {{"script", base64OfText(compressed(readTextFile(moduleFolder() / kScript)))},
          {"code", base64OfText(compressed(readTextFile(moduleFolder() / kCode)))},
          {"inputs", inputsJson(inputs, folder / "inputs.json")},
          {"files", std::move(contents)}};
}

}  // namespace swept
