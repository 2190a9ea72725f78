#pragma once

#include <cstdint>
#include <string>

#include "random_tables.h"

namespace nplc::property {

/// How much of what the rules speak about a run has met, so that no test passes on tables that never fire.
struct Seen {
    std::uint64_t scans = 0;
    std::uint64_t refused = 0;
    std::uint64_t fired = 0;         ///< scans with a true term
    std::uint64_t several_true = 0;  ///< scans with more than one
    std::uint64_t orders = 0;
    std::uint64_t idle_repeats = 0;  ///< scans without effect that were held to do nothing again
};

/// One random table of `shape`, `scans` scans with random images, pauses and restored states: the naive
/// sequencer against Engine and is_true(). Returns what differs first, or "".
std::string duel(Shape shape, std::uint64_t seed, int scans, Seen& seen);

}  // namespace nplc::property
