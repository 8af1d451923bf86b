// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace swept::test {

template <typename Number>
void appendBytes(std::string& bytes, Number number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// Binary glTF of two parts.
inline std::string glbOf(std::string json, std::string bytes) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  bytes.resize((bytes.size() + 3) / 4 * 4);
  std::string text = "glTF";
  appendBytes(text, std::uint32_t{2});
  appendBytes(text, static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + bytes.size()));
  appendBytes(text, static_cast<std::uint32_t>(json.size()));
  text += "JSON" + json;
  appendBytes(text, static_cast<std::uint32_t>(bytes.size()));
  return text + std::string("BIN\0", 4) + bytes;
}

/// The corners and faces of a tetrahedron of that size with a corner at `at`, as glTF has them.
struct GltfTetrahedron {
  explicit GltfTetrahedron(float size = 1.0F, std::array<float, 3> at = {0.0F, 0.0F, 0.0F})
      : corners{{at,
                 {at[0] + size, at[1], at[2]},
                 {at[0], at[1] + size, at[2]},
                 {at[0], at[1], at[2] + size}}} {
    for (const auto& corner : corners)
      for (const float value : corner) appendBytes(bytes, value);
    for (const int corner : {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3})
      appendBytes(bytes, static_cast<std::uint16_t>(corner));
  }

  /// Of a scene that shows it by a node with `placed`, as in `"scale":[1,1,1]`.
  std::string json(const std::string& placed = "") const {
    std::ostringstream text;
    text.precision(9);
    text << R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0)"
         << (placed.empty() ? "" : ",") << placed
         << R"(}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
         << R"("buffers":[{"byteLength":72}],)"
         << R"("bufferViews":[{"buffer":0,"byteLength":48},)"
         << R"({"buffer":0,"byteOffset":48,"byteLength":24}],)"
         << R"("accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3","min":[)"
         << corners[0][0] << ',' << corners[0][1] << ',' << corners[0][2] << R"(],"max":[)"
         << corners[1][0] << ',' << corners[2][1] << ',' << corners[3][2]
         << R"(]},{"bufferView":1,"componentType":5123,"count":12,"type":"SCALAR"}]})";
    return text.str();
  }
  std::string glb(const std::string& placed = "") const { return glbOf(json(placed), bytes); }

  std::vector<std::array<float, 3>> corners;
  std::string bytes;  ///< 48 of corners, 24 of faces
};

}  // namespace swept::test
