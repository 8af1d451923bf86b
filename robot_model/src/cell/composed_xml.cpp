// SPDX-License-Identifier: BSD-3-Clause
#include "cell/composed_xml.hpp"

#include <algorithm>
#include <cstddef>

namespace swept::detail {

namespace {

using Element = ComposedXml::Element;

/// Prints each element on a line of its own, and knows which.
class LinesPrinter : public tinyxml2::XMLPrinter {
 public:
  using Origins = std::map<const Element*, LineOrigin>;
  explicit LinesPrinter(const Origins& origins) : origins_(origins) {}

  bool VisitEnter(const Element& element, const tinyxml2::XMLAttribute* first) override {
    const bool goesOn = XMLPrinter::VisitEnter(element, first);
    const std::string_view text(CStr(), CStrSize() - 1);
    const auto begin = text.begin() + static_cast<std::ptrdiff_t>(counted_);
    line_ += static_cast<std::size_t>(std::count(begin, text.end(), '\n'));
    counted_ = text.size();
    // A line without an element of its own belongs to the one before.
    const auto known = origins_.find(&element);
    const LineOrigin last = lines_.empty() ? LineOrigin{} : lines_.back();
    lines_.resize(line_ + 1, last);
    lines_[line_] = known == origins_.end() ? last : known->second;
    return goesOn;
  }
  std::vector<LineOrigin> takeLines() { return std::move(lines_); }

 private:
  const Origins& origins_;
  std::vector<LineOrigin> lines_;
  std::size_t counted_ = 0;
  std::size_t line_ = 0;
};

}  // namespace

ComposedXml::ComposedXml(const std::string& robotName) : root_(document_.NewElement("robot")) {
  root_->SetAttribute("name", robotName.c_str());
  document_.InsertEndChild(root_);
}

Element& ComposedXml::add(const char* name, const LineOrigin& origin) {
  Element& added = add(*root_, name);
  origins_[&added] = origin;
  return added;
}

Element& ComposedXml::add(Element& parent, const char* name) {
  Element* const added = document_.NewElement(name);
  parent.InsertEndChild(added);
  return *added;
}

Element& ComposedXml::copy(const Element& element, const std::string& file) {
  Element* const copied = element.DeepClone(&document_)->ToElement();
  root_->InsertEndChild(copied);
  note(*copied, element, file);
  return *copied;
}

void ComposedXml::note(const Element& copied, const Element& original, const std::string& file) {
  origins_[&copied] = {file, original.GetLineNum()};
  const Element* from = original.FirstChildElement();
  for (const Element* to = copied.FirstChildElement(); to != nullptr;
       to = to->NextSiblingElement(), from = from->NextSiblingElement())
    note(*to, *from, file);
}

ComposedXml::Text ComposedXml::print() const {
  LinesPrinter printer(origins_);
  document_.Print(&printer);
  return {printer.CStr(), printer.takeLines()};
}

void prefixAttribute(Element& element, const char* attribute, const std::string& prefix) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const char* const value = element.Attribute(attribute);
  if (value == nullptr) return;
  const std::string_view all = value;
  const auto begin = all.find_first_not_of(kBlanks);
  if (begin == std::string_view::npos) return;
  const std::string name(all.substr(begin, all.find_last_not_of(kBlanks) + 1 - begin));
  element.SetAttribute(attribute, (prefix + name).c_str());
}

}  // namespace swept::detail
