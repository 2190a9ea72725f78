#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "mactalk_client/master.h"
#include "registers/gateway.h"

namespace nplc::nanoctl {

namespace gw = registers::gateway;

/// The gateway refused.
class Refused : public mactalk_client::EndedWith<mactalk_client::kRefused> {
  public:
    Refused(gw::Result result, std::uint8_t reg, std::uint16_t detail, const std::string& what)
        : EndedWith(what), result_(result), reg_(reg), detail_(detail) {}
    gw::Result result() const { return result_; }
    std::uint8_t reg() const { return reg_; }
    std::uint16_t detail() const { return detail_; }

  private:
    gw::Result result_;
    std::uint8_t reg_;
    std::uint16_t detail_;
};

/// The unit that answers is no gateway, or has a register map unknown to this program.
class WrongDevice : public mactalk_client::EndedWith<mactalk_client::kNoAnswer> {
    using EndedWith::EndedWith;
};

using mactalk_client::Interrupted;

/// Sixteen registers of one instant.
using Block = std::array<std::uint32_t, 16>;

/// A gateway's registers over MacTalk. A write without an accept was refused or lost; the gateway's RESULT
/// shows which, and lost ones are sent again. Everything throws mactalk_client::LineError, Refused and
/// WrongDevice; long operations Interrupted too.
class GatewayClient {
  public:
    static constexpr base::Milliseconds kStillWait{5'000};
    static constexpr base::Milliseconds kConfirmationWait{1'000};

    GatewayClient(mactalk_client::Master& master, std::uint8_t address)
        : master_(master), address_(address) {}

    /// To be called first.
    void identify();
    /// The same in two short messages, for a bad line and little time.
    void identify_briefly();

    std::uint32_t read(std::uint8_t reg) { return master_.read(address_, reg); }
    Block read_block(std::uint8_t reg);
    /// Requested once.
    std::optional<Block> try_read_block(std::uint8_t reg);

    void write(std::uint8_t reg, std::uint32_t value);
    /// Carried out exactly once. `more_patience`: additional timeout. For a `busy` gateway it waits up to 5
    /// s, and kConfirmationWait for a motor that has not confirmed its stop yet, such as before a start.
    void command(gw::Command command, base::Microseconds more_patience = {});
    /// Restarts the gateway and waits until it answers; address() may have changed then.
    void reset();
    /// Activates the stored table; waits up to kStillWait for the motor to stand still.
    void activate();

    /// Called between two requests of long operations; false ends them by Interrupted.
    void set_goes_on(std::function<bool()> goes_on) { goes_on_ = std::move(goes_on); }
    void look_for_interruption() const;

    mactalk_client::Master& master() { return master_; }
    std::uint8_t address() const { return address_; }

    /// RESULT: of the last write by any client.
    struct LastResult {
        gw::Result result;
        std::uint8_t reg;
        std::uint16_t detail;
    };
    LastResult last_result();

  private:
    std::optional<LastResult> try_last_result();
    [[noreturn]] void refuse(const LastResult& last, const std::string& what, const std::string& why);
    [[noreturn]] void lost(const std::string& what) const;
    void check_identity(std::uint32_t identity, std::uint32_t map) const;
    bool is_stop_confirmed_soon();
    void command_once(gw::Command command, base::Microseconds more_patience);

    mactalk_client::Master& master_;
    std::uint8_t address_;
    std::function<bool()> goes_on_;
};

}  // namespace nplc::nanoctl
