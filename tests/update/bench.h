#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "base/crc32.h"
#include "images.h"
#include "sim/sim_storage.h"
#include "update/boot.h"
#include "update/receiver.h"

namespace nplc::update {

struct Shape {
    const char* name;
    ports::StorageGeometry geometry;
    Layout layout{geometry, 0, kSlotBytes, 0x3000};
};

inline std::vector<Shape> shapes() {
    return {{"flash 1024/4", {.size = 8192, .erase_block = 1024, .program_page = 1024, .program_unit = 4}},
            {"flash 2048/8", {.size = 8192, .erase_block = 2048, .program_page = 64, .program_unit = 8}}};
}

inline void finish(sim::SimStorage& device) {
    while (device.state() == ports::StorageState::busy) continue;
}

/// As a debugger would, units whole.
inline void put(sim::SimStorage& device, std::uint32_t address, Bytes bytes) {
    while (bytes.size() % device.geometry().program_unit != 0) bytes.push_back(0xFF);
    for (std::uint32_t at = 0; at < bytes.size(); at += device.geometry().program_unit) {
        EXPECT_TRUE(
            device.program(address + at, std::span(bytes).subspan(at, device.geometry().program_unit)).ok());
        finish(device);
    }
}

inline void put_mark(sim::SimStorage& device, const Layout& layout, unsigned slot, Mark mark) {
    const auto place = place_for(device, layout, slot, mark);
    ASSERT_TRUE(place);
    const auto bytes = bytes_of(mark);
    put(device, *place, Bytes(bytes.begin(), bytes.begin() + layout.unit()));
}

/// With the marks named: complete, then tries, then confirmed.
inline void install(sim::SimStorage& device, const Layout& layout, unsigned slot, const Bytes& bytes,
                    Marks marks) {
    put(device, layout.header(slot), bytes);
    if (marks.complete) put_mark(device, layout, slot, Mark::complete);
    for (unsigned i = 0; i < marks.tries; ++i) put_mark(device, layout, slot, Mark::tried);
    if (marks.confirmed) put_mark(device, layout, slot, Mark::confirmed);
}

inline constexpr Marks kConfirmed{.complete = true, .confirmed = true, .tries = 1};
inline constexpr Marks kFresh{.complete = true};

inline std::optional<Start> boot(sim::SimStorage& device, const Layout& layout) {
    return choose({.storage = device, .layout = layout, .board = kBoard, .key = kKey, .meanwhile = [] {}});
}

/// "1 on trial", "0", "none"
inline std::string boots(sim::SimStorage& device, const Layout& layout) {
    const auto start = boot(device, layout);
    if (!start) return "none";
    return std::to_string(start->slot) + (start->on_trial ? " on trial" : "");
}

inline void poll_while(Receiver& receiver, Phase phase) {
    for (int i = 0; receiver.phase() == phase && i < 100'000; ++i) receiver.poll();
}

/// In pieces of 120 bytes, as nanoctl sends them. What finish() or a piece answers if it is no.
inline Result send(Receiver& receiver, const Bytes& bytes, std::optional<std::uint32_t> crc = {}) {
    if (const Result begun = receiver.begin(static_cast<std::uint32_t>(bytes.size())); begun != Result::done)
        return begun;
    poll_while(receiver, Phase::erasing);
    for (std::uint32_t at = 0; at < bytes.size();) {
        const auto count =
            std::min<std::uint32_t>(Receiver::kLargestPiece, static_cast<std::uint32_t>(bytes.size()) - at);
        const Result taken = receiver.write(at, std::span(bytes).subspan(at, count));
        if (taken == Result::done) at += count;
        if (taken != Result::done && taken != Result::busy)
            return receiver.phase() == Phase::failed ? receiver.error() : taken;
        receiver.poll();
    }
    const Result closed =
        receiver.finish(static_cast<std::uint32_t>(bytes.size()), crc.value_or(base::crc32(bytes)));
    if (closed != Result::done) return closed;
    poll_while(receiver, Phase::closing);
    return receiver.phase() == Phase::done ? Result::done : receiver.error();
}

}  // namespace nplc::update
