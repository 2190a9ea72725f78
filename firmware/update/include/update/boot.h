#pragma once

#include <cstdint>
#include <optional>

#include "update/layout.h"

/// The decision of a boot loader at each start.
namespace nplc::update {

struct Loader {
    ports::Storage& storage;
    const Layout& layout;
    std::uint32_t board;
    const signature::PublicKey& key;
    signature::Meanwhile meanwhile;  ///< feeds a watchdog that may be running
};

struct Start {
    unsigned slot;
    bool on_trial;
};

/// The slot to start; a start on trial has been recorded before this returns. Empty: no slot has a complete
/// and signed image.
std::optional<Start> choose(const Loader& loader);

}  // namespace nplc::update
