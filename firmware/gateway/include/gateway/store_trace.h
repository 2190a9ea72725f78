#pragma once

#include <cstdint>

#include "registers/vocabulary.h"

/// Whether a board may know what was where it now has a new store; only boards with files do.
#ifndef NPLC_STORE_TRACES
#define NPLC_STORE_TRACES 1
#endif

namespace nplc::gateway {

/// Why there is a store in which run was never commanded: flags of STORE_FLAGS.
enum class StoreTrace : std::uint8_t {
    none = 0,  ///< the axis is new, as far as the board knows
    lost = registers::gateway::kStoreLost,
    anothers = registers::gateway::kStoreOfAnother
};

class StoreTraces {
  public:
    void note(StoreTrace trace) { flags_ = static_cast<std::uint32_t>(trace); }
    std::uint32_t flags() const { return flags_; }

  private:
    std::uint32_t flags_ = 0;
};

struct NoStoreTraces {
    static constexpr void note(StoreTrace) {}
    static constexpr std::uint32_t flags() { return 0; }
};

#if NPLC_STORE_TRACES
using StoreTracePart = StoreTraces;
#else
using StoreTracePart = NoStoreTraces;
#endif

}  // namespace nplc::gateway
