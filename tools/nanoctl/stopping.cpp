#include "nanoctl/stopping.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/bytes.h"
#include "nanoctl/texts.h"

namespace nplc::nanoctl {

using host::ByteClient;
using mactalk_client::LineError;

namespace {

/// Timeout for the motor's confirmation.
constexpr base::Milliseconds kBetweenLooks{20};

/// Beyond the deadline, on a line on which looks are lost.
constexpr base::Milliseconds kLastLook{800};
/// For the question whether it was a gateway.
constexpr base::Milliseconds kIdentity{1'000};

bool delivers(const Status& status) {
    return status.has(gw::kLinkDelivers) || status.has(gw::kVirtualMotor);
}

/// The command is repeated until the status confirms it: a message may be lost, and another client may get
/// the line's answers.
class Stopping {
  public:
    Stopping(GatewayClient& gateway, gw::Command command)
        : gateway_(gateway), command_(command), begun_(now()) {}

    Status run() {
        for (;;) {
            gateway_.master().set_deadline(deadline() + kLastLook);
            const auto status = is_asked_ ? look() : send_and_look();
            if (status && is_done(*status)) return *status;
            if (status && is_idle(*status)) {
                if (status->has(gw::kStopUnconfirmed))
                    unconfirmed("the sequence does not run, but the motor has not confirmed the last stop");
                throw Refused(gw::Result::not_running, gw::COMMAND, 0,
                              fmt::format("hold: {}", gw::describe(gw::Result::not_running)));
            }
            if (now() >= deadline() + (status ? base::Microseconds(0) : kLastLook)) end(status);
            gateway_.look_for_interruption();
        }
    }

  private:
    base::Instant now() const { return gateway_.master().wire().now(); }
    bool holds() const { return command_ == gw::Command::hold; }

    /// Another program releases a serial line within some 20 ms; otherwise the command is sent nevertheless.
    std::optional<Status> send_and_look() {
        static_cast<void>(gateway_.master().wire().rest(base::Microseconds{0}));
        gateway_.master().send_write(gateway_.address(), gw::COMMAND, static_cast<std::uint32_t>(command_),
                                     mactalk_client::Width::longword);
        return look();
    }

    std::optional<Status> look() {
        const auto block = gateway_.try_read_block(gw::STATUS);
        if (!block) return std::nullopt;
        const Status status(*block);
        last_ = status;
        if (is_ordered(status) && !ordered_at_) {
            ordered_at_ = now();
            ordered_uptime_ = status.uptime;
        }
        if (is_ordered(status) && !delivers(status) && !status.has(gw::kStopUnconfirmed) && !by_another_way_)
            by_another_way_ = is_confirmation_logged();
        // A repeat would be another stop, to be confirmed again.
        is_asked_ = is_ordered(status) && status.has(gw::kStopUnconfirmed);
        return status;
    }

    /// By its last status, however long ago that came. While the link is down a stop that is no longer
    /// unconfirmed may have been given up.
    bool waits_for_motor() const {
        if (!ordered_at_ || !last_ || !is_ordered(*last_)) return false;
        return last_->has(gw::kStopUnconfirmed) || (!delivers(*last_) && !by_another_way_);
    }
    /// Over the motor's own MacTalk port.
    bool is_confirmation_logged() const {
        try {
            const std::vector<LogEntry> log = read_log(gateway_);
            return std::any_of(log.begin(), log.end(), [this](const LogEntry& entry) {
                return entry.event == static_cast<std::uint8_t>(gw::Event::stop_confirmed) &&
                       entry.uptime >= ordered_uptime_;
            });
        } catch (const LineError&) {
            return false;
        }
    }
    base::Instant deadline() const {
        const base::Instant end = begun_ + kLongestStop;
        return waits_for_motor() ? std::min(end, *ordered_at_ + GatewayClient::kConfirmationWait) : end;
    }

    bool is_ordered(const Status& status) const {
        return status.run_state == (holds() ? gw::RunState::held : gw::RunState::stopped);
    }

    bool is_done(const Status& status) {
        was_told_ = was_told_ || !is_ordered(status) || status.has(gw::kStopUnconfirmed);
        if (!is_ordered(status)) {
            if (status.run_state == gw::RunState::holding) gateway_.master().pause(kBetweenLooks);
            return false;
        }
        if (!waits_for_motor()) {
            if (was_told_) return true;
            was_told_ = is_asked_ = gateway_.master().try_write(gateway_.address(), gw::COMMAND,
                                                                static_cast<std::uint32_t>(command_),
                                                                mactalk_client::Width::longword);
            return false;
        }
        gateway_.master().pause(kBetweenLooks);
        return false;
    }

    [[noreturn]] void unconfirmed(std::string_view why) const {
        throw NotConfirmed(fmt::format("{}: {}: {}", name_of(command_), why, kMayStillRun));
    }

    bool is_idle(const Status& status) const { return holds() && status.run_state == gw::RunState::stopped; }

    [[noreturn]] void end(const std::optional<Status>& status) const {
        if (!waits_for_motor()) fail(status);
        unconfirmed(fmt::format("the sequence is {}, but {}", name_of(last_->run_state),
                                delivers(*last_)
                                    ? "the motor has not confirmed the stop"
                                    : "the link to the motor is down and the motor could not be told"));
    }

    [[noreturn]] void fail(const std::optional<Status>& status) const {
        ByteClient& wire = gateway_.master().wire();
        const std::string holder = wire.holder();
        const std::string why =
            status ? fmt::format("the sequence is {}", name_of(status->run_state))
                   : fmt::format("no answer from address {} in 10 s{}", gateway_.address(),
                                 holder.empty() ? "" : "; " + holder + " has the port too, end that one");
        throw NotConfirmed(fmt::format("{}: {}: {}: {}", wire.name(), name_of(command_), why, kMayStillRun));
    }

    GatewayClient& gateway_;
    gw::Command command_;
    base::Instant begun_;
    bool is_asked_ = false;  ///< the gateway has received it, and waits for the motor
    /// The gateway has received a stop since this one was sent. If it was stopped before, only an accept
    /// shows that.
    bool was_told_ = false;
    std::optional<Status> last_;
    bool by_another_way_ = false;              ///< confirmed while the link was down
    std::uint32_t ordered_uptime_ = 0;         ///< at ordered_at_
    std::optional<base::Instant> ordered_at_;  ///< first confirmation that the gateway has received it
};

}  // namespace

bool StopConfirmation::is_overdue(const Status& status) {
    if (!status.has(gw::kStopUnconfirmed)) {
        since_.reset();
        return false;
    }
    if (!since_) since_ = status.uptime;
    constexpr base::Milliseconds kWait = GatewayClient::kConfirmationWait;
    return !delivers(status) || base::Milliseconds{status.uptime - *since_} >= kWait;
}

/// A stop of the gateway's start is since 0.
std::uint32_t stop_unconfirmed_ms(GatewayClient& gateway, const Status& status) {
    if (!status.has(gw::kStopUnconfirmed)) return 0;
    const std::uint32_t since = gateway.read(gw::STOP_SINCE);
    const Status now(gateway.read_block(gw::STATUS));
    return now.has(gw::kStopUnconfirmed) ? now.uptime - since : 0;
}

Status status_after_stop(GatewayClient& gateway) {
    StopConfirmation confirmation;
    for (;;) {
        const Status status(gateway.read_block(gw::STATUS));
        if (!status.has(gw::kStopUnconfirmed) || confirmation.is_overdue(status)) return status;
        gateway.look_for_interruption();
        gateway.master().pause(kBetweenLooks);
    }
}

std::string doubt_of_stop(GatewayClient& gateway) {
    const Status status = status_after_stop(gateway);
    if (!status.has(gw::kStopUnconfirmed)) return {};
    return fmt::format("the sequence is {}, but the motor has not confirmed the stop: {}",
                       name_of(status.run_state), kMayStillRun);
}

Status stop_machine(GatewayClient& gateway, gw::Command command) {
    struct Deadline {
        mactalk_client::Master& master;
        ~Deadline() { master.set_deadline(base::kNever); }
    } const deadline{gateway.master()};
    const auto not_confirmed = [&](const std::exception& error) {
        return fmt::format("{}: {}: {}", name_of(command), error.what(), kMayStillRun);
    };
    try {
        const Status status = Stopping(gateway, command).run();
        deadline.master.set_deadline(gateway.master().wire().now() + kIdentity);
        gateway.identify_briefly();
        return status;
    } catch (const LineError& error) {
        throw NotConfirmed(not_confirmed(error));
    } catch (const WrongDevice& error) {
        throw NotConfirmed(not_confirmed(error));
    } catch (const Interrupted& error) {
        throw Interrupted(not_confirmed(error));
    }
}

}  // namespace nplc::nanoctl
