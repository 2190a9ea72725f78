#pragma once

#include <deque>
#include <memory>

#include "bench_board.h"
#include "gateway/user_port.h"
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
        port_.received.push_back({byte, framing_error});
    }
    std::optional<std::uint8_t> transmit(base::Instant /*now*/) override {
        if (port_.waiting.empty()) return std::nullopt;
        const std::uint8_t byte = port_.waiting.front();
        port_.waiting.pop_front();
        return byte;
    }
    void poll(base::Instant now) override {
        board.now = now;
        parts_->gateway.poll(now);
        parts_->user.poll(now);
        if (parts_->own.reset_asked()) start();
    }

    /// Power off and on.
    void start() {
        port_ = {};
        parts_ = std::make_unique<Parts>(*this);
    }

    gateway::BenchBoard board;
    sim::SimStorage storage;

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

    struct Parts {
        explicit Parts(GatewayUnit& unit)
            : settings(unit.storage, {.begin = 18 * 1024, .slot_bytes = 1024}),
              gateway(unit.board.ports(), stored(settings), gateway::StartCause::power_up),
              tables(gateway, unit.board, unit.storage, {.begin = 0, .slot_bytes = 9 * 1024}, memory),
              own(gateway, tables, settings),
              user(unit.port_, nullptr, gateway, unit.board, own, settings) {
            settings.attach(gateway);
            static_cast<void>(tables.mount());
            tables.start(unit.board.now);
        }
        static gateway::Settings stored(gateway::SettingsKeeper& settings) {
            settings.start({});
            return gateway::settings_of(settings.values());
        }

        std::array<std::uint8_t, 8200> memory{};
        gateway::SettingsKeeper settings;
        gateway::Gateway gateway;
        gateway::TableKeeper tables;
        gateway::OwnRegisters own;
        gateway::UserPort user;
    };

    Port port_;
    std::unique_ptr<Parts> parts_;
};

}  // namespace nplc::nanoctl
