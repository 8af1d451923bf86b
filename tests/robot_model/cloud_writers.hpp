// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace swept::test {

using Points = std::vector<Eigen::Vector3d>;

/// A field of a PCD file or a property of a PLY file. Fields named x, y and z get the coordinates,
/// others something that is none.
struct CloudField {
  std::string name;
  char type = 'F';  ///< F, I or U
  int size = 4;     ///< bytes
  int count = 1;
};

inline const std::vector<CloudField> kFloats{{"x"}, {"y"}, {"z"}};
inline const std::vector<CloudField> kDoubles{{"x", 'F', 8}, {"y", 'F', 8}, {"z", 'F', 8}};

/// `value` as a number of this type, byte by byte.
inline void appendBinary(std::string& out, double value, const CloudField& field, bool big) {
  std::uint64_t bits = 0;
  if (field.type != 'F')
    bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(value));
  else if (field.size == 4)
    bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  else
    bits = std::bit_cast<std::uint64_t>(value);
  for (int i = 0; i < field.size; ++i) {
    const int byte = big ? field.size - 1 - i : i;
    out.push_back(static_cast<char>(bits >> (8 * byte) & 0xff));
  }
}

/// The shortest text that reads back as the same double.
inline void appendText(std::string& out, double value) {
  std::array<char, 64> buffer{};
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  out.append(buffer.data(), result.ptr);
}

inline double fieldValue(const Points& points, std::size_t i, const CloudField& field, int k) {
  if (field.name == "x" || field.name == "y" || field.name == "z") {
    return points[i][field.name[0] - 'x'];
  }
  return static_cast<double>((i * 7 + static_cast<std::size_t>(k)) % 100);
}

inline void appendTextRow(std::string& out, const Points& points, std::size_t i,
                          const std::vector<CloudField>& fields, const std::string& lineEnd) {
  for (const CloudField& field : fields) {
    for (int k = 0; k < field.count; ++k) {
      appendText(out, fieldValue(points, i, field, k));
      out.push_back(' ');
    }
  }
  out.pop_back();
  out += lineEnd;
}

inline void appendBinaryRow(std::string& out, const Points& points, std::size_t i,
                            const std::vector<CloudField>& fields, bool big) {
  for (const CloudField& field : fields) {
    for (int k = 0; k < field.count; ++k) {
      appendBinary(out, fieldValue(points, i, field, k), field, big);
    }
  }
}

/// How far back, and how much of it, what follows at `at` has been there before; no length: less
/// than three bytes. `last` has the last place of each hash of three bytes.
struct Repetition {
  std::size_t distance = 0;
  std::size_t length = 0;
};
inline Repetition findRepetition(std::string_view data, std::size_t at,
                                 std::vector<std::size_t>& last) {
  constexpr std::size_t kReach = 8192, kLongest = 264;
  Repetition found;
  if (at + 3 > data.size()) return found;
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(data[at + i]); };
  std::size_t& place = last[(byte(0) * 31u + byte(1)) * 31u + byte(2)];
  if (place < at && at - place <= kReach) {
    found.distance = at - place;
    while (found.length < kLongest && at + found.length < data.size() &&
           data[at + found.length] == data[place + found.length]) {
      ++found.length;
    }
  }
  place = at;
  if (found.length < 3) found.length = 0;
  return found;
}

/// Not the encoder that anybody uses, but the format.
inline std::string lzf(std::string_view data) {
  constexpr std::size_t kRun = 32;
  std::vector<std::size_t> last(255 * (31 * 31 + 31 + 1) + 1, std::string_view::npos);
  std::string out;
  std::string run;
  const auto flush = [&] {
    if (!run.empty()) out += static_cast<char>(run.size() - 1) + run;
    run.clear();
  };
  for (std::size_t at = 0; at < data.size();) {
    const auto [distance, length] = findRepetition(data, at, last);
    if (length == 0) {
      run.push_back(data[at++]);
      if (run.size() == kRun) flush();
      continue;
    }
    flush();
    const std::size_t code = length - 2;
    out.push_back(static_cast<char>(std::min<std::size_t>(code, 7) << 5 | (distance - 1) >> 8));
    if (code >= 7) out.push_back(static_cast<char>(code - 7));
    out.push_back(static_cast<char>((distance - 1) & 0xff));
    at += length;
  }
  flush();
  return out;
}

inline std::string words(const std::vector<std::string>& list) {
  std::string out;
  for (const std::string& word : list) out += ' ' + word;
  return out;
}

