#pragma once

#include "base/error.h"

namespace nplc::base {

/// A value or an Error. `value()` needs `ok()`, `error()` needs `!ok()`.
template <class T>
class [[nodiscard]] Result {
  public:
    constexpr Result(T value) : value_(value) {}      // NOLINT: implicit by purpose
    constexpr Result(Error error) : error_(error) {}  // NOLINT: implicit by purpose
    constexpr bool ok() const { return error_ == Error{}; }
    constexpr explicit operator bool() const { return ok(); }
    constexpr const T& value() const { return value_; }
    constexpr Error error() const { return error_; }

  private:
    T value_{};
    Error error_{};
};

template <>
class [[nodiscard]] Result<void> {
  public:
    constexpr Result() = default;
    constexpr Result(Error error) : error_(error) {}  // NOLINT: implicit by purpose
    constexpr bool ok() const { return error_ == Error{}; }
    constexpr explicit operator bool() const { return ok(); }
    constexpr Error error() const { return error_; }

  private:
    Error error_{};
};

using Status = Result<void>;

}  // namespace nplc::base
