// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "io/child_process.hpp"
#include "io/collada_convex.hpp"
#include "io/mesh_claim.hpp"
#include "io/mesh_import.hpp"
#include "io/point_file.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{256} << 20;

/// Assimp reads some 10 MB in a second and takes some 50 times a file's size.
constexpr unsigned kSeconds = 3;
constexpr unsigned kBytesPerSecond = 1 << 18;
constexpr std::uint64_t kMemory = std::uint64_t{1} << 30;
constexpr std::uint64_t kMemoryPerByte = 400;

std::vector<std::uint8_t> readBytes(const std::filesystem::path& file) {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  if (error) throw MeshFileError("cannot be read: " + error.message());
  if (size == 0) throw MeshFileError("is empty");
  if (size > kMaxBytes) {
    throw MeshFileError("has " + std::to_string(size) + " bytes; at most " +
                        std::to_string(kMaxBytes) + " are allowed");
  }
  std::vector<std::uint8_t> bytes(size);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream) throw MeshFileError("cannot be read");
  return bytes;
}

using Check = MeshClaim (*)(std::string_view, const InputSource&);

Check checkOf(const std::string& ending, FaceMaterials materials) {
  if (ending == ".dae" && materials == FaceMaterials::Kept) return checkColladaWithMaterials;
  constexpr std::array<std::pair<std::string_view, Check>, 4> kFormats{
      {{".stl", checkStl}, {".obj", checkObj}, {".dae", checkCollada}, {".ply", checkPly}}};
  const auto found =
      std::ranges::find(kFormats, ending, [](const auto& format) { return format.first; });
  if (found != kFormats.end()) return found->second;
  throw MeshFileError("has the ending " + shown(ending) +
                      "; allowed are .stl, .obj, .dae and .ply");
}

MeshClaim claimOf(const std::filesystem::path& file, std::string_view text, Check check) {
  try {
    MeshClaim claim = check(text, InputSource(file.string(), {}));
    if (claim.triangles == 0) throw MeshFileError("has no triangles");
    requireFewTriangles(claim.triangles);
    return claim;
  } catch (const InputError& error) {
    const std::string line =
        error.line() > 0 ? "its line " + std::to_string(error.line()) + ": " : "";
    throw MeshFileError("cannot be read: " + line + error.message());
  }
}

std::string extent(const Eigen::AlignedBox3d& box) {
  std::string text;
  for (const Eigen::Vector3d& corner : {box.min(), box.max()}) {
    text += text.empty() ? "from (" : ") to (";
    for (int axis = 0; axis < 3; ++axis)
      text += (axis > 0 ? ", " : "") + formatNumber(corner[axis]);
  }
  return text + ")";
}

/// First letter of what a child says; what follows is the content, or a message.
enum class Kind : char { Content = 'c', Error = 'e' };

template <typename Item>
void append(const std::vector<Item>& items, std::string& text) {
  const std::uint64_t count = items.size();
  text.append(reinterpret_cast<const char*>(&count), sizeof count);
  text.append(reinterpret_cast<const char*>(items.data()), count * sizeof(Item));
}

[[noreturn]] void refuseContent() {
  throw MeshFileError("cannot be read: assimp returned no mesh");
}

/// A file that overwrote the child's memory may have it say anything.
template <typename Item>
std::string_view take(std::string_view text, std::vector<Item>& items) {
  std::uint64_t count = 0;
  if (text.size() < sizeof count) refuseContent();
  std::memcpy(&count, text.data(), sizeof count);
  if (count > (text.size() - sizeof count) / sizeof(Item)) refuseContent();
  items.resize(count);
  // Of no items the address may be null, which memcpy must not be given.
  if (count > 0)
    std::memcpy(static_cast<void*>(items.data()), text.data() + sizeof count, count * sizeof(Item));
  return text.substr(sizeof count + count * sizeof(Item));
}

/// Of a request: a name, a line break, and the bytes of the file.
std::string saidOf(std::string_view request, const MeshImport& import) {
  const auto end = request.find('\n');
  const std::string_view file = request.substr(end + 1);
  try {
    const MeshFileContent content =
        import(std::string(request.substr(0, end)),
               {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()});
    std::string text(1, static_cast<char>(Kind::Content));
    append(content.vertices, text);
    append(content.triangles, text);
    append(content.colours, text);
    return text;
  } catch (const MeshFileError& error) {
    return static_cast<char>(Kind::Error) + std::string(error.what());
  } catch (const std::bad_alloc&) {
    return static_cast<char>(Kind::Error) + std::string("cannot be read: out of memory");
  }
}

