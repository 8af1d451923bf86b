// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_source.hpp"

namespace tinyxml2 {
class XMLDocument;
class XMLElement;
}  // namespace tinyxml2

namespace swept::detail {

/// An XML file whose elements are read strictly: every accessor throws InputError with the
/// element's line, its text and what is allowed. `owner` says whose element it is: `joint 'elbow'`.
class XmlFile {
 public:
  using Element = tinyxml2::XMLElement;

  /// Throws InputError for malformed XML.
  XmlFile(const std::string& text, const InputSource& source);
  ~XmlFile();

  /// The root element, which must be <robot>.
  Element& robot();
  const InputSource& source() const { return source_; }
  /// The document as text.
  std::string print() const;

  [[noreturn]] void fail(const Element& element, const std::string& message) const;

  /// The only child of that name, or null.
  Element* onlyChild(Element& parent, const char* name, const std::string& owner) const;
  /// An attribute that must be there and not be empty.
  std::string text(const Element& element, const char* attribute, const std::string& owner) const;
  /// A number; `fallback` when the attribute is absent, an error without one.
  double number(const Element& element, const char* attribute, const std::string& owner,
                std::optional<double> fallback = {}) const;
  double notNegative(const Element& element, const char* attribute, const std::string& owner) const;
  Eigen::Vector3d vector(const Element& element, const char* attribute, const std::string& owner,
                         const std::optional<Eigen::Vector3d>& fallback = {}) const;

  /// `<name attribute="value">`, as messages quote it.
  static std::string quote(const Element& element, const char* attribute);

 private:
  const InputSource& source_;
  std::unique_ptr<tinyxml2::XMLDocument> document_;
};

}  // namespace swept::detail
