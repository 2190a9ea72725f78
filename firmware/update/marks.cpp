#include "update/marks.h"

#include <algorithm>

#include "base/bytes.h"

namespace nplc::update {
namespace {

/// Number of units of a mark, and the first of them.
struct Row {
    unsigned first;
    unsigned count;
    std::uint32_t code;
};

/// In the order of Mark. A confirmation damaged by a power cut is written again.
constexpr std::array<Row, 3> kRows{{{0, 1, 0x504D4F43},             // "COMP"
                                    {1, kTries, 0x45495254},        // "TRIE"
                                    {1 + kTries, 3, 0x464E4F43}}};  // "CONF"

const Row& row_of(Mark mark) {
    return kRows[static_cast<std::size_t>(mark)];
}

enum class Unit : std::uint8_t { erased, whole, other };

Unit read_unit(ports::Storage& storage, const Layout& layout, unsigned slot, unsigned number,
               std::uint32_t code) {
    std::array<std::uint8_t, kLargestUnit> bytes{};
    const auto unit = std::span(bytes).first(layout.unit());
    if (!storage.read(layout.mark(slot, number), unit)) return Unit::other;
    if (std::all_of(unit.begin(), unit.end(), [](std::uint8_t byte) { return byte == 0xFF; }))
        return Unit::erased;
    return base::load_u32(bytes.data()) == code ? Unit::whole : Unit::other;
}

template <class Count>
unsigned count_if(ports::Storage& storage, const Layout& layout, unsigned slot, Mark mark, Count counts) {
    const Row& row = row_of(mark);
    unsigned found = 0;
    for (unsigned i = 0; i < row.count; ++i)
        found += counts(read_unit(storage, layout, slot, row.first + i, row.code)) ? 1U : 0U;
    return found;
}

bool has(ports::Storage& storage, const Layout& layout, unsigned slot, Mark mark) {
    return count_if(storage, layout, slot, mark, [](Unit unit) { return unit == Unit::whole; }) != 0;
}

}  // namespace

SlotView look(ports::Storage& storage, const Layout& layout, unsigned slot, std::uint32_t board) {
    SlotView view;
    std::array<std::uint8_t, kSignedBytes> bytes{};
    if (!storage.read(layout.header(slot), bytes)) return view;
    view.header = decode(bytes);
    if (view.header && !layout.fits(*view.header, slot, board)) view.header.reset();
    view.marks.complete = has(storage, layout, slot, Mark::complete);
    view.marks.confirmed = has(storage, layout, slot, Mark::confirmed);
    view.marks.tries = static_cast<std::uint8_t>(
        count_if(storage, layout, slot, Mark::tried, [](Unit unit) { return unit != Unit::erased; }));
    return view;
}

std::optional<std::uint32_t> place_for(ports::Storage& storage, const Layout& layout, unsigned slot,
                                       Mark mark) {
    const Row& row = row_of(mark);
    for (unsigned i = row.first; i < row.first + row.count; ++i) {
        if (read_unit(storage, layout, slot, i, row.code) == Unit::erased) return layout.mark(slot, i);
    }
    return std::nullopt;
}

std::array<std::uint8_t, kLargestUnit> bytes_of(Mark mark) {
    std::array<std::uint8_t, kLargestUnit> bytes;
    bytes.fill(0xFF);
    base::store_u32(bytes.data(), row_of(mark).code);
    return bytes;
}

}  // namespace nplc::update
