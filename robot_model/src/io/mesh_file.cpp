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

#include "io/mesh_import.hpp"
#include "io/point_file.hpp"
#include "io/read_files.hpp"
#include "text/numbers.hpp"

namespace swept::detail {

namespace {

constexpr std::uintmax_t kMaxBytes = std::uintmax_t{256} << 20;

/// Assimp reads about 10 MB per second and takes about 50 times a file's size.
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
  ReadFiles::note(file);
  std::vector<std::uint8_t> bytes(size);
  std::ifstream stream(file, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream) throw MeshFileError("cannot be read");
  return bytes;
}

std::string_view textOf(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The reader of ours for this name; null: we have none.
MeshFileContent (*readerOf(const std::string& ending))(std::string_view, const InputSource&) {
  if (ending == ".stl") return readStlMesh;
  if (ending == ".obj") return readObjMesh;
  if (ending == ".ply") return readPlyMesh;
  if (ending == ".off") return readOffMesh;
  return nullptr;
}

[[noreturn]] void refuseEnding(const std::string& ending) {
  throw MeshFileError("has the ending " + shown(ending) +
                      "; allowed are .stl, .obj, .dae, .ply, .off, .gltf and .glb");
}

/// What `read` makes of a file, or how a message puts that it cannot.
template <typename Read>
auto readOrRefuse(const std::filesystem::path& file, const Read& read) {
  try {
    return read(InputSource(file.string(), {}));
  } catch (const InputError& error) {
    const std::string line =
        error.line() > 0 ? "its line " + std::to_string(error.line()) + ": " : "";
    throw MeshFileError("cannot be read: " + line + error.message());
  }
}

void requireSome(std::uint64_t triangles) {
  if (triangles == 0) throw MeshFileError("has no triangles");
  requireFewTriangles(triangles);
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

/// The first letter of a child's answer; the content or a message follows it.
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

/// A file that overwrote the child's memory may make it answer anything.
template <typename Item>
std::string_view take(std::string_view text, std::vector<Item>& items) {
  std::uint64_t count = 0;
  if (text.size() < sizeof count) refuseContent();
  std::memcpy(&count, text.data(), sizeof count);
  if (count > (text.size() - sizeof count) / sizeof(Item)) refuseContent();
  items.resize(count);
  // An empty array may have a null address, which memcpy must not get.
  if (count > 0)
    std::memcpy(static_cast<void*>(items.data()), text.data() + sizeof count, count * sizeof(Item));
  return text.substr(sizeof count + count * sizeof(Item));
}

/// The parts of a request: a name, a line break, and the bytes of the file.
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
    text.append(reinterpret_cast<const char*>(&content.error), sizeof content.error);
    return text;
  } catch (const MeshFileError& error) {
    return static_cast<char>(Kind::Error) + std::string(error.what());
  } catch (const std::bad_alloc&) {
    return static_cast<char>(Kind::Error) + std::string("cannot be read: out of memory");
  }
}

/// Compares what assimp made of a file with the file's summary.
void requireWhole(const MeshSummary& summary, const MeshFileContent& content) {
  // Of the largest coordinate: a thousand times single precision, and what is of no use.
  constexpr double kSame = 1e-4, kMostError = 1e-2;
  if (content.triangles.size() != summary.triangles) {
    throw MeshFileError("cannot be read: it has " + std::to_string(summary.triangles) +
                        " triangles, and assimp makes " + std::to_string(content.triangles.size()) +
                        " of them");
  }
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3i& triangle : content.triangles) {
    for (const int corner : triangle) {
      if (corner < 0 || corner >= std::ssize(content.vertices)) refuseContent();
      box.extend(content.vertices[static_cast<std::size_t>(corner)]);
    }
  }
  const double largest =
      std::max(summary.box.min().cwiseAbs().maxCoeff(), summary.box.max().cwiseAbs().maxCoeff());
  const double beyond = std::max((summary.box.min() - box.min()).maxCoeff(),
                                 (box.max() - summary.box.max()).maxCoeff());
  if (!(content.error >= 0.0)) refuseContent();
  if (!(content.error <= kMostError * largest)) {
    throw MeshFileError("cannot be read: in single precision its nodes place it only to within " +
                        formatNumber(content.error) + " m; at most " +
                        formatNumber(kMostError * largest) + " m are allowed");
  }
  // The test fails for NaN.
  if (!(beyond <= kSame * largest + content.error)) {
    throw MeshFileError("cannot be read: its faces reach no farther than " + extent(summary.box) +
                        ", and those that assimp makes of them " + extent(box));
  }
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
  const std::string_view last = take(take(rest, content.vertices), content.triangles);
  if (last.size() != sizeof content.error) refuseContent();
  std::memcpy(&content.error, last.data(), sizeof content.error);
  return content;
}

}  // namespace

MeshFileReader::MeshFileReader(ImportPlace place) : MeshFileReader(importMesh, place) {}

MeshFileReader::MeshFileReader(MeshImport import, ImportPlace place)
    : import_(std::move(import)),
      place_(place),
      child_([import = import_](std::string_view request) { return saidOf(request, import); }) {}

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
                                            const MeshSummary& summary) {
  try {
    MeshFileContent content = ask(name, text);
    requireWhole(summary, content);
    return content;
  } catch (const MeshFileError&) {
    // A file may have damaged the process, so it reads no other file.
    child_.end();
    throw;
  }
}

MeshFileContent MeshFileReader::import(const std::string& name, std::string_view text,
                                       const MeshSummary& summary) {
  if (place_ == ImportPlace::Here) {
    MeshFileContent content =
        import_(name, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    requireWhole(summary, content);
    return content;
  }
  if (child_.hasAnswered()) {
    try {
      return askForWhole(name, text, summary);
    } catch (const MeshFileError&) {
      // An earlier file may be the cause, not this one. So a process that has read no other file
      // decides.
    }
  }
  return askForWhole(name, text, summary);
}

MeshFileContent MeshFileReader::read(const std::filesystem::path& file) {
  return readAs(file, FaceMaterials::LeftOut);
}

MeshFileContent MeshFileReader::readWithColours(const std::filesystem::path& file) {
  return readAs(file, FaceMaterials::Kept);
}

MeshFileContent MeshFileReader::readAs(const std::filesystem::path& file, FaceMaterials materials) {
  const std::string ending = lowerEnding(file);
  const bool isCollada = ending == ".dae", isGltf = ending == ".gltf" || ending == ".glb";
  const auto reader = readerOf(ending);
  if (reader == nullptr && !isCollada && !isGltf) refuseEnding(ending);
  const std::vector<std::uint8_t> bytes = readBytes(file);
  const std::string_view text = textOf(bytes);
  if (isGltf) {
    const MeshSummary summary = readOrRefuse(file, [&](const InputSource& source) {
      return gltfSummary(text, ending == ".glb", source);
    });
    requireSome(summary.triangles);
    // Under a name of ours, so that the file's own name does not matter.
    return import("mesh" + ending, text, summary);
  }
  MeshFileContent content = readOrRefuse(file, [&](const InputSource& source) {
    return isCollada ? readColladaFile(text, source, materials) : reader(text, source);
  });
  requireSome(content.triangles.size());
  return content;
}

}  // namespace swept::detail
