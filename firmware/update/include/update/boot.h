#pragma once

#include <cstdint>
#include <optional>

#include "update/layout.h"

/// What a loader does at each start.
namespace nplc::update {

struct Loader {
    ports::Storage& storage;
    const Layout& layout;
    std::uint32_t board;
    const signature::PublicKey& key;
    signature::Meanwhile meanwhile;  ///< feeds a watchdog that may run
};

struct Start {
    unsigned slot;
    bool on_trial;
};

/// The slot to start; an image on trial has been noted as tried before this returns. Nothing: no slot holds
/// an image that is whole and signed.
std::optional<Start> choose(const Loader& loader);

}  // namespace nplc::update
