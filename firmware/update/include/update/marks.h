#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "update/layout.h"

/// What is noted of a slot, each mark in a program unit of its own that is programmed once.
namespace nplc::update {

inline constexpr unsigned kTries = 3;  ///< starts of an image that is not confirmed

enum class Mark : std::uint8_t { complete, tried, confirmed };

struct Marks {
    bool complete = false;
    bool confirmed = false;
    std::uint8_t tries = 0;
    bool operator==(const Marks&) const = default;
};

/// What is in a slot, as its header says; whether that is true only the loader looks.
struct SlotView {
    std::optional<ImageHeader> header;  ///< nothing: none for this slot and board
    Marks marks;
    bool is_complete() const { return header && marks.complete; }
    bool is_confirmed() const { return is_complete() && marks.confirmed; }
    bool is_on_trial() const { return is_complete() && !marks.confirmed && marks.tries < kTries; }
};

/// Nothing is found where the storage cannot be read.
SlotView look(ports::Storage& storage, const Layout& layout, unsigned slot, std::uint32_t board);

/// The unit that programming `mark` takes next: of `tried` and `confirmed` the first that nothing was
/// programmed to. Nothing: all are used up.
std::optional<std::uint32_t> place_for(ports::Storage& storage, const Layout& layout, unsigned slot,
                                       Mark mark);
std::array<std::uint8_t, kLargestUnit> bytes_of(Mark mark);

}  // namespace nplc::update
