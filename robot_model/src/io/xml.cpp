// SPDX-License-Identifier: BSD-3-Clause
#include "io/xml.hpp"

#include <tinyxml2.h>

#include <array>
#include <utility>

#include "text/numbers.hpp"

namespace swept::detail {

namespace {

constexpr std::array<std::pair<tinyxml2::XMLError, const char*>, 10> kSyntaxErrors{{
    {tinyxml2::XML_ERROR_EMPTY_DOCUMENT, "the document is empty"},
    {tinyxml2::XML_ERROR_MISMATCHED_ELEMENT, "an opening and a closing tag do not match"},
    {tinyxml2::XML_ERROR_PARSING_ELEMENT, "an element cannot be parsed"},
    {tinyxml2::XML_ERROR_PARSING_ATTRIBUTE, "an attribute cannot be parsed"},
    {tinyxml2::XML_ERROR_PARSING_COMMENT, "a comment is not closed"},
    {tinyxml2::XML_ERROR_PARSING_TEXT, "text is not closed by a tag"},
    {tinyxml2::XML_ERROR_PARSING_DECLARATION,
     "<?xml ...?> must be the first thing in the file, before comments and elements"},
    {tinyxml2::XML_ERROR_PARSING_CDATA, "a CDATA section is not closed"},
    {tinyxml2::XML_ERROR_PARSING_UNKNOWN, "a tag that starts with '<!' is not closed"},
    {tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED, "elements are nested too deeply"},
}};

std::string syntaxError(const tinyxml2::XMLDocument& document) {
  for (const auto& [error, text] : kSyntaxErrors)
    if (error == document.ErrorID()) return text;
  return document.ErrorName();
}

}  // namespace

XmlFile::XmlFile(const std::string& text, const InputSource& source)
    : source_(source), document_(std::make_unique<tinyxml2::XMLDocument>()) {
  if (document_->Parse(text.data(), text.size()) != tinyxml2::XML_SUCCESS) {
    const int line = document_->ErrorLineNum();
    source.fail(line > 0 ? line : 1, "malformed XML: " + syntaxError(*document_));
  }
}

XmlFile::~XmlFile() = default;

XmlFile::Element& XmlFile::robot() {
  Element* root = document_->RootElement();
  if (root == nullptr) source_.fail(1, "the root element must be <robot>, there is none");
  if (std::string_view(root->Name()) != "robot") {
    fail(*root, std::string("the root element must be <robot>, not <") + root->Name() + ">");
  }
  if (const Element* second = root->NextSiblingElement()) {
    fail(*second,
         std::string("<") + second->Name() + "> follows the root element; one root is allowed");
  }
  return *root;
}

std::string XmlFile::print() const {
  tinyxml2::XMLPrinter printer;
  document_->Print(&printer);
  return printer.CStr();
}

void XmlFile::fail(const Element& element, const std::string& message) const {
  source_.fail(element.GetLineNum(), message);
}

XmlFile::Element* XmlFile::onlyChild(Element& parent, const char* name,
                                     const std::string& owner) const {
  Element* child = parent.FirstChildElement(name);
  if (child == nullptr) return nullptr;
  if (const Element* second = child->NextSiblingElement(name)) {
    fail(*second, owner + " has a second <" + name + ">; one is allowed");
  }
  return child;
}

std::string XmlFile::text(const Element& element, const char* attribute,
                          const std::string& owner) const {
  const char* value = element.Attribute(attribute);
  const std::string of = owner.empty() ? "" : " of " + owner;
  if (value == nullptr) {
    fail(element,
         std::string("<") + element.Name() + ">" + of + " has no attribute '" + attribute + "'");
  }
  if (value[0] == '\0') fail(element, quote(element, attribute) + of + " must not be empty");
  return value;
}

double XmlFile::number(const Element& element, const char* attribute, const std::string& owner,
                       std::optional<double> fallback) const {
  if (fallback && element.Attribute(attribute) == nullptr) return *fallback;
  const auto value = parseNumber(text(element, attribute, owner));
  if (!value)
    fail(element, quote(element, attribute) + " of " + owner + " must be a finite number");
  return *value;
}

double XmlFile::notNegative(const Element& element, const char* attribute,
                            const std::string& owner) const {
  const double value = number(element, attribute, owner);
  if (!(value >= 0.0)) {
    fail(element, quote(element, attribute) + " of " + owner + " must be 0 or greater");
  }
  return value;
}

Eigen::Vector3d XmlFile::vector(const Element& element, const char* attribute,
                                const std::string& owner,
                                const std::optional<Eigen::Vector3d>& fallback) const {
  if (fallback && element.Attribute(attribute) == nullptr) return *fallback;
  const auto values = parseNumbers(text(element, attribute, owner));
  if (values.size() != 3) {
    fail(element, quote(element, attribute) + " of " + owner +
                      " must be 3 finite numbers separated by spaces");
  }
  return {values[0], values[1], values[2]};
}

std::string XmlFile::quote(const Element& element, const char* attribute) {
  const char* value = element.Attribute(attribute);
  return std::string("<") + element.Name() + " " + attribute + "=\"" + (value ? value : "") + "\">";
}

}  // namespace swept::detail
