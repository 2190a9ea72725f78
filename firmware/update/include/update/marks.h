#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "update/layout.h"

/// The marks of a slot, each in a program unit of its own that is programmed once.
namespace nplc::update {

inline constexpr unsigned kTries = 3;  ///< starts of an unconfirmed image

enum class Mark : std::uint8_t { complete, tried, confirmed };

struct Marks {
    bool complete = false;
    bool confirmed = false;
    std::uint8_t tries = 0;
    bool operator==(const Marks&) const = default;
};

/// The contents of a slot according to its header; only the boot loader verifies it.
struct SlotView {
    std::optional<ImageHeader> header;  ///< empty: none for this slot and board
    Marks marks;
    bool is_complete() const { return header && marks.complete; }
    bool is_confirmed() const { return is_complete() && marks.confirmed; }
    bool is_on_trial() const { return is_complete() && !marks.confirmed && marks.tries < kTries; }
};

/// Empty if the storage cannot be read.
SlotView look(ports::Storage& storage, const Layout& layout, unsigned slot, std::uint32_t board);

/// The next unit for programming `mark`: for `tried` and `confirmed` the first unprogrammed one. Empty: all
/// are used.
std::optional<std::uint32_t> place_for(ports::Storage& storage, const Layout& layout, unsigned slot,
                                       Mark mark);
std::array<std::uint8_t, kLargestUnit> bytes_of(Mark mark);

}  // namespace nplc::update
