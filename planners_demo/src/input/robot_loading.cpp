// SPDX-License-Identifier: BSD-3-Clause
#include "input/robot_loading.hpp"

#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "output/progress.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {

namespace {

/// Remarks, until they may be shown: at the end of this.
class HeldRemarks {
 public:
  explicit HeldRemarks(const LoadOptions& options) : options_(options) {}
  ~HeldRemarks() {
    for (const auto& show : held_) show();
  }
  HeldRemarks(const HeldRemarks&) = delete;
  HeldRemarks& operator=(const HeldRemarks&) = delete;

  LoadOptions options() {
    LoadOptions holding = options_;
    holding.warn = [this](const std::string& line) {
      held_.emplace_back([this, line] { options_.warn(line); });
    };
    holding.warnOfUnchecked = [this](const std::string& line) {
      held_.emplace_back([this, line] { options_.warnOfUnchecked(line); });
    };
    return holding;
  }

 private:
  const LoadOptions& options_;
  std::vector<std::function<void()>> held_;
};

}  // namespace

std::filesystem::path cacheFolder() {
  const char* const folder = std::getenv("SWEPT_CACHE");
  return folder == nullptr ? "" : folder;
}

namespace {

using Load = std::function<std::shared_ptr<const Robot>(const LoadOptions&)>;

std::shared_ptr<const Robot> loadShown(const Arguments& args, const LoadOptions& options,
                                       const Load& load) {
  HeldRemarks remarks(options);
  LoadOptions holding = remarks.options();
  const std::string label = "loading the robot";
  Progress progress(label, args.quiet);
  holding.progress = [&](std::size_t done, std::size_t total) {
    progress.setLabel(label + ": " + std::to_string(done) + " of " + std::to_string(total) +
                      " meshes");
  };
  return load(holding);
}

}  // namespace

std::shared_ptr<const Robot> loadRobot(const Arguments& args, const ExpandedText& urdf,
                                       const std::filesystem::path& srdf,
                                       const LoadOptions& options) {
  return loadShown(args, options, [&](const LoadOptions& holding) {
    const std::string srdfText = srdf.empty() ? std::string() : readTextFile(srdf);
    if (!srdf.empty() && srdfText.empty())
      throw InputError(srdf.string(), 1, "malformed XML: the document is empty");
    return Robot::parse(urdf.text, urdf.name, srdfText, srdf.string(), holding);
  });
}

std::shared_ptr<const Robot> loadRobot(const Arguments& args, const ComposedRobot& cell,
                                       const LoadOptions& options) {
  return loadShown(args, options,
                   [&](const LoadOptions& holding) { return loadComposed(cell, holding); });
}

}  // namespace swept
