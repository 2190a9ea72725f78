// Firmware on its way to a board: a file of anything holds whole links or none; what is received leaves the
// running slot as it is, and a loader starts from the other only what is signed.
#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/bytes.h"
#include "base/crc32.h"
#include "fuzz.h"
#include "images.h"
#include "nanoctl/firmware.h"
#include "sim/sim_storage.h"
#include "update/boot.h"
#include "update/receiver.h"

namespace {

using namespace nplc;
using update::Mark;
using update::Phase;
using Input = std::span<const std::uint8_t>;

constexpr ports::StorageGeometry kGeometry{
    .size = 8192, .erase_block = 1024, .program_page = 1024, .program_unit = 4};
constexpr update::Layout kLayout{kGeometry, 0, update::kSlotBytes, 0x3000};

void file(Input bytes) {
    for (const nanoctl::FirmwareLink& link : nanoctl::firmware_links(bytes)) {
        require(link.bytes.data() >= bytes.data() &&
                link.bytes.data() + link.bytes.size() <= bytes.data() + bytes.size());
        require(link.bytes.size() == update::kImageAt + (link.header.length + 3) / 4 * 4);
        require(update::decode(link.bytes.first<update::kSignedBytes>()) == link.header);
    }
}

void finish(sim::SimStorage& storage) {
    while (storage.state() == ports::StorageState::busy) {
    }
}

void put(sim::SimStorage& storage, std::uint32_t address, Input bytes) {
    for (std::size_t at = 0; at + kGeometry.program_unit <= bytes.size(); at += kGeometry.program_unit) {
        const auto unit = bytes.subspan(at, kGeometry.program_unit);
        require(storage.program(address + static_cast<std::uint32_t>(at), unit).ok());
        finish(storage);
    }
}

void put_mark(sim::SimStorage& storage, unsigned slot, Mark mark) {
    const auto bytes = update::bytes_of(mark);
    if (const auto place = update::place_for(storage, kLayout, slot, mark))
        put(storage, *place, Input(bytes).first(kGeometry.program_unit));
}

/// Version 0.0.2 in slot 0, confirmed.
sim::SimStorage board() {
    sim::SimStorage storage(kGeometry);
    put(storage, kLayout.header(0), update::firmware(2, 0));
    for (const Mark mark : {Mark::complete, Mark::tried, Mark::confirmed}) put_mark(storage, 0, mark);
    return storage;
}

/// Version 0.0.3 for slot 1, its bytes at `places` changed, or cut: pairs of a place and what is xored.
update::Bytes changed(Input places) {
    update::Bytes bytes = update::firmware(3, 1);
    for (; places.size() >= 3; places = places.subspan(3))
        bytes[base::load_u16(places.data()) % bytes.size()] ^= places[2];
    if (places.size() == 2) bytes.resize(bytes.size() - 4U * (places[0] % 100U));
    return bytes;
}

void hold_old(const sim::SimStorage& storage, const sim::SimStorage& before) {
    require(std::ranges::equal(storage.bytes().first(update::kSlotBytes),
                               before.bytes().first(update::kSlotBytes)));
}

void start(sim::SimStorage& storage, bool is_genuine) {
    // A signature takes as long as a thousand inputs.
    if (!update::look(storage, kLayout, 1, update::kBoard).is_complete()) return;
    const auto chosen = update::choose({.storage = storage,
                                        .layout = kLayout,
                                        .board = update::kBoard,
                                        .key = update::kKey,
                                        .meanwhile = [] {}});
    require(chosen.has_value());
    require(chosen->slot == 0 || is_genuine);
}

/// Content of unknown origin in the other slot; its first byte selects the marks.
void other_slot(Input input) {
    if (input.empty()) return;
    sim::SimStorage storage = board();
    const sim::SimStorage before = storage;
    const update::Bytes genuine = update::firmware(3, 1);
    const bool is_raw = (input[0] & 1) != 0;
    const Input rest = input.subspan(1);
    update::Bytes bytes = is_raw ? update::Bytes(rest.begin(), rest.end()) : changed(rest);
    bytes.resize(std::min<std::size_t>(bytes.size(), kLayout.capacity()));
    put(storage, kLayout.header(1), bytes);
    for (unsigned bit = 1; bit < 8; ++bit)
        if ((input[0] >> bit & 1) != 0) put_mark(storage, 1, static_cast<Mark>(bit % 3));
    const auto slot = storage.bytes().subspan(kLayout.header(1), genuine.size());
    const bool is_header = std::equal(slot.begin(), slot.begin() + update::kHeaderBytes, genuine.begin());
    const bool is_image =
        std::equal(slot.begin() + update::kImageAt, slot.end(), genuine.begin() + update::kImageAt);
    start(storage, is_header && is_image);
    hold_old(storage, before);
}

/// The other slot by the receiver, from calls in any order.
void receive(Input calls) {
    sim::SimStorage storage = board();
    const sim::SimStorage before = storage;
    update::Receiver receiver(storage, kLayout, update::kBoard, 0);
    const update::Bytes firmware = update::firmware(3, 1);
    const auto size = static_cast<std::uint32_t>(firmware.size());
    for (; calls.size() >= 2; calls = calls.subspan(2)) {
        const std::uint32_t value = calls[1];
        switch (calls[0] % 6) {
            case 0:
                static_cast<void>(receiver.begin(value * 20));
                break;
            case 1: {
                const std::uint32_t at = std::min(receiver.received() + (value & 1) * 4, size);
                const auto piece = std::min<std::size_t>((value >> 1 & 0x3F) * 4, size - at);
                static_cast<void>(receiver.write(at, std::span(firmware).subspan(at, piece)));
                break;
            }
            case 2:
                static_cast<void>(receiver.finish(size - value / 64 * 4, base::crc32(firmware) + value % 64));
                break;
            case 3:
                receiver.abandon();
                break;
            case 4:
                receiver.confirm();
                break;
            default:
                for (std::uint32_t i = 0; i <= value * 8; ++i) receiver.poll();
        }
        if (receiver.phase() == Phase::done) require(receiver.slot(1).is_complete());
    }
    finish(storage);
    start(storage, true);
    hold_old(storage, before);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const Input input = Input(data, size).subspan(1);
    switch (data[0] % 3) {
        case 0:
            file(input);
            break;
        case 1:
            other_slot(input);
            break;
        default:
            receive(input);
    }
    return 0;
}
