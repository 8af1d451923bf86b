// SPDX-License-Identifier: BSD-3-Clause
#include "io/yaml_documents.hpp"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include <sstream>

namespace swept::detail {

namespace {

/// Looks for content behind the first document.
class SecondDocument : public YAML::EventHandler {
 public:
  using Mark = YAML::Mark;
  using Style = YAML::EmitterStyle::value;

  void OnDocumentStart(const Mark& mark) override {
    // yaml-cpp 0.7 stays before what it cannot read, and finds empty documents there without end.
    if (documents_ > 0 && mark.pos <= begin_)
      throw YAML::ParserException(mark, "this is part of no document");
    begin_ = mark.pos;
    ++documents_;
  }
  void OnDocumentEnd() override {}
  void OnNull(const Mark&, YAML::anchor_t) override {}
  void OnAlias(const Mark& mark, YAML::anchor_t) override { note(mark); }
  void OnScalar(const Mark& mark, const std::string&, YAML::anchor_t, const std::string&) override {
    note(mark);
  }
  void OnSequenceStart(const Mark& mark, const std::string&, YAML::anchor_t, Style) override {
    note(mark);
  }
  void OnSequenceEnd() override {}
  void OnMapStart(const Mark& mark, const std::string&, YAML::anchor_t, Style) override {
    note(mark);
  }
  void OnMapEnd() override {}

  const std::optional<int>& line() const { return line_; }

 private:
  void note(const Mark& mark) {
    if (documents_ > 1 && !line_) line_ = mark.line + 1;
  }

  int documents_ = 0;
  int begin_ = 0;
  std::optional<int> line_;
};

}  // namespace

std::optional<int> lineOfSecondDocument(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  SecondDocument documents;
  while (!documents.line() && parser.HandleNextDocument(documents)) continue;
  return documents.line();
}

void requireDocumentsEnd(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  SecondDocument documents;
  while (parser.HandleNextDocument(documents)) continue;
}

}  // namespace swept::detail
