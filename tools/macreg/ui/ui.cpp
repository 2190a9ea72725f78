#include "macreg/ui.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "macreg/change.h"
#include "macreg/monitor.h"
#include "macreg/recorder.h"
#include "macreg/service.h"
#include "macreg/values.h"
#include "registers/gateway.h"
#include "terminal.h"

namespace nplc::macreg {

using mactalk_client::LineError;
using registers::Register;

namespace {

constexpr int kKeyWait = 20;       // milliseconds between two reads
constexpr int kTroubleWait = 250;  // and while the motor does not answer
constexpr base::Microseconds kRedraw{100'000};

struct Quit {};
struct GivenUp {};

/// The gateway's own address, unless a motor uses it.
std::uint8_t gateway_beside(std::uint8_t motor) {
    constexpr std::uint8_t kGateway = registers::gateway::kDefaultAddress;
    return motor == kGateway ? std::uint8_t{0} : kGateway;
}

/// A line that a monitor listens to.
class TappedWire final : public host::ByteClient {
  public:
    TappedWire(std::unique_ptr<host::ByteClient> wire, Monitor& monitor)
        : wire_(std::move(wire)), monitor_(monitor) {}

    const std::string& name() const override { return wire_->name(); }
    bool write(std::span<const std::uint8_t> bytes) override {
        for (const std::uint8_t byte : bytes) monitor_.receive(Side::master, byte, wire_->now());
        return wire_->write(bytes);
    }
    std::optional<std::size_t> read(std::span<std::uint8_t> out, base::Microseconds wait) override {
        const auto count = wire_->read(out, wait);
        for (std::size_t i = 0; i < count.value_or(0); ++i)
            monitor_.receive(Side::motor, out[i], wire_->now());
        return count;
    }
    base::Instant now() const override { return wire_->now(); }

  private:
    std::unique_ptr<host::ByteClient> wire_;
    Monitor& monitor_;
};

class App {
  public:
    App(std::unique_ptr<host::ByteClient> wire, const UiOptions& options)
        : options_(options),
          model_(options.model),
          monitor_(
              make_mactalk_monitor({.model = options.model, .gateway = gateway_beside(options.address)})) {
        connect(std::move(wire));
    }

    void run() {
        try {
            while (Terminal::goes_on()) {
                show();
                const KeyPress key = Terminal::key(model_.trouble().empty() ? kKeyWait : kTroubleWait);
                carry_out(model_.press(key));
                if (key.key == Key::none) refresh();
            }
        } catch (const Quit&) {
        }
    }

  private:
    void connect(std::unique_ptr<host::ByteClient> wire) {
        motor_.reset();
        master_.reset();
        wire_ = std::make_unique<TappedWire>(std::move(wire), *monitor_);
        start_ = wire_->now();
        master_ = std::make_unique<mactalk_client::Master>(*wire_, options_.line);
        motor_ = std::make_unique<Motor>(*master_, options_.address, options_.model);
    }

    void show() {
        for (const MonitorEvent& event : monitor_->take())
            model_.set_exchange(hex_words(event.sent), hex_words(event.received), line_of(event, start_));
        draw(model_, terminal_, options_.title);
    }

    /// Executes a request to the motor; an error is shown.
    template <class What>
    void try_to(What what) {
        if (motor_ == nullptr) return model_.tell("there is no connection", true);
        try {
            what();
            model_.set_trouble("");
        } catch (const LineError& error) {
            const bool gone = error.kind() == LineError::Kind::port_gone;
            model_.set_trouble(gone ? "PORT GONE, looking for it" : "NO ANSWER, asking again");
            if (!gone) return;
            motor_.reset();
            master_.reset();
            wire_.reset();
        } catch (const CannotRecord& error) {
            model_.tell(error.what(), true);
        } catch (const Unconfirmed& error) {
            model_.tell(error.what(), true);
        }
    }

    void carry_out(const Request& request) {
        switch (request.kind) {
            case Request::Kind::none:
                return;
            case Request::Kind::quit:
                throw Quit{};
            case Request::Kind::read:
                return try_to([&] { read_one(*request.reg); });
            case Request::Kind::read_all:
                return try_to([&] { model_.store(motor_->read_block(model_.list().rows())); });
            case Request::Kind::write:
                return try_to([&] { write(*request.reg, request.raw); });
            case Request::Kind::record:
                return try_to([&] { record(request.text); });
            case Request::Kind::save:
            case Request::Kind::reset:
            case Request::Kind::enter_safe:
            case Request::Kind::exit_safe:
                return try_to([&] { serve(request.kind); });
        }
    }

    void read_one(const Register& reg) {
        Snapshot one(motor_->now());
        one.set(reg.number, motor_->read(reg), motor_->now());
        model_.store(one);
        model_.tell(fmt::format("{} = {}", reg.name, value_text(reg, options_.model, one.at(reg.number))));
    }

    void write(const Register& reg, std::int64_t raw) {
        const ChangeResult outcome = [&] {
            try {
                return change(*motor_, reg, raw);
            } catch (const LineError& error) {
                model_.tell(is_stop(options_.model, reg, raw)
                                ? std::string(error.what())
                                : fmt::format("{} may have been written or not; read it (r) once the motor "
                                              "answers",
                                              reg.name),
                            true);
                throw;
            }
        }();
        Snapshot one(motor_->now());
        one.set(reg.number, outcome.after, motor_->now());
        model_.store(one);
        const std::string now = value_text(reg, options_.model, outcome.after);
        if (!outcome.taken)
            return model_.tell(fmt::format("not taken, {} is {}: {}", reg.name, now, outcome.why), true);
        model_.tell(fmt::format("written; {} now reads {}{}{}", reg.name, now,
                                outcome.remark.empty() ? "" : "; ", outcome.remark));
    }

    void serve(Request::Kind kind) {
        model_.tell("under way ...");
        show();
        Service service(*motor_, [] { return Terminal::goes_on(); });
        try {
            std::vector<std::string> changed;
            if (kind == Request::Kind::save) changed = service.save();
            if (kind == Request::Kind::reset) service.reset();
            if (kind == Request::Kind::enter_safe) service.enter_safe();
            if (kind == Request::Kind::exit_safe) service.exit_safe();
            model_.store(motor_->read_block(model_.list().rows()));
            const std::string mode = mode_text(options_.model, *model_.list().raw_of(registers::MODE_REG));
            if (changed.empty()) return model_.tell(fmt::format("done; the motor is in {}", mode));
            model_.tell(fmt::format("the motor is in {}, but after the reset these have other values: {}",
                                    mode, fmt::join(changed, ", ")),
                        true);
        } catch (const NotDone& error) {
            model_.tell(fmt::format("{}; {}", error.what(), service.left_behind()), true);
        } catch (const mactalk_client::Interrupted&) {
            model_.tell(service.left_behind(), true);
        } catch (const LineError&) {
            model_.tell(service.left_behind(), true);
            throw;
        }
    }

    void record(const std::string& text) {
        RecordOptions how;
        std::string word;
        for (const char c : text + " ") {
            if (c != ' ' && c != ',') {
                word += c;
                continue;
            }
            if (word == "fast" || word == "slow") {
                how.fast = word == "fast";
            } else if (!word.empty()) {
                const NamedRegister named = find_register(options_.model, word);
                if (named.reg == nullptr) return model_.tell(named.error, true);
                how.registers.push_back(named.reg);
            }
            word.clear();
        }
        how.model_name = options_.model_name;
        how.progress = [this](const RecordProgress& progress) { look_on(progress); };
        Recording broken;
        try {
            model_.set_recording(record_buffer(*motor_, how, &broken));
            model_.set_progress("");
        } catch (const GivenUp&) {
            model_.set_progress("");
            model_.tell("aborted; the sample registers are as they were");
        } catch (const LineError&) {
            model_.set_progress("");
            model_.tell(
                fmt::format("the line broke off; {} of {} samples had been read", broken.size(), how.samples),
                true);
            if (broken.size() > 1) model_.set_recording(std::move(broken));
            throw;
        } catch (...) {
            model_.set_progress("");
            throw;
        }
    }

    /// Shows the progress; a key or a signal cancels it.
    void look_on(const RecordProgress& progress) {
        const base::Instant now = wire_->now();
        if (now - drawn_ < kRedraw) return;
        drawn_ = now;
        using Phase = RecordProgress::Phase;
        model_.set_progress(progress.phase == Phase::waiting
                                ? std::string("preparing")
                                : fmt::format("{} {} of {}; Esc gives it up",
                                              progress.phase == Phase::recording ? "recorded" : "read",
                                              progress.done, progress.of));
        show();
        if (!Terminal::goes_on() || Terminal::key(0).key == Key::escape) throw GivenUp{};
    }

    /// Read while no key is pressed: state and, if enabled, the registers on the screen, in turn.
    void refresh() {
        if (motor_ == nullptr) return reconnect();
        if (model_.prompt().kind != Prompt::Kind::none) return;
        try_to([&] {
            const Register* state[] = {motor_->find(registers::MODE_REG), motor_->find(registers::ERR_STAT),
                                       motor_->find(registers::STARTMODE)};
            if (!model_.is_live() || !model_.trouble().empty() || ++turn_ % 2 == 0) {
                model_.store(motor_->read_block(state));
            } else {
                const auto visible = model_.list().visible();
                model_.store(motor_->read_block(visible));
            }
        });
    }

    void reconnect() {
        if (!options_.reopen) return;
        auto opened = options_.reopen();
        if (opened.client == nullptr) return;
        connect(std::move(opened.client));
        model_.set_trouble("NO ANSWER, asking again");
    }

    const UiOptions& options_;
    Terminal terminal_;
    UiModel model_;
    std::unique_ptr<Monitor> monitor_;
    std::unique_ptr<TappedWire> wire_;
    std::unique_ptr<mactalk_client::Master> master_;
    std::unique_ptr<Motor> motor_;
    base::Instant start_{};
    base::Instant drawn_{};
    unsigned turn_ = 0;
};

}  // namespace

void run_ui(std::unique_ptr<host::ByteClient> wire, const UiOptions& options) {
    App(std::move(wire), options).run();
}

}  // namespace nplc::macreg
