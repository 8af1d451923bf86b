// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <compare>
#include <iosfwd>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace swept {

/// The name of a body, in an answer. Copies share one string, so no query allocates memory for a
/// name. It outlives the Checker that it comes from. It converts to a std::string and compares
/// with text.
class BodyName {
 public:
  BodyName() = default;  ///< empty
  ///@{
  /// A string of its own.
  explicit BodyName(std::string name);
  BodyName(const char* name) : BodyName(std::string(name)) {}
  ///@}
  /// A string that something else owns, as std::shared_ptr's aliasing constructor has it.
  explicit BodyName(std::shared_ptr<const std::string> name) : name_(std::move(name)) {}

  ///@{
  /// The text; it lives as long as any copy of this.
  const std::string& str() const;
  operator const std::string&() const { return str(); }
  operator std::string_view() const { return str(); }
  ///@}
  bool empty() const { return str().empty(); }  ///< no body

  ///@{
  /// By the text.
  friend bool operator==(const BodyName& a, const BodyName& b) { return a.str() == b.str(); }
  friend bool operator==(const BodyName& a, const std::string& b) { return a.str() == b; }
  friend bool operator==(const BodyName& a, std::string_view b) { return a.str() == b; }
  friend bool operator==(const BodyName& a, const char* b) { return a.str() == b; }
  friend auto operator<=>(const BodyName& a, const BodyName& b) { return a.str() <=> b.str(); }
  ///@}
  ///@{
  /// The text of one behind that of the other.
  friend std::string operator+(const BodyName& a, std::string_view b) {
    return std::string(a.str()).append(b);
  }
  friend std::string operator+(std::string_view a, const BodyName& b) {
    return std::string(a).append(b.str());
  }
  ///@}
  /// Writes the text.
  friend std::ostream& operator<<(std::ostream& out, const BodyName& name);

 private:
  std::shared_ptr<const std::string> name_;
};

}  // namespace swept
