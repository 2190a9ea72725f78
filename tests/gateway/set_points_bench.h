#pragma once

#include "port_bench.h"
#include "set_point_case.h"

namespace nplc::gateway {

/// Those of SetPointCase on a bench.
struct SetPointBench : PortBench, SetPointCase {
    explicit SetPointBench() { board.in_pos = true; }

    bool ask_for(const Uploaded& bytes) {
        put(mactalk::encode_long_write(reg::kDefaultAddress, reg::SET_POINT_WRITE, bytes).view());
        return heard() == accept();
    }
    bool change(const std::vector<Value>& values) {
        return ask_for(request(record(), Request::change, values));
    }
    bool save(std::string_view name) { return ask_for(request(record(), Request::save_recipe, {}, 0, name)); }
    bool recipe(Request kind, std::uint8_t number, std::string_view name = {}) {
        return ask_for(request(record(), kind, {}, number, name));
    }

    using Three = std::array<std::int32_t, 3>;
    Three values(std::uint8_t first) {
        Three three{};
        for (std::uint8_t i = 0; i < 3; ++i)
            three[i] =
                static_cast<std::int32_t>(read(static_cast<std::uint8_t>(first + i)).value_or(0xDEADBEEF));
        return three;
    }
    Three in_force() { return values(reg::SET_POINT); }
    Three wanted() { return values(reg::SET_POINT_WANTED); }
    bool change_waits() { return (read(reg::SET_POINT_STATE).value_or(0) & reg::kChangeWaits) != 0; }
    std::uint32_t active_recipe() { return read(reg::SET_POINT_STATE).value_or(0) >> 8 & 0xFF; }
    std::uint16_t last_detail(reg::Event event) const {
        std::uint16_t detail = 0;
        const EventLog& log = gateway->log();
        for (std::uint32_t i = 0; i < log.count(); ++i) {
            if (log.slot(i % EventLog::kSlots).event == static_cast<std::uint8_t>(event))
                detail = log.slot(i % EventLog::kSlots).detail;
        }
        return detail;
    }
    std::size_t logged(reg::Event event) const {
        std::size_t count = 0;
        for (std::size_t i = 0; i < EventLog::kSlots; ++i)
            count += gateway->log().slot(i).event == static_cast<std::uint8_t>(event) ? 1U : 0U;
        return count;
    }
};

inline const SetPointBench::Three kDefaults{65536, 1000, 500};

}  // namespace nplc::gateway
