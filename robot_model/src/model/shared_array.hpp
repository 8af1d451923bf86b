// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace swept::detail {

/// Immutable elements that several versions of a checker read: copies share them. Reading one is as
/// quick as from a std::vector.
template <typename T>
class SharedArray {
 public:
  SharedArray() = default;
  explicit SharedArray(std::vector<T> elements)
      : owner_(std::make_shared<const std::vector<T>>(std::move(elements))),
        data_(owner_->data()),
        size_(owner_->size()) {}

  const T& operator[](std::size_t i) const { return data_[i]; }
  const T* data() const { return data_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// Whether the two share the same elements, not only equal ones.
  bool shares(const SharedArray& other) const { return owner_ == other.owner_; }

 private:
  std::shared_ptr<const std::vector<T>> owner_;
  const T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace swept::detail
