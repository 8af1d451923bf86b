// SPDX-License-Identifier: BSD-3-Clause
#include <stdexcept>
#include <string>

#include "page/page_content.hpp"
#include "page/page_files.hpp"

namespace swept {
namespace {

/// Puts `text` in the place of the one comment `<!-- mark -->`.
void fill(std::string& page, const std::string& mark, const std::string& text) {
  const std::string comment = "<!-- " + mark + " -->";
  const std::size_t at = page.find(comment);
  if (at == std::string::npos) throw std::logic_error("page.html has no " + comment);
  page.replace(at, comment.size(), text);
}

/// JSON in which nothing looks like HTML: `<`, `>` and `&` occur in strings only, where they may be
/// written as escapes. Names that are not UTF-8 get replacement characters.
std::string harmless(const Json& data) {
  const std::string plain = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string text;
  text.reserve(plain.size());
  for (const char c : plain) {
    if (c == '<')
      text += "\\u003c";
    else if (c == '>')
      text += "\\u003e";
    else if (c == '&')
      text += "\\u0026";
    else
      text += c;
  }
  return text;
}

/// Browsers compile WebAssembly only where the page's policy says so.
void allowModule(std::string& page) {
  const std::string scripts = "script-src 'unsafe-inline'";
  const std::size_t at = page.find(scripts);
  if (at == std::string::npos) throw std::logic_error("page.html has no " + scripts);
  page.insert(at + scripts.size(), " 'wasm-unsafe-eval'");
}

bool isOfTask(const PageFile& file) {
  return file.name.starts_with("task.");
}

/// The page without its data, whose place the comment `data` keeps. `ofTask`: that around the pages
/// of phases. `isLive`: it has a module that proves.
std::string templateOf(bool ofTask, bool isLive = false) {
  std::string page, styles, licences, scripts;
  for (const PageFile& file : pageFiles()) {
    if (isOfTask(file) != ofTask || (file.name.starts_with("live") && !isLive)) continue;
    const std::string text(file.text);
    if (file.name.ends_with(".html"))
      page = text;
    else if (file.name.ends_with(".css"))
      styles += "<style>\n" + text + "</style>\n";
    else if (file.name.ends_with(".txt"))
      licences += "/*!\n" + text + "*/\n";
    else
      scripts += "<script>\n" + text + "\n</script>\n";
  }
  if (isLive) allowModule(page);
  fill(page, "styles", styles);
  if (!licences.empty()) scripts = "<script>\n" + licences + "</script>\n" + scripts;
  fill(page, "scripts", scripts);
  return page;
}

const std::string kDataBegins = "<script id=\"data\" type=\"application/json\">";
const std::string kDataEnds = "</script>\n";

}  // namespace

std::string htmlOf(const Json& data) {
  std::string page = templateOf(false, data.contains("live"));
  // The data goes in last, so that its text is not searched for marks.
  fill(page, "data", kDataBegins + harmless(data) + kDataEnds);
  return page;
}

std::string taskHtmlOf(Json task) {
  const std::string page = templateOf(false), mark = "<!-- data -->";
  const std::size_t at = page.find(mark);
  task["page"] = {page.substr(0, at) + kDataBegins, kDataEnds + page.substr(at + mark.size())};
  std::string whole = templateOf(true);
  fill(whole, "data", kDataBegins + harmless(task) + kDataEnds);
  return whole;
}

}  // namespace swept
