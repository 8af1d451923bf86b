// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "input_files.hpp"
#include "io/mesh_file.hpp"

namespace swept::test {

/// Why a file of that name with that text is refused; else how many triangles it has.
inline std::string said(const std::string& name, const std::string& text) {
  const TemporaryFolder folder;
  try {
    detail::MeshFileReader reader;
    return std::to_string(reader.read(folder.write(name, text)).triangles.size());
  } catch (const detail::MeshFileError& error) {
    return error.what();
  }
}

/// A change of a text, and what is said then.
struct Change {
  std::string from, to, message;
};

inline std::string changed(std::string text, const Change& change) {
  const auto at = text.find(change.from);
  EXPECT_NE(at, std::string::npos) << change.from;
  return text.replace(at, change.from.size(), change.to);
}

inline void expectSaid(const std::string& name, const std::string& text,
                       const std::vector<Change>& changes) {
  for (const Change& change : changes) {
    SCOPED_TRACE("'" + change.from + "' -> '" + change.to + "'");
    EXPECT_EQ(said(name, changed(text, change)), change.message);
  }
}

inline const std::string kLine = "cannot be read: its line ";

}  // namespace swept::test
