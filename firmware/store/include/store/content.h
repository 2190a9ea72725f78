#pragma once

#include <cstdint>
#include <span>

#include "base/result.h"

namespace nplc::store {

/// What must be true of bytes before a slot holding them becomes the current one. They are handed over in
/// order, in pieces, as they read back from the storage.
class Content {
  public:
    virtual void begin() = 0;
    virtual base::Status take(std::span<const std::uint8_t> bytes) = 0;
    virtual base::Status end() = 0;  ///< all bytes were handed over

  protected:
    ~Content() = default;
};

/// Whatever reads back as it was sent.
class AnyContent final : public Content {
  public:
    void begin() override {}
    base::Status take(std::span<const std::uint8_t>) override { return {}; }
    base::Status end() override { return {}; }
};

}  // namespace nplc::store