/// Holds what assimp made of a file against what there is to be made of it.
void requireWhole(const MeshClaim& claim, MeshFileContent& content) {
  constexpr double kSame = 1e-4;  // of the largest coordinate: a thousand times single precision
  // A face that crosses itself bounds no one region: readers that cut it, fan it or fill it leave
  // different surfaces, and a solid with it may lose its inside. So it is refused, by its place.
  if (content.triangles.size() != claim.triangles && !claim.crossing.name().empty()) {
    throw MeshFileError(
        "cannot be read: " + claim.crossing.name() +
        " crosses or touches itself; a face of more than 4 corners must not, or has to be "
        "given as triangles");
  }
  if (content.triangles.size() != claim.triangles) {
    throw MeshFileError("cannot be read: it has " + std::to_string(claim.triangles) +
                        " triangles, where a face of n corners counts n - 2, and assimp makes " +
                        std::to_string(content.triangles.size()) +
                        " of them; faces of more than 4 corners must not cross themselves");
  }
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3i& triangle : content.triangles) {
    for (const int corner : triangle) {
      if (corner < 0 || corner >= std::ssize(content.vertices)) refuseContent();
      box.extend(content.vertices[static_cast<std::size_t>(corner)]);
    }
  }
  const double off = std::max((box.min() - claim.box.min()).cwiseAbs().maxCoeff(),
                              (box.max() - claim.box.max()).cwiseAbs().maxCoeff());
  const double largest =
      std::max(claim.box.min().cwiseAbs().maxCoeff(), claim.box.max().cwiseAbs().maxCoeff());
  // NaN fails it.
  if (!(off <= kSame * largest)) {
    throw MeshFileError("cannot be read: its faces reach " + extent(claim.box) +
                        ", and those that assimp makes of them " + extent(box));
  }
  content.loss = std::max(claim.loss, off);
}

ChildLimits limitsFor(std::size_t bytes) {
  return {.seconds = kSeconds + static_cast<unsigned>(bytes / kBytesPerSecond),
          .bytes = kMemory + kMemoryPerByte * bytes};
}

MeshFileContent contentOf(std::string_view said) {
  if (said.empty()) refuseContent();
  const std::string_view rest = said.substr(1);
  if (said.front() == static_cast<char>(Kind::Error)) throw MeshFileError(std::string(rest));
  MeshFileContent content;
  take(take(take(rest, content.vertices), content.triangles), content.colours);
  if (!content.colours.empty() && content.colours.size() != content.triangles.size())
    refuseContent();
  return content;
}

}  // namespace

void requireFewTriangles(std::uint64_t count) {
  constexpr std::uint64_t kMost = 20'000'000;
  if (count <= kMost) return;
  throw MeshFileError("has more than " + std::to_string(kMost) +
                      " triangles, which is the most allowed");
}

MeshFileReader::MeshFileReader() : MeshFileReader(importMesh) {}

MeshFileReader::MeshFileReader(MeshImport import)
    : child_([import = std::move(import)](std::string_view request) {
        return saidOf(request, import);
      }) {}

MeshFileContent MeshFileReader::ask(const std::string& name, std::string_view text) {
  try {
    return contentOf(
        child_.ask(std::array<std::string_view, 3>{name, "\n", text}, limitsFor(text.size())));
  } catch (const ChildError& error) {
    throw MeshFileError(std::string("cannot be read: assimp ") + error.what());
  } catch (const std::system_error& error) {
    throw MeshFileError(std::string("cannot be read: ") + error.what());
  }
}

MeshFileContent MeshFileReader::askForWhole(const std::string& name, std::string_view text,
                                            const MeshClaim& claim) {
  try {
    MeshFileContent content = ask(name, text);
    requireWhole(claim, content);
    return content;
  } catch (const MeshFileError&) {
    // Whatever that file has done to the process: it reads no other.
    child_.end();
    throw;
  }
}

MeshFileContent MeshFileReader::read(const std::filesystem::path& file) {
  return readAs(file, FaceMaterials::LeftOut);
}

MeshFileContent MeshFileReader::readWithColours(const std::filesystem::path& file) {
  if (lowerEnding(file) != ".dae") return read(file);
  try {
    return readAs(file, FaceMaterials::Kept);
  } catch (const MeshFileError&) {
    return read(file);
  }
}

MeshFileContent MeshFileReader::readAs(const std::filesystem::path& file, FaceMaterials materials) {
  const std::string ending = lowerEnding(file);
  const Check check = checkOf(ending, materials);
  const std::vector<std::uint8_t> bytes = readBytes(file);
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  std::string renamed;
  if (ending == ".dae" && text.find("<convex_mesh") != std::string_view::npos)
    text = renamed = withConvexMeshes(text);
  const MeshClaim claim = claimOf(file, text, check);
  const std::string_view read = claim.bare ? std::string_view(*claim.bare) : text;
  // By a name of ours, whatever the file's has in it.
  const std::string name = "mesh" + ending;
  if (child_.hasAnswered()) {
    try {
      return askForWhole(name, read, claim);
    } catch (const MeshFileError&) {
      // Not this file's fault, perhaps, but of those before it: a process that has read none says.
    }
  }
  return askForWhole(name, read, claim);
}

}  // namespace swept::detail
