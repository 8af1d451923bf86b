// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_store.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <system_error>
#include <tuple>
#include <utility>

#include "io/content_hash.hpp"
#include "io/cover_cache.hpp"
#include "io/package_paths.hpp"
#include "io/point_file.hpp"
#include "io/regular_file.hpp"
#include "text/numbers.hpp"
#include "threads/work_crew.hpp"

namespace swept::detail {

namespace fs = std::filesystem;

namespace {

std::string nameOf(const MeshReference& mesh) {
  return "mesh '" + mesh.reference + "' of " + mesh.owner;
}

/// What files with the same content share. It has no size: that is unknown.
std::pair<std::string, std::uintmax_t> endingAndSize(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  return {lowerEnding(file), error ? 0 : size};
}

/// Tells LoadOptions::progress, whichever thread has done one.
class Counted {
 public:
  using Progress = std::function<void(std::size_t, std::size_t)>;
  Counted(const Progress& progress, std::size_t total) : progress_(progress), total_(total) {}
  /// An exception from the caller's function is lost: the function must not throw.
  void addOne() noexcept {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (progress_) progress_(done_, total_);
  }

 private:
  std::mutex mutex_;
  const Progress& progress_;
  std::size_t done_ = 0;
  const std::size_t total_;
};

/// A name that is the same for all names of a file. It is the file's own name where the system
/// knows no other, as for an open file that is in no folder any more.
fs::path oneName(const fs::path& file) {
  std::error_code error;
  const fs::path whole = fs::canonical(file, error);
  return error ? file : whole;
}

void warnOfCracks(const TriangleMesh& mesh, double rounding, const std::string& name, int line,
                  const InputSource& source) {
  // Both borders of a crack may be off, along three axes.
  if (mesh.report().largestCrack <= 2.0 * rounding) return;
  source.warn(line, "mesh '" + name + "' has cracks of up to " +
                        formatNumber(mesh.report().largestCrack) +
                        " m, more than rounding explains: they are filled");
}

}  // namespace

MeshPlace placeOfMesh(const std::string& reference, const InputSource& source) {
  const auto candidates = candidatePaths(reference, source.folder(), source.options());
  if (candidates.empty()) return {{}, ": the scheme must be package://, model:// or file://"};
  std::string tried;
  for (const fs::path& candidate : candidates) {
    const std::string reason = whyUnreadable(candidate);
    if (reason.empty()) return {candidate, {}};
    tried += (tried.empty() ? "" : ", ") + candidate.string();
    if (reason != kNoSuchFile) tried += " (" + reason + ")";
  }
  const std::string package = packageOf(reference);
  const std::string hint = package.empty() ? ""
                                           : "; --package " + package +
                                                 "=DIR (LoadOptions::packages) tells where package "
                                                 "'" +
                                                 package + "' is";
  return {{}, " not found; looked for " + tried + hint};
}

void MeshStore::requireFound(const std::vector<MeshReference>& references) const {
  constexpr std::size_t kMost = 10;
  std::map<std::string, std::string> problems;  // of each reference, empty: none
  std::vector<const MeshReference*> missing;
  for (const MeshReference& mesh : references) {
    if (problems.contains(mesh.reference)) continue;
    const std::string problem = placeOfMesh(mesh.reference, source_).problem;
    problems.emplace(mesh.reference, problem);
    if (!problem.empty()) missing.push_back(&mesh);
  }
  if (missing.empty()) return;
  std::string text = nameOf(*missing.front()) + problems[missing.front()->reference];
  for (std::size_t i = 1; i < std::min(missing.size(), kMost); ++i)
    text += (i == 1 ? "; missing as well: '" : ", '") + missing[i]->reference + "' (line " +
            std::to_string(missing[i]->line) + ")";
  if (missing.size() > kMost) text += " and " + std::to_string(missing.size() - kMost) + " more";
  source_.fail(missing.front()->line, text);
}

MeshStore::Key MeshStore::keyOf(const std::filesystem::path& file, const Eigen::Vector3d& scale) {
  return {oneName(file), {scale.x(), scale.y(), scale.z()}};
}

std::vector<MeshStore::Key> MeshStore::newOnes(const std::vector<MeshReference>& references) {
  std::vector<Key> keys;
  std::set<Key> known;
  for (const MeshReference& mesh : references) {
    const MeshPlace place = placeOfMesh(mesh.reference, source_);
    const Key key = keyOf(place.file, mesh.scale);
    if (place.problem.empty() && !made_.contains(key) && known.insert(key).second)
      keys.push_back(key);
  }
  // Robots have the same file under several names, for example for a left and a right hand.
  std::map<std::pair<std::string, std::uintmax_t>, int> alike;
  for (const Key& key : keys) ++alike[endingAndSize(key.first)];
  std::map<std::tuple<std::string, ContentHash::Digest, std::array<double, 3>>, Key> firstWith;
  std::vector<Key> first;
  for (const Key& key : keys) {
    if (alike[endingAndSize(key.first)] > 1) {
      if (const auto content = hashOfFile(key.first)) {
        const auto [found, isNew] =
            firstWith.emplace(std::tuple(lowerEnding(key.first), *content, key.second), key);
        if (!isNew) {
          copyOf_.emplace(key, found->second);
          continue;
        }
      }
    }
    first.push_back(key);
  }
  return first;
}

void MeshStore::prepare(const std::vector<MeshReference>& references) {
  const std::vector<Key> wanted = newOnes(references);
  Counted counted(source_.options().progress, wanted.size());
  CoverCache covers(source_.options().cache);
  {
    WorkCrew crew(0);
    // After a file that cannot be read, the later ones are not needed.
    bool isReadable = true;
    for (std::size_t i = 0; i < wanted.size() && isReadable; ++i) {
      MadeMesh& made = made_[wanted[i]];
      const std::array<double, 3>& factors = wanted[i].second;
      try {
        auto content = std::make_shared<MeshFileContent>(files_.read(wanted[i].first));
        crew.give([&made, &factors, &counted, &covers, content] {
          made = makeMesh(std::move(*content), {factors[0], factors[1], factors[2]}, &covers);
          counted.addOne();
        });
      } catch (const MeshFileError& error) {
        made = unusable(error);
        isReadable = false;
      }
    }
  }
  if (const std::string problem = covers.problem(); !problem.empty() && source_.options().warn)
    source_.options().warn(source_.options().cache.string() + ": warning: " + problem);
}

const MadeMesh& MeshStore::get(const MeshReference& mesh) {
  const std::string name = nameOf(mesh);
  const auto [file, problem] = placeOfMesh(mesh.reference, source_);
  if (!problem.empty()) source_.fail(mesh.line, name + problem);
  const Key key = keyOf(file, mesh.scale);
  const auto copy = copyOf_.find(key);
  auto known = made_.find(copy == copyOf_.end() ? key : copy->second);
  if (known == made_.end()) known = made_.emplace(key, readNow(file, mesh.scale)).first;
  const MadeMesh& made = known->second;
  if (made.failure) std::rethrow_exception(made.failure);
  if (!made.mesh) source_.fail(mesh.line, name + made.problem);
  if (!told_.insert(key).second) return made;
  warnOfCracks(*made.mesh, made.rounding, mesh.reference, mesh.line, source_);
  warnIfOpen(made.mesh->report(), made.opening, mesh.reference, mesh.line, source_);
  return made;
}

MadeMesh MeshStore::readNow(const std::filesystem::path& file, const Eigen::Vector3d& scale) {
  try {
    return makeMesh(files_.read(file), scale, nullptr);
  } catch (const MeshFileError& error) {
    return unusable(error);
  }
}

void warnIfOpen(const TriangleMesh& mesh, const std::string& name, int line,
                const InputSource& source) {
  warnIfOpen(mesh.report(), mesh.opening(), name, line, source);
}

void warnIfOpen(const MeshReport& report, double opening, const std::string& name, int line,
                const InputSource& source) {
  const int open = report.openComponents;
  if (open == 0) return;
  const std::string components = std::to_string(open) + " open component" + (open == 1 ? "" : "s");
  const std::string width =
      std::isfinite(opening) ? ", for openings of up to " + formatNumber(opening) + " m" : "";
  if (report.closedComponents > 0)
    source.warn(line, "mesh '" + name + "' has " + components + " without an inside" + width);
  else
    source.warn(line, "mesh '" + name + "' is an open surface (" + components +
                          "): its interior is not solid" + width);
}

}  // namespace swept::detail
