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

/// The gateway said no.
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

/// What answers is no gateway, or one whose register map this program does not know.
class WrongDevice : public mactalk_client::EndedWith<mactalk_client::kNoAnswer> {
    using EndedWith::EndedWith;
};

using mactalk_client::Interrupted;

/// Sixteen registers taken at one instant.
using Block = std::array<std::uint32_t, 16>;

/// A gateway's registers over MacTalk. A write that gets no accept was refused or lost; the gateway's RESULT
/// tells which, and lost ones are sent again. Everything throws mactalk_client::LineError, Refused and
/// WrongDevice, what takes long Interrupted too.
class GatewayClient {
  public:
    static constexpr base::Milliseconds kStillWait{5'000};
    static constexpr base::Milliseconds kConfirmationWait{1'000};

    GatewayClient(mactalk_client::Master& master, std::uint8_t address)
        : master_(master), address_(address) {}

    /// To be called first.
    void identify();

    std::uint32_t read(std::uint8_t reg) { return master_.read(address_, reg); }
    Block read_block(std::uint8_t reg);
    /// Asked once.
    std::optional<Block> try_read_block(std::uint8_t reg);

    void write(std::uint8_t reg, std::uint32_t value);
    /// Carried out exactly once. `more_patience`: how long it may take. For a `busy` gateway it waits up to 5
    /// s, and kConfirmationWait for a motor that has not confirmed its stop yet, that of a start, say.
    void command(gw::Command command, base::Microseconds more_patience = {});
    /// Restarts the gateway and waits until it answers; address() may be another one then.
    void reset();
    /// The stored table becomes the active one; waits up to kStillWait for the motor to stand still.
    void activate();

    /// Asked between two looks or pieces of what takes long; false ends it by Interrupted.
    void set_goes_on(std::function<bool()> goes_on) { goes_on_ = std::move(goes_on); }
    void look_for_interruption() const;

    mactalk_client::Master& master() { return master_; }
    std::uint8_t address() const { return address_; }

    /// RESULT: of the last write, whoever's.
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
    bool is_stop_confirmed_soon();
    void command_once(gw::Command command, base::Microseconds more_patience);

    mactalk_client::Master& master_;
    std::uint8_t address_;
    std::function<bool()> goes_on_;
};

}  // namespace nplc::nanoctl
