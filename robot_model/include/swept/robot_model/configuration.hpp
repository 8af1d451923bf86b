// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

/// A configuration is any numbers of type double that follow each other in memory: a
/// `std::vector<double>` (what namedConfiguration() and readers return), an `Eigen::VectorXd` (what
/// Checker::interpolate and Robot::defaultState return) or an Eigen vector of fixed size, a column
/// of a matrix, `std::array`, `std::span`, an array, or `{0.1, 0.2}`. All functions take them as
/// they are, by the types below, which cost nothing: they are spans.
namespace swept {

namespace detail {

template <typename Derived>
Derived eigenTypeOf(const Eigen::DenseBase<Derived>&);

template <typename Values>
concept EigenValues = requires(const Values& values) {
  eigenTypeOf(values);
};

template <EigenValues Values>
using EigenType = decltype(eigenTypeOf(std::declval<const Values&>()));

template <typename Values>
using PlainType = EigenType<std::remove_cvref_t<Values>>;

/// Each value is where the one before it ends. Of expressions, which are nowhere, the stride is 0.
template <typename Type>
concept PackedVector = Type::IsVectorAtCompileTime != 0 && Type::InnerStrideAtCompileTime == 1;

/// Ends with the call, so that what is written into it is lost.
template <typename Values>
concept Ending =
    !std::is_lvalue_reference_v<Values> &&
    std::derived_from<std::remove_cvref_t<Values>, Eigen::PlainObjectBase<PlainType<Values>>>;

template <typename Values, typename Number>
concept HasData = std::is_convertible_v<decltype(std::declval<Values&>().data()), Number*>;

/// An Eigen vector that `std::span<Number>` can refer to.
template <typename Values, typename Number>
concept PackedEigenVector = EigenValues<std::remove_cvref_t<Values>> &&
    PackedVector<PlainType<Values>> && HasData<Values, Number> &&
    (std::is_const_v<Number> || !Ending<Values>);

/// Eigen matrices of whole columns that follow each other.
template <typename Values>
concept ColumnMatrix =
    EigenValues<Values> && std::derived_from<Values, Eigen::PlainObjectBase<EigenType<Values>>> &&
    !EigenType<Values>::IsRowMajor &&
    !EigenType<Values>::IsVectorAtCompileTime && HasData<Values, const double>;

/// Anything else that a span refers to.
template <typename Values, typename Number>
concept SpanSource =
    !EigenValues<std::remove_cvref_t<Values>> && std::convertible_to<Values, std::span<Number>>;

template <typename Values>
concept Iterable = requires(Values& values) {
  *std::begin(values);
};

template <typename Values>
concept ManyValues = Iterable<Values> || EigenValues<std::remove_cvref_t<Values>>;

/// Numbers of another type, numbers that do not follow each other, and Eigen's expressions, which
/// are no numbers before they are evaluated.
template <typename Values, typename Number>
concept NotPacked =
    ManyValues<Values> && !SpanSource<Values, Number> && !PackedEigenVector<Values, Number>;

}  // namespace detail

// A view that is made of another one is a copy of it, by whichever constructor.
// NOLINTBEGIN(bugprone-forwarding-reference-overload): a copy that they make is the same span

/// A configuration of a group: how functions take it, and a span of it.
template <typename Number>
class BasicConfigurationView : public std::span<Number> {
 public:
  /// Of no values.
  constexpr BasicConfigurationView() = default;
  /// So many values from here on.
  constexpr BasicConfigurationView(Number* first, std::size_t count)
      : std::span<Number>(first, count) {}
  /// Whatever a span refers to.
  template <detail::SpanSource<Number> Values>
  constexpr BasicConfigurationView(Values&& values)
      : std::span<Number>(static_cast<std::span<Number>>(std::forward<Values>(values))) {}
  /// An Eigen vector, a Map, Ref, segment or column.
  template <detail::PackedEigenVector<Number> Values>
  constexpr BasicConfigurationView(Values&& values)
      : std::span<Number>(values.data(), static_cast<std::size_t>(values.size())) {}
  /// `{0.1, 0.2}`, as an argument: the values live as long as the call.
  constexpr BasicConfigurationView(
      std::initializer_list<double> values) requires std::is_const_v<Number>
      : std::span<Number>(values.begin(), values.size()) {}
  /// Refused.
  template <detail::NotPacked<Number> Values>
  BasicConfigurationView(Values&& notDoublesInARow) = delete;  // expressions of Eigen: .eval()
};

/// One that is read.
using ConfigurationView = BasicConfigurationView<const double>;
/// One that is written: of the right size already.
using ConfigurationSpan = BasicConfigurationView<double>;

/// Many configurations that follow each other in one array, or are the columns of a matrix.
class PackedConfigurations : public std::span<const double> {
 public:
  /// So many values from here on.
  constexpr PackedConfigurations(const double* first, std::size_t count) : span(first, count) {}
  /// Whatever a configuration may be, with the values of all.
  template <std::convertible_to<ConfigurationView> Values>
  constexpr PackedConfigurations(Values&& values)
      : span(ConfigurationView(std::forward<Values>(values))) {}
  /// A column for each configuration.
  template <detail::ColumnMatrix Values>
  PackedConfigurations(const Values& matrix)
      : span(matrix.data(), static_cast<std::size_t>(matrix.size())) {}
};

namespace detail {

template <typename Values>
concept IsSpan =
    std::derived_from<Values, std::span<typename Values::element_type, Values::extent>>;

template <Iterable Range>
using ElementOf = decltype(*std::begin(std::declval<Range&>()));

/// Configurations that are there without the range's iterator.
template <typename Range>
concept ConfigurationRange = Iterable<Range> &&
    std::convertible_to<ElementOf<Range>, ConfigurationView> &&
    (std::is_lvalue_reference_v<ElementOf<Range>> || IsSpan<ElementOf<Range>>);

}  // namespace detail

/// Several configurations, one after the other, wherever each of them is: the states of a path.
/// Refers to them.
class ConfigurationList {
 public:
  /// A range of configurations that outlive the call: `std::vector<std::vector<double>>`,
  /// `std::vector<Eigen::VectorXd>`, ...
  template <detail::ConfigurationRange States>
  ConfigurationList(States&& states) {
    if constexpr (requires { std::size(states); }) states_.reserve(std::size(states));
    for (auto&& state : states) states_.emplace_back(state);
  }
  /// `{start, goal}`, as an argument, of any types.
  ConfigurationList(std::initializer_list<ConfigurationView> states) : states_(states) {}

  ///@{
  /// As of a vector.
  std::size_t size() const { return states_.size(); }
  bool empty() const { return states_.empty(); }
  const ConfigurationView& operator[](std::size_t i) const { return states_[i]; }
  std::vector<ConfigurationView>::const_iterator begin() const { return states_.begin(); }
  std::vector<ConfigurationView>::const_iterator end() const { return states_.end(); }
  ///@}

 private:
  std::vector<ConfigurationView> states_;
};

// NOLINTEND(bugprone-forwarding-reference-overload)

}  // namespace swept
