// SPDX-License-Identifier: BSD-3-Clause
#include "io/json_place.hpp"

#include <cstddef>
#include <functional>
#include <set>

#include "swept/robot_model/foreign_text.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept::detail {

namespace {

using nlohmann::json;

/// The reason alone: the library puts its own name and position in front of it.
std::string reasonBehind(const json::exception& error, const char* front) {
  const std::string what = error.what();
  const auto at = what.find(front);
  return foreignText(at == std::string::npos ? what
                                             : what.substr(at + std::string_view(front).size()));
}

/// Of two values with one key in an object, the library would silently keep one.
class KeysOnce {
 public:
  explicit KeysOnce(const std::string& file) : file_(file) {}

  bool operator()(int /*depth*/, json::parse_event_t event, const json& parsed) {
    if (event == json::parse_event_t::object_start) open_.emplace_back();
    if (event == json::parse_event_t::object_end) open_.pop_back();
    if (event != json::parse_event_t::key) return true;
    Object& object = open_.back();
    object.key = parsed.get<std::string>();
    if (!object.known.insert(object.key).second) {
      std::string name;
      for (const Object& outer : open_) name += (name.empty() ? "" : ".") + outer.key;
      throw InputError(file_, 0, name + " is given twice");
    }
    return true;
  }

 private:
  struct Object {
    std::set<std::string> known;
    std::string key;  ///< whose value is read
  };
  const std::string& file_;
  std::vector<Object> open_;
};

}  // namespace

json parseJson(const std::string& text, const std::string& file) {
  requireModestJson(text, file);
  KeysOnce once(file);
  try {
    return json::parse(text, std::ref(once));
  } catch (const json::parse_error& error) {
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(error.byte, text.size()));
    const auto line = 1 + std::count(text.begin(), end, '\n');
    throw InputError(file, static_cast<int>(line), "malformed JSON: " + reasonBehind(error, ": "));
  } catch (const json::exception& error) {  // a number beyond every double
    throw InputError(file, 0, "malformed JSON: " + reasonBehind(error, "] "));
  }
}

}  // namespace swept::detail
