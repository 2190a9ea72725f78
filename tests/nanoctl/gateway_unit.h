#pragma once

#include <deque>
#include <optional>

#include "bench_board.h"
#include "gateway/controller.h"
#include "sim/sim_storage.h"
#include "sim_wire.h"

namespace nplc::nanoctl {

/// The firmware's whole user side on a board whose pins and motor are the test's variables, behind a SimWire.
class GatewayUnit final : public mactalk_client::Unit {
  public:
    explicit GatewayUnit(unsigned busy_polls = 1)
        : storage({.size = 32'768, .erase_block = 1024, .program_page = 256, .program_unit = 4}, busy_polls) {
        board.motor_registers[12] = 0;  // V_IST: it stands still
        start();
    }

    void receive(std::uint8_t byte, bool framing_error, base::Instant /*now*/) override {
        if (ignores == 0) return port_.received.push_back({byte, framing_error});
        --ignores;
    }
    std::optional<std::uint8_t> transmit(base::Instant /*now*/) override {
        if (port_.waiting.empty()) return std::nullopt;
        const std::uint8_t byte = port_.waiting.front();
        port_.waiting.pop_front();
        if (loses == 0) return byte;
        --loses;
        return std::nullopt;
    }
    void poll(base::Instant now) override {
        board.now = now;
        controller_->poll(now);
        if (controller_->reset_asked()) start();
    }

    /// Power off and on.
    void start() {
        port_ = {};
        settings_.emplace(storage, store::Area{.begin = 18 * 1024, .slot_bytes = 1024});
        settings_->start({});
        static constexpr store::Area kSetPoints{.begin = 20 * 1024, .slot_bytes = 2 * 1024};
        controller_.emplace(gateway::Controller::Ports{.inputs = board,
                                                       .outputs = board,
                                                       .watchdog = board,
                                                       .motor = board,
                                                       .storage = storage,
                                                       .user_line = &port_,
                                                       .set_points = &kSetPoints},
                            store::Area{.begin = 0, .slot_bytes = 9 * 1024}, memory_, *settings_,
                            gateway::StartCause::power_up);
        controller_->tables().start(board.now);
    }

    gateway::BenchBoard board;
    sim::SimStorage storage;
    std::size_t loses = 0;    ///< bytes that it sends next
    std::size_t ignores = 0;  ///< bytes that it receives next

  private:
    struct Port final : ports::SerialPort {
        std::size_t write(std::span<const std::uint8_t> bytes) override {
            waiting.insert(waiting.end(), bytes.begin(), bytes.end());
            return bytes.size();
        }
        std::size_t read(std::span<ports::ReceivedByte> out) override {
            const std::size_t count = std::min(out.size(), received.size());
            std::copy_n(received.begin(), count, out.begin());
            received.erase(received.begin(), received.begin() + static_cast<std::ptrdiff_t>(count));
            return count;
        }
        bool transmitter_idle() override { return waiting.empty(); }

        std::deque<std::uint8_t> waiting;
        std::deque<ports::ReceivedByte> received;
    };

    std::array<std::uint8_t, gateway::kTableMemory> memory_{};
    Port port_;
    std::optional<gateway::SettingsManager> settings_;
    std::optional<gateway::Controller> controller_;
};

}  // namespace nplc::nanoctl
