#include <fmt/format.h>

#include <utility>

#include "base/crc32.h"
#include "debuggee.h"
#include "nanoctl/gateway_client.h"
#include "nanoctl/status.h"
#include "nanoctl/stopping.h"
#include "nanoctl/texts.h"

namespace nplc::dap {
namespace {

using namespace nanoctl;
using host::ByteClient;

/// For an interactive user: a gateway on a busy machine gets three seconds before it counts as lost.
constexpr unsigned kAttempts = 20;

/// The line to a gateway, shared in turns with other programs.
std::unique_ptr<ByteClient> open_line(const Attach& options) {
    auto opened = ByteClient::open(options.endpoint, options.baud, ByteClient::Holding::in_turns);
    if (!opened.client) throw Problem(opened.error);
    return std::move(opened.client);
}

class Attached final : public Debuggee {
  public:
    Attached(const seqc::Compilation& program, const Attach& options)
        : symbols_(program.symbols),
          wire_(open_line(options)),
          master_(*wire_, {.baud = options.baud, .attempts = kAttempts}),
          gateway_(master_, options.address.value_or(gw::kDefaultAddress)) {
        asked([&] {
            gateway_.identify();
            hold_against(program);
            breakpoints_before_ = read_breakpoints();
            was_held_ = status().run_state == gw::RunState::held;
        });
    }

    const seqc::Symbols& symbols() const override { return symbols_; }

    Look look() override {
        const Status now = asked([&] { return status(); });
        return {time_text(now.uptime),
                now.step,
                now.timer,
                now.counter,
                now.inputs,
                now.outputs,
                now.has(gw::kInPosition),
                now.has(gw::kMotorError),
                now.has(gw::kLinkDelivers),
                std::string(name_of(now.run_state))};
    }

    void set_breakpoints(std::uint64_t steps) override {
        asked([&] {
            gateway_.write(gw::BREAK_LOW, static_cast<std::uint32_t>(steps));
            gateway_.write(gw::BREAK_HIGH, static_cast<std::uint32_t>(steps >> 32U));
        });
    }
    void stop_on_error(bool yes) override { stops_on_error_ = yes; }

    /// The gateway itself refuses unsafe commands, with the reason.
    void start(Order order) override {
        asked([&] {
            const Status now = status();
            if (order == Order::go_on && now.run_state == gw::RunState::stopped)
                throw Problem(
                    "the sequence is stopped: going on does not start a machine; 'run' in the debug console, "
                    "nanoctl run or its panel does");
            if (order == Order::go_on && now.run_state != gw::RunState::held) return;
            if (order != Order::go_on && now.run_state == gw::RunState::stopped)
                throw Problem("the sequence is stopped: nothing can be stepped before it is started");
            gateway_.command(order == Order::go_on       ? gw::Command::run
                             : order == Order::next_step ? gw::Command::step
                                                         : gw::Command::scan);
        });
        stepping_ = order != Order::go_on;
        error_seen_ = true;  // ignores an error that is already present
    }

    Stopped tick() override {
        return asked([&]() -> Stopped {
            rest();
            renew_forces();
            const Status now = status();
            const bool error = now.has(gw::kMotorError);
            const bool comes = error && !std::exchange(error_seen_, error);
            if (!error) error_seen_ = false;
            if (now.run_state == gw::RunState::held) {
                if (now.has(gw::kAtBreakpoint)) return {StopReason::breakpoint, "breakpoint"};
                const std::string remark(held_remark(now));
                return {stepping_ ? StopReason::step : StopReason::pause, remark.empty() ? "held" : remark};
            }
            if (now.run_state == gw::RunState::stopped)
                return {StopReason::exception,
                        fmt::format("the sequence was stopped: {}", name_of(now.safe_reason))};
            if (comes && stops_on_error_) {
                stop_machine(gateway_, gw::Command::hold);
                return {StopReason::exception, "ERROR: held, the motor stopped"};
            }
            return {};
        });
    }

    Stopped pause() override {
        return asked([&]() -> Stopped {
            const Status now = status();
            if (now.run_state == gw::RunState::stopped) return {StopReason::pause, "stopped"};
            if (now.run_state != gw::RunState::held) stop_machine(gateway_, gw::Command::hold);
            return {StopReason::pause, "held, the motor stopped"};
        });
    }

    bool lives_by_itself() const override { return true; }

