#include "update/boot.h"

#include <algorithm>
#include <array>

#include "update/marks.h"

namespace nplc::update {
namespace {

using Views = std::array<SlotView, kSlots>;

bool has_hash(const Loader& loader, unsigned slot, const ImageHeader& header) {
    signature::Sha512 hash;
    std::array<std::uint8_t, ports::Storage::kReadAtOnce> piece{};
    for (std::uint32_t at = 0; at < header.length;) {
        const auto bytes = std::span(piece).first(std::min<std::size_t>(piece.size(), header.length - at));
        if (!loader.storage.read(loader.layout.image(slot) + at, bytes)) return false;
        loader.meanwhile();
        hash.add(bytes);
        at += static_cast<std::uint32_t>(bytes.size());
    }
    return hash.end() == header.hash;
}

/// The hash first: it detects failing flash.
bool is_sound(const Loader& loader, unsigned slot, const ImageHeader& header) {
    std::array<std::uint8_t, kHeaderBytes> bytes{};
    if (!has_hash(loader, slot, header) || !loader.storage.read(loader.layout.header(slot), bytes))
        return false;
    signature::Signature signature;
    std::copy_n(bytes.begin() + kSignedBytes, signature.size(), signature.begin());
    return signature::is_signed(std::span(bytes).first<kSignedBytes>(), signature, loader.key,
                                loader.meanwhile);
}

bool note_try(const Loader& loader, unsigned slot) {
    const auto place = place_for(loader.storage, loader.layout, slot, Mark::tried);
    const auto bytes = bytes_of(Mark::tried);
    if (!place || !loader.storage.program(*place, std::span(bytes).first(loader.layout.unit()))) return false;
    while (loader.storage.state() == ports::StorageState::busy) continue;
    return loader.storage.state() == ports::StorageState::ready;
}

/// 0 is preferred; higher: must not be started.
unsigned rank(const Views& views, unsigned slot) {
    constexpr unsigned kNever = 3;
    const SlotView& view = views[slot];
    const SlotView& other = views[1U - slot];
    if (!view.is_complete()) return kNever;
    const bool is_newer = !other.is_confirmed() || view.header->version > other.header->version;
    if (view.is_on_trial() && is_newer) return 0;
    return view.marks.confirmed ? 1 : 2;
}

bool comes_first(const Views& views, unsigned slot) {
    const unsigned other = 1U - slot;
    const unsigned mine = rank(views, slot);
    const unsigned others = rank(views, other);
    if (mine != others) return mine < others;
    return views[slot].is_complete() && views[slot].header->version > views[other].header->version;
}

}  // namespace

std::optional<Start> choose(const Loader& loader) {
    Views views;
    for (unsigned slot = 0; slot < kSlots; ++slot)
        views[slot] = look(loader.storage, loader.layout, slot, loader.board);
    const unsigned first = comes_first(views, 1) ? 1 : 0;
    for (const unsigned slot : {first, 1U - first}) {
        if (!views[slot].is_complete() || !is_sound(loader, slot, *views[slot].header)) continue;
        const bool on_trial = rank(views, slot) == 0;
        if (on_trial && !note_try(loader, slot)) continue;
        return Start{.slot = slot, .on_trial = on_trial};
    }
    return std::nullopt;
}

}  // namespace nplc::update
