#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "sim/client_line.h"
#include "sim/mac_motor.h"
#include "sim/motor_alone.h"

namespace nplc::sim {

struct UnitOptions {
    registers::Model model = registers::Model::mac140;
    std::uint8_t address = 1;
};

struct RackOptions {
    std::vector<UnitOptions> units = {{}};  ///< the first has the FastMAC line; all share the MacTalk line
    std::uint32_t fastmac_baud = 19'200;
    std::uint32_t mactalk_baud = 19'200;
    bool old_register_codes = false;
};

/// Virtual motors on their lines, in virtual time, with real character times and sample rates. The same calls
/// give the same bytes.
class Rack {
  public:
    explicit Rack(const RackOptions& options);

    /// Plays the scenario on the first unit; both parameters must outlive the rack. advance() may then throw
    /// EndlessRules.
    void play(const Scenario& scenario, const Names& names) { stage_.emplace(motor(0), scenario, names); }

    /// Adds these actions from now on; after play(). Why nothing follows from them, if so.
    std::string also(Actions actions) { return stage_->also(std::move(actions), now_); }

    Time now() const { return now_; }
    /// A client's bytes wait for the line to be free; beyond 64 KiB they are lost.
    void send_fastmac(std::span<const std::uint8_t> bytes) { fastmac_.send(bytes); }
    void send_mactalk(std::span<const std::uint8_t> bytes) { mactalk_.send(bytes); }
    void advance(Time to);
    /// What has arrived at the client since the last call.
    std::vector<std::uint8_t> received_fastmac() { return fastmac_.received(); }
    std::vector<std::uint8_t> received_mactalk() { return mactalk_.received(); }

    std::size_t size() const { return units_.size(); }
    MacMotor& motor(std::size_t unit) { return *units_[unit].motor; }
    const MacMotor& motor(std::size_t unit) const { return *units_[unit].motor; }

  private:
    struct Unit {
        std::unique_ptr<MacMotor> motor;
        Time next_sample{0};
    };

    Time next_event(Time limit) const;
    void sample(Unit& unit);
    bool is_powered(const Unit& unit) const {
        return !stage_ || &unit != &units_.front() || stage_->powered();
    }
    void serve_fastmac();
    void serve_mactalk();

    std::vector<Unit> units_;
    std::optional<MotorAlone> stage_;
    ClientLine fastmac_;
    ClientLine mactalk_;
    Time now_{0};
};

}  // namespace nplc::sim
