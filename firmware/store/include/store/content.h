#pragma once

#include <cstdint>
#include <span>

#include "base/result.h"

namespace nplc::store {

/// Checks the bytes of a slot before it becomes the current one. They are passed in order, in pieces, as read
/// back from the storage.
class Content {
  public:
    virtual void begin() = 0;
    virtual base::Status take(std::span<const std::uint8_t> bytes) = 0;
    virtual base::Status end() = 0;  ///< all bytes were passed

  protected:
    ~Content() = default;
};

/// Accepts any bytes.
class AnyContent final : public Content {
  public:
    void begin() override {}
    base::Status take(std::span<const std::uint8_t>) override { return {}; }
    base::Status end() override { return {}; }
};

}  // namespace nplc::store
