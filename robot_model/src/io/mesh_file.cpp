// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_file.hpp"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>
#include <string>
#include <string_view>
#include <system_error>

#include "io/child_process.hpp"
#include "io/collada_check.hpp"
#include "io/mesh_import.hpp"

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

/// Assimp 5.2 looks without end for the rest of a PLY header that is cut.
void requireWholeHeader(std::string_view text) {
  const bool isPly = text.starts_with("ply\n") || text.starts_with("ply\r");
  const auto has = [&](std::string_view line) { return text.find(line) != std::string_view::npos; };
  if (isPly && !has("\nend_header") && !has("\rend_header"))
    throw MeshFileError("cannot be read: its PLY header has no line 'end_header'");
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

std::string saidOf(const std::string& name, const std::vector<std::uint8_t>& bytes) {
  try {
    const MeshFileContent content = importMesh(name, bytes);
    std::string text(1, static_cast<char>(Kind::Content));
    append(content.vertices, text);
    append(content.triangles, text);
    return text;
  } catch (const MeshFileError& error) {
    return static_cast<char>(Kind::Error) + std::string(error.what());
  } catch (const std::bad_alloc&) {
    return static_cast<char>(Kind::Error) + std::string("cannot be read: out of memory");
  }
}

}  // namespace

MeshFileContent readMeshFile(const std::filesystem::path& file) {
  const std::vector<std::uint8_t> bytes = readBytes(file);
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  requireWholeHeader(text);
  if (text.find("<COLLADA") != std::string_view::npos) checkCollada(text);
  const ChildLimits limits{
      .seconds = kSeconds + static_cast<unsigned>(bytes.size() / kBytesPerSecond),
      .bytes = kMemory + kMemoryPerByte * bytes.size()};
  std::string said;
  try {
    said = runInChild([&] { return saidOf(file.filename().string(), bytes); }, limits);
  } catch (const ChildError& error) {
    throw MeshFileError(std::string("cannot be read: assimp ") + error.what());
  } catch (const std::system_error& error) {
    throw MeshFileError(std::string("cannot be read: ") + error.what());
  }
  const std::string_view rest = std::string_view(said).substr(1);
  if (said.empty()) refuseContent();
  if (said.front() == static_cast<char>(Kind::Error)) throw MeshFileError(std::string(rest));
  MeshFileContent content;
  take(take(rest, content.vertices), content.triangles);
  return content;
}

}  // namespace swept::detail
