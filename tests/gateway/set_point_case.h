#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "base/bytes.h"
#include "base/crc32.h"
#include "registers/vocabulary.h"
#include "set_points/record.h"

namespace nplc::gateway {

/// A table with three set-points and requests to change them, written down byte by byte.
struct SetPointCase {
    using SetPoint = set_points::SetPoint;
    using Request = registers::gateway::SetPointRequest;
    using Uploaded = std::vector<std::uint8_t>;

    // Step 0 writes P2 (51, 32 bits) := 65536 and V1 (65, 16 bits) := 1000 and goes to step 1. Step 1: IN0 ->
    // timer := 500, step 2. Step 2: IN1 -> step 1.
    static Uploaded table() {
        return {0xC0, 0,    0x80, 0xB3, 0x00, 0x00, 0x01, 0x00,  // P2 := 65536
                0xC0, 0,    0x80, 0x41, 0xE8, 0x03, 0x00, 0x00,  // V1 := 1000
                0xC0, 0,    0,    1,    0x80, 0,    0,    0,     // NEXT := 1
                0xC1, 0x01, 0x01, 2,    0x80, 0,    0xF4, 0x01,  // IN0: timer := 500, NEXT := 2
                0xC2, 0x02, 0x02, 1,    0x80, 0,    0,    0,     // IN1: NEXT := 1
                0x3F, 0,    0,    0,    0,    0,    0,    0};
    }
    static SetPoint length() {
        SetPoint point;
        point.name = "Length";
        point.reg = 51;
        point.longword = true;
        point.at_power_up = true;
        point.unit_code = 2;
        point.unit = "counts";
        point.initial = 65536;
        point.lowest = -4096;
        point.highest = 200'000;
        point.places = {0};
        return point;
    }
    static SetPoint speed() {
        SetPoint point = length();
        point.name = "Speed";
        point.reg = 65;
        point.longword = false;
        point.unit_code = 4;
        point.unit = "rpm";
        point.steps_per_unit = 2.097152;
        point.initial = 1000;
        point.lowest = 100;
        point.highest = 3000;
        point.places = {1};
        return point;
    }
    static SetPoint dwell() {
        SetPoint point = length();
        point.name = "Dwell";
        point.kind = set_points::ValueKind::timer;
        point.reg = 0;
        point.longword = point.at_power_up = false;
        point.unit_code = registers::set_points::kMilliseconds;
        point.unit = "ms";
        point.initial = 500;
        point.lowest = 1;
        point.highest = 5000;
        point.places = {3};
        return point;
    }
    /// Step 1 takes them, and POWER_UP.
    static set_points::Record record() { return {{length(), speed(), dwell()}, 3}; }
    static Uploaded content(const set_points::Record& record) {
        Uploaded bytes = table();
        const auto behind = set_points::encode(record);
        bytes.insert(bytes.end(), behind.begin(), behind.end());
        return bytes;
    }
    static Uploaded content() { return content(record()); }

    struct Value {
        std::size_t index;
        std::int32_t value;
    };
    static Uploaded request(const set_points::Record& record, Request kind, const std::vector<Value>& values,
                            std::uint8_t recipe = 0, std::string_view name = {},
                            std::uint32_t own_number = 0) {
        Uploaded bytes(12);
        base::store_u32(bytes.data(), base::crc32(set_points::encode(record)));
        bytes[4] = static_cast<std::uint8_t>(kind);
        bytes[5] = recipe;
        unsigned mask = 0;
        for (const Value& value : values) mask |= 1U << value.index;
        base::store_u16(&bytes[6], static_cast<std::uint16_t>(mask));
        base::store_u32(&bytes[8], own_number);
        if (kind != Request::change) {
            bytes.insert(bytes.end(), name.begin(), name.end());
            bytes.resize(28);
        }
        for (const Value& value : values) {
            bytes.resize(bytes.size() + 4);
            base::store_u32(&bytes[bytes.size() - 4], static_cast<std::uint32_t>(value.value));
        }
        for (const Value& value : values) bytes.push_back(record.values[value.index].unit_code);
        bytes.resize((bytes.size() + 3) / 4 * 4);
        return bytes;
    }
};

}  // namespace nplc::gateway