/// `form`: ascii, binary or binary_compressed.
inline std::string pcdHeader(std::size_t count, const std::vector<CloudField>& fields,
                             const std::string& form, const std::string& lineEnd = "\n") {
  std::vector<std::string> names, sizes, types, counts;
  for (const CloudField& field : fields) {
    names.push_back(field.name);
    sizes.push_back(std::to_string(field.size));
    types.emplace_back(1, field.type);
    counts.push_back(std::to_string(field.count));
  }
  std::string out;
  for (const std::string& line :
       {std::string("# .PCD v0.7 - Point Cloud Data file format"), std::string("VERSION 0.7"),
        "FIELDS" + words(names), "SIZE" + words(sizes), "TYPE" + words(types),
        "COUNT" + words(counts), "WIDTH " + std::to_string(count), std::string("HEIGHT 1"),
        std::string("VIEWPOINT 0 0 0 1 0 0 0"), "POINTS " + std::to_string(count),
        "DATA " + form}) {
    out += line + lineEnd;
  }
  return out;
}

inline std::string pcd(const Points& points, const std::vector<CloudField>& fields,
                       const std::string& form, const std::string& lineEnd = "\n") {
  std::string out = pcdHeader(points.size(), fields, form, lineEnd);
  std::string data;
  if (form == "binary_compressed") {
    for (const CloudField& field : fields) {
      for (std::size_t i = 0; i < points.size(); ++i) {
        appendBinaryRow(data, points, i, {field}, false);
      }
    }
    const std::string packed = lzf(data);
    const CloudField size{"", 'U', 4};
    appendBinary(out, static_cast<double>(packed.size()), size, false);
    appendBinary(out, static_cast<double>(data.size()), size, false);
    return out + packed;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (form == "ascii") {
      appendTextRow(out, points, i, fields, lineEnd);
    } else {
      appendBinaryRow(out, points, i, fields, false);
    }
  }
  return out;
}

inline std::string plyType(const CloudField& field) {
  if (field.type == 'F') return field.size == 4 ? "float" : "double";
  const std::string name = field.size == 1 ? "char" : field.size == 2 ? "short" : "int";
  return field.type == 'U' ? "u" + name : name;
}

/// An element of a PLY file in text and in binary.
struct PlyPart {
  std::string header;
  std::string text;
  std::string binary;
};

/// `form`: ascii, binary_little_endian or binary_big_endian.
inline std::string ply(const std::vector<PlyPart>& parts, const std::string& form,
                       const std::string& lineEnd = "\n") {
  std::string out = "ply" + lineEnd + "format " + form + " 1.0" + lineEnd +
                    "comment element vertex 9" + lineEnd + "obj_info nothing" + lineEnd;
  for (const PlyPart& part : parts) out += part.header;
  out += "end_header" + lineEnd;
  for (const PlyPart& part : parts) out += form == "ascii" ? part.text : part.binary;
  return out;
}

inline PlyPart plyVertex(const Points& points, const std::vector<CloudField>& fields, bool big,
                         const std::string& lineEnd = "\n") {
  PlyPart part{"element vertex " + std::to_string(points.size()) + lineEnd, "", ""};
  for (const CloudField& field : fields) {
    part.header += "property " + plyType(field) + " " + field.name + lineEnd;
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    appendTextRow(part.text, points, i, fields, lineEnd);
    appendBinaryRow(part.binary, points, i, fields, big);
  }
  return part;
}

/// Faces with a list of corners, whose lengths are 3, 4, 5, 3, ..., and a number each.
inline PlyPart plyFaces(const std::string& name, int count, bool big,
                        const std::string& lineEnd = "\n") {
  PlyPart part{"element " + name + " " + std::to_string(count) + lineEnd +
                   "property list uchar int vertex_indices" + lineEnd + "property short flag" +
                   lineEnd,
               "", ""};
  for (int i = 0; i < count; ++i) {
    const int corners = 3 + i % 3;
    part.text += std::to_string(corners);
    appendBinary(part.binary, corners, {"", 'U', 1}, big);
    for (int k = 0; k < corners; ++k) {
      part.text += " " + std::to_string(k);
      appendBinary(part.binary, k, {"", 'I', 4}, big);
    }
    part.text += " -7" + lineEnd;
    appendBinary(part.binary, -7, {"", 'I', 2}, big);
  }
  return part;
}

/// One point per line.
inline std::string xyz(const Points& points, const std::string& separator = " ") {
  std::string out;
  for (const Eigen::Vector3d& point : points) {
    for (int axis = 0; axis < 3; ++axis) {
      appendText(out, point[axis]);
      out += axis < 2 ? separator : "\n";
    }
  }
  return out;
}

}  // namespace swept::test
