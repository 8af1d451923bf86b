// SPDX-License-Identifier: BSD-3-Clause
#include "world_key.hpp"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace soak {

namespace {

Choice parseChoice(std::string_view word, int places, int forms) {
  Choice choice{-1, -1};
  const char* const end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data(), end, choice.place);
  if (error == std::errc() && rest + 1 == end) choice.form = *rest - 'a';
  const bool good =
      choice.place >= 0 && choice.place < places && choice.form >= 0 && choice.form < forms;
  if (good) return choice;
  throw std::invalid_argument("a body of a world is a place, 0 to " + std::to_string(places - 1) +
                              ", and a form, a to " + static_cast<char>('a' + forms - 1) +
                              ", not '" + std::string(word) + "'");
}

}  // namespace

std::string toString(const WorldKey& key) {
  if (key.empty()) return "none";
  std::string text;
  for (const Choice& choice : key) {
    if (!text.empty()) text += '.';
    text += std::to_string(choice.place) + static_cast<char>('a' + choice.form);
  }
  return text;
}

WorldKey parseWorldKey(std::string_view text, int places, int forms) {
  WorldKey key;
  if (text == "none") return key;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('.', begin), text.size());
    const Choice choice = parseChoice(text.substr(begin, end - begin), places, forms);
    if (std::ranges::count(key, choice.place, &Choice::place) > 0)
      throw std::invalid_argument("place " + std::to_string(choice.place) + " is taken twice");
    key.push_back(choice);
    begin = end + 1;
  }
  return key;
}

}  // namespace soak
