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

/// A configuration is any sequence of doubles that are contiguous in memory: a
/// `std::vector<double>` (the result of namedConfiguration() and readers), an `Eigen::VectorXd`
/// (the result of Checker::interpolate and Robot::defaultState) or an Eigen vector of fixed size, a
/// column of a matrix, `std::array`, `std::span`, an array, or `{0.1, 0.2}`. All functions take
/// them through the types below, which are spans and cost nothing.
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

/// Whether the values are contiguous. Expressions, which are not in memory, have the stride 0.
template <typename Type>
concept PackedVector = Type::IsVectorAtCompileTime != 0 && Type::InnerStrideAtCompileTime == 1;

/// Temporaries: they end with the call, so anything written into them is lost.
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

/// Eigen matrices whose columns are contiguous and follow each other.
template <typename Values>
concept ColumnMatrix =
    EigenValues<Values> && std::derived_from<Values, Eigen::PlainObjectBase<EigenType<Values>>> &&
    !EigenType<Values>::IsRowMajor &&
    !EigenType<Values>::IsVectorAtCompileTime && HasData<Values, const double>;

/// Anything else that a span can refer to.
template <typename Values, typename Number>
concept SpanSource =
    !EigenValues<std::remove_cvref_t<Values>> && std::convertible_to<Values, std::span<Number>>;

template <typename Values>
concept Iterable = requires(Values& values) {
  *std::begin(values);
};

template <typename Values>
concept ManyValues = Iterable<Values> || EigenValues<std::remove_cvref_t<Values>>;

/// Numbers of another type, numbers that are not contiguous, and Eigen's expressions, which must be
/// evaluated first.
template <typename Values, typename Number>
concept NotPacked =
    ManyValues<Values> && !SpanSource<Values, Number> && !PackedEigenVector<Values, Number>;

}  // namespace detail

// A view made from another view is a copy of it, by whichever constructor.
// NOLINTBEGIN(bugprone-forwarding-reference-overload): a copy that they make is the same span

/// A view of a group's configuration, as functions take it: a span.
template <typename Number>
class BasicConfigurationView : public std::span<Number> {
 public:
  /// An empty view.
  constexpr BasicConfigurationView() = default;
  /// `count` values from `first` on.
  constexpr BasicConfigurationView(Number* first, std::size_t count)
      : std::span<Number>(first, count) {}
  /// Anything that a span can refer to.
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
  /// Not allowed: the values are not contiguous doubles.
  template <detail::NotPacked<Number> Values>
  BasicConfigurationView(Values&& notDoublesInARow) = delete;  // expressions of Eigen: .eval()
};

/// A configuration that is read.
using ConfigurationView = BasicConfigurationView<const double>;
/// A configuration that is written; it already has the right size.
using ConfigurationSpan = BasicConfigurationView<double>;

/// Many configurations that are consecutive in one array, or the columns of a matrix.
class PackedConfigurations : public std::span<const double> {
 public:
  /// `count` values from `first` on.
  constexpr PackedConfigurations(const double* first, std::size_t count) : span(first, count) {}
  /// Any type that a configuration may have, with the values of all.
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

/// A range whose configurations exist independently of the range's iterator.
template <typename Range>
concept ConfigurationRange = Iterable<Range> &&
    std::convertible_to<ElementOf<Range>, ConfigurationView> &&
    (std::is_lvalue_reference_v<ElementOf<Range>> || IsSpan<ElementOf<Range>>);

}  // namespace detail

/// Several configurations, each anywhere in memory, such as the states of a path. Refers to them.
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
  /// As for a vector.
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