    /// As `nanoctl run` and `nanoctl stop`; the stop is confirmed, or reported as possibly still running.
    void switch_sequence(bool run) override {
        asked([&] {
            if (run) {
                gateway_.command(gw::Command::run);
                stepping_ = false;
                error_seen_ = true;
            } else {
                stop_machine(gateway_, gw::Command::stop);
            }
        });
        remarks_.push_back(run ? "the sequence was started" : "the sequence was stopped");
    }

    std::vector<Variable> registers() override {
        const Status now = asked([&] { return status(); });
        return {{"state", std::string(name_of(now.run_state)), "", false},
                {"safe_reason", std::string(name_of(now.safe_reason)), "", false},
                {"link", std::string(name_of(now.link)), "", false},
                {"scans", std::to_string(now.scans), "", false},
                {"worst_scan", fmt::format("{} us", now.scan_worst), "", false}};
    }

    void set_input(unsigned index, bool level) override { force(gw::FORCE_IN, index, level); }
    void set_output(unsigned index, bool level) override { force(gw::FORCE_OUT, index, level); }

    std::string set_register(const std::string&, const std::string&) override {
        throw Problem(
            "a motor's registers are the sequence's while it runs: use macreg, with the sequence stopped");
    }

    std::vector<std::string> take_remarks() override { return std::exchange(remarks_, {}); }

    std::string leave() override {
        return asked([&]() -> std::string {
            if (forced_) {
                gateway_.write(gw::FORCE_IN, 0);
                gateway_.write(gw::FORCE_OUT, 0);
            }
            gateway_.write(gw::BREAK_LOW, static_cast<std::uint32_t>(breakpoints_before_));
            gateway_.write(gw::BREAK_HIGH, static_cast<std::uint32_t>(breakpoints_before_ >> 32U));
            const Status now = status();
            const bool held = now.run_state == gw::RunState::held && !was_held_;
            return fmt::format("left {} in step {}{}", name_of(now.run_state), symbols_.steps[now.step],
                               held ? "; nanoctl run lets it go on" : "");
        });
    }

  private:
    /// Converts the exceptions of the gateway client to Problem.
    template <class Ask>
    auto asked(const Ask& ask) -> decltype(ask()) {
        try {
            return ask();
        } catch (const mactalk_client::Ended& problem) {
            throw Problem(problem.what());
        }
    }

    Status status() { return Status(gateway_.read_block(gw::STATUS)); }

    std::uint64_t read_breakpoints() {
        return gateway_.read(gw::BREAK_LOW) | static_cast<std::uint64_t>(gateway_.read(gw::BREAK_HIGH))
                                                  << 32U;
    }

    /// Refuses the names of another program.
    void hold_against(const seqc::Compilation& program) {
        const Block about = gateway_.read_block(gw::IDENTITY);
        const std::uint32_t crc = base::crc32(program.table);
        if (about[gw::TABLE_BYTES - 1] == 0)
            throw Problem("the gateway has no table: upload the program first");
        if (about[gw::TABLE_CRC - 1] != crc)
            throw Problem(fmt::format(
                "the gateway runs another table than this program's (CRC {:08X}h, {:08X}h): upload "
                "it, or open the right program",
                about[gw::TABLE_CRC - 1], crc));
    }

    void rest() {
        constexpr base::Milliseconds kPause{20};
        if (wire_->rest(kPause) == ByteClient::Rest::not_shared) master_.pause(kPause);
    }

    void renew_forces() {
        if (forced_) gateway_.write(gw::FORCE_LEFT, 0);
    }

    void force(std::uint8_t reg, unsigned index, bool level) {
        constexpr unsigned kMaskAt = 8;
        asked([&] {
            std::uint32_t bits = gateway_.read(reg) | 1U << (kMaskAt + index);
            bits = level ? bits | 1U << index : bits & ~(1U << index);
            gateway_.write(reg, bits);
        });
        forced_ = true;
        const bool is_input = reg == gw::FORCE_IN;
        remarks_.push_back(fmt::format(
            "{} forced to {}", is_input ? seqc::wire_name(symbols_, index % 6) : symbols_.outputs[index % 4],
            level ? 1 : 0));
    }

    seqc::Symbols symbols_;
    std::unique_ptr<ByteClient> wire_;
    mactalk_client::Master master_;
    GatewayClient gateway_;
    std::vector<std::string> remarks_;
    std::uint64_t breakpoints_before_ = 0;
    bool was_held_ = false;
    bool stepping_ = false;
    bool stops_on_error_ = false;
    bool error_seen_ = false;
    bool forced_ = false;
};

}  // namespace

std::unique_ptr<Debuggee> attach(const Attach& options) {
    return std::make_unique<Attached>(compiled(options.program).compilation, options);
}

}  // namespace nplc::dap
