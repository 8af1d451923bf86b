// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/text_file.hpp"

#include <fstream>
#include <iterator>
#include <vector>

#include "io/read_files.hpp"
#include "io/regular_file.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {

std::string readTextFile(const std::filesystem::path& file) {
  const std::string reason = detail::whyNoBytes(file);
  if (!reason.empty()) throw InputError(file.string(), 0, reason);
  detail::ReadFiles::note(file);
  // Read, not asked for: the file may grow meanwhile.
  std::ifstream stream(file, std::ios::binary);
  std::string text;
  std::string block(std::size_t{1} << 16, '\0');
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())),
         stream.gcount() > 0) {
    text.append(block, 0, static_cast<std::size_t>(stream.gcount()));
    if (text.size() > kMaxTextBytes) {
      throw InputError(file.string(), 0,
                       "the file has more than " + std::to_string(kMaxTextBytes) +
                           " bytes, which are the most that are read of a text");
    }
  }
  if (!stream.eof()) throw InputError(file.string(), 0, "file cannot be read");
  return text;
}

void requireModestJson(std::string_view text, const std::string& file, int firstLine) {
  int line = firstLine;
  std::vector<std::size_t> keys;  // of each object and array that is open
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char letter = text[i];
    if (letter == '\n') ++line;
    if (letter == '"') quoted = !quoted;
    if (quoted) {
      if (letter == '\\') ++i;
      continue;
    }
    if ((letter == '}' || letter == ']') && !keys.empty()) keys.pop_back();
    if (letter == ':' && !keys.empty() && ++keys.back() > kMaxKeys) {
      throw InputError(file, line, "an object has more than " + std::to_string(kMaxKeys) + " keys");
    }
    if (letter != '{' && letter != '[') continue;
    keys.push_back(0);
    if (std::ssize(keys) > kMaxNesting) {
      throw InputError(file, line,
                       "objects and arrays are nested deeper than " + std::to_string(kMaxNesting));
    }
  }
}

}  // namespace swept
