#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ports/can.h"

namespace nplc::motor {

/// "601 23 13 20 00 00 00 27 10": identifier and bytes.
inline ports::CanFrame can_frame(const std::string& text) {
    ports::CanFrame frame;
    frame.id = static_cast<std::uint32_t>(std::stoul(text, nullptr, 16));
    for (std::size_t at = 4; at < text.size(); at += 3)
        frame.data[frame.length++] = static_cast<std::uint8_t>(std::stoul(text.substr(at, 2), nullptr, 16));
    return frame;
}

inline std::string text_of(const ports::CanFrame& frame) {
    constexpr char kHex[] = "0123456789ABCDEF";
    std::string text{kHex[frame.id >> 8 & 15], kHex[frame.id >> 4 & 15], kHex[frame.id & 15]};
    for (std::size_t i = 0; i < frame.length; ++i)
        text += {' ', kHex[frame.data[i] >> 4], kHex[frame.data[i] & 15]};
    return text;
}

/// A bus whose other nodes are the test: it records what is sent, and determines what is received.
class ScriptedCan final : public ports::CanPort {
  public:
    bool write(const ports::CanFrame& frame) override {
        if (!takes || state_now == ports::CanState::bus_off || state_now == ports::CanState::down)
            return false;
        sent.push_back(text_of(frame));
        return true;
    }
    bool read(ports::CanFrame& frame) override {
        if (received.empty()) return false;
        frame = received.front();
        received.pop_front();
        return true;
    }
    bool filter(std::span<const ports::CanFilter> wanted) override {
        filters.assign(wanted.begin(), wanted.end());
        return true;
    }
    ports::CanState state() override { return state_now; }
    ports::CanFaults faults() override { return {}; }
    bool restart() override {
        ++restarts;
        return true;
    }

    std::vector<std::string> take() { return std::exchange(sent, {}); }

    std::vector<std::string> sent;
    std::deque<ports::CanFrame> received;
    std::vector<ports::CanFilter> filters;
    ports::CanState state_now = ports::CanState::active;
    bool takes = true;
    unsigned restarts = 0;
};

}  // namespace nplc::motor
