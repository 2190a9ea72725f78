#include "nanoctl/stopping.h"

#include <fmt/format.h>

#include "base/bytes.h"
#include "nanoctl/texts.h"

namespace nplc::nanoctl {

using host::ByteClient;
using mactalk_client::LineError;

namespace {

/// Timeout for the motor's confirmation.
constexpr base::Milliseconds kBetweenLooks{20};

/// The command is repeated until the status confirms it: a message may be lost, and another client may get
/// the line's answers.
class Stopping {
  public:
    Stopping(GatewayClient& gateway, gw::Command command)
        : gateway_(gateway), command_(command), begun_(now()) {}

    Status run() {
        for (;;) {
            const auto status = is_asked_ ? look() : send_and_look();
            if (status && is_done(*status)) return *status;
            if (status && is_idle(*status)) {
                if (status->has(gw::kStopUnconfirmed))
                    unconfirmed("the sequence does not run, but the motor has not confirmed the last stop");
                throw Refused(gw::Result::not_running, gw::COMMAND, 0,
                              fmt::format("hold: {}", gw::describe(gw::Result::not_running)));
            }
            if (now() - begun_ >= kLongestStop) fail(status);
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
        // A repeat would be another stop, to be confirmed again.
        is_asked_ = is_ordered(status) && status.has(gw::kStopUnconfirmed);
        return status;
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
        if (!ordered_at_) ordered_at_ = now();
        const bool delivers = status.has(gw::kLinkDelivers) || status.has(gw::kVirtualMotor);
        if (delivers && !status.has(gw::kStopUnconfirmed)) {
            if (was_told_) return true;
            was_told_ = is_asked_ = gateway_.master().try_write(gateway_.address(), gw::COMMAND,
                                                                static_cast<std::uint32_t>(command_),
                                                                mactalk_client::Width::longword);
            return false;
        }
        if (now() - *ordered_at_ >= GatewayClient::kConfirmationWait)
            unconfirmed(fmt::format("the sequence is {}, but {}", name_of(status.run_state),
                                    delivers
                                        ? "the motor has not confirmed the stop"
                                        : "the link to the motor is down and the motor could not be told"));
        gateway_.master().pause(kBetweenLooks);
        return false;
    }

    [[noreturn]] void unconfirmed(std::string_view why) const {
        throw NotConfirmed(fmt::format("{}: {}: {}", name_of(command_), why, kMayStillRun));
    }

    bool is_idle(const Status& status) const { return holds() && status.run_state == gw::RunState::stopped; }

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
    /// A stop was received since it was asked. Of a gateway that had stopped before only an accept shows it.
    bool was_told_ = false;
    std::optional<base::Instant> ordered_at_;  ///< first confirmation that the gateway has received it
};

}  // namespace

Status stop_machine(GatewayClient& gateway, gw::Command command) {
    const auto not_confirmed = [&](const std::exception& error) {
        return fmt::format("{}: {}: {}", name_of(command), error.what(), kMayStillRun);
    };
    try {
        const Status status = Stopping(gateway, command).run();
        gateway.identify();
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
