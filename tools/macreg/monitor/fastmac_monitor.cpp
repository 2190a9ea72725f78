// FastMAC and FlexMAC on a line (001 §5.2).
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "macreg/monitor.h"
#include "protocol/flexmac.h"
#include "registers/layout.h"

namespace nplc::macreg {

namespace fastmac = protocol::fastmac;
namespace flexmac = protocol::flexmac;
namespace reg = registers;

namespace {

struct NumberWords {
    fastmac::Number number;
    const char* words;
};

using enum fastmac::Number;
constexpr NumberWords kNumbers[] = {
    {nop, "no operation"},
    {reset_error, "reset errors"},
    {clear_p_soll, "P_SOLL := 0"},
    {clear_p_ist, "P_IST := 0"},
    {clear_p_fnc, "P_FNC := 0"},
    {clear_v_soll, "V_SOLL := 0"},
    {clear_t_soll, "T_SOLL := 0"},
    {clear_in_pos, "clear IN_POS"},
    {move_p7_by_p_fnc, "move by P7, from P_FNC"},
    {move_p8_by_p_fnc, "move by P8, from P_FNC"},
    {rapid_communication, "rapid communication"},
    {safe_communication, "safe communication"},
    {use_set_1, "use register set 1"},
    {use_set_2, "use register set 2"},
    {use_set_3, "use register set 3"},
    {use_set_4, "use register set 4"},
    {home, "start homing"},
    {move_p7_by_p_soll, "move by P7, from P_SOLL"},
    {move_p8_by_p_soll, "move by P8, from P_SOLL"},
    {transmit_slowly, "transmit slowly"},
    {positions_absolute, "positions are absolute"},
    {positions_relative_p_soll, "positions are relative to P_SOLL"},
    {positions_relative_p_fnc, "positions are relative to P_FNC"},
    {transmit_address, "transmit MYADDR"},
    {use_fastmac, "use FastMAC"},
    {use_flexmac, "use FlexMAC"},
};

const char* number_words(std::uint8_t number) {
    for (const NumberWords& one : kNumbers) {
        if (static_cast<std::uint8_t>(one.number) == number) return one.words;
    }
    return "unused, no operation";
}

std::string command_words(const fastmac::Command& command) {
    if (command.mode == fastmac::Mode::command) return number_words(command.number);
    constexpr const char* kModes[] = {"INIT_MODE", "V_MODE", "P_MODE"};
    constexpr char kGroups[] = {'P', 'V', 'A', 'T', 'L', 'Z'};
    return fmt::format("{}, use {}{}", kModes[static_cast<std::size_t>(command.mode)],
                       kGroups[static_cast<std::size_t>(command.group)], command.index);
}

std::string status_words(const fastmac::Status& status) {
    std::string words = fmt::format("status: toggle {}", status.toggle ? 1 : 0);
    const auto add = [&](bool is, const char* what) {
        if (is) words += fmt::format(", {}", what);
    };
    add(status.in_position, "in position");
    add(!status.in_position, "not in position");
    add(status.accelerating, "speeding up");
    add(status.decelerating, "slowing down");
    add(status.flexmac, "receives FlexMAC");
    add(status.framing_error, "saw a framing error");
    add(status.error, "ERROR");
    return words;
}

class FastMacMonitor final : public Monitor {
  public:
    explicit FastMacMonitor(const MonitorOptions& options)
        : options_(options), pause_(std::int64_t{30'000'000} / static_cast<std::int64_t>(options.baud)) {}

    void receive(Side side, std::uint8_t byte, base::Instant at) override {
        if (side == Side::motor) return from_motor(byte, at);
        if (!sent_.empty() && at - last_sent_ >= pause_) break_message();
        last_sent_ = at;
        if (flexmac_)
            from_master_flexmac(byte, at);
        else
            from_master(byte, at);
    }
    void framing_error(Side side, base::Instant at) override {
        if (side == Side::motor) {
            replies_.abandon();
            flush(received_, true);
        } else {
            break_message();
        }
        tell_framing_error(at);
    }
    void pass(base::Instant now) override {
        if (!sent_.empty() && now - last_sent_ >= pause_) break_message();
    }
    void finish() override {
        break_message();
        flush(received_, true);
    }
    std::optional<base::Instant> since() const override {
        if (sent_.empty() && received_.empty()) return std::nullopt;
        if (sent_.empty() || received_.empty()) return sent_.empty() ? received_.at : sent_.at;
        return std::min(sent_.at, received_.at);
    }

  private:
    struct Stray {
        base::Instant at{};
        std::vector<std::uint8_t> bytes{};
        bool empty() const { return bytes.empty(); }
    };

    void from_master(std::uint8_t byte, base::Instant at) {
        const bool toggle = (byte & fastmac::kToggle) != 0;
        const bool again = last_toggle_ && *last_toggle_ == toggle;
        const auto command = fastmac::decode_command(byte, options_.code);
        if (again && last_command_ == byte) return;  // a repeated command has no effect; masters send many
        tell({.at = at,
              .request = fmt::format("{:02X} {}, toggle {}", byte, command_words(command), toggle ? 1 : 0),
              .flaw = again ? "the toggle is as before: the motor takes no such command" : "",
              .sent = {byte}});
        last_toggle_ = toggle;
        last_command_ = byte;
        if (command.mode != fastmac::Mode::command || again) return;
        flexmac_ = command.number == static_cast<std::uint8_t>(fastmac::Number::use_flexmac);
    }

    void from_master_flexmac(std::uint8_t byte, base::Instant at) {
        if (sent_.empty()) sent_.at = at;
        sent_.bytes.push_back(byte);
        const auto message = requests_.receive(byte);
        if (!message) {
            if (!requests_.in_message()) flush(sent_, false);
            return;
        }
        const std::size_t size = flexmac::encode(*message).size;
        std::vector<std::uint8_t> own = split(sent_, size);
        MonitorEvent event{.at = at, .request = message_words(*message), .sent = std::move(own)};
        if (const auto number = register_of(*message)) event.reg = *number;
        if (!message->read) event.value = message->value;
        tell(std::move(event));
        last_toggle_.reset();
        if (flexmac::is_protocol_command(*message))
            flexmac_ = message->target != flexmac::kReadIndexUseFastMac;
    }

    void from_motor(std::uint8_t byte, base::Instant at) {
        if (received_.empty()) received_.at = at;
        received_.bytes.push_back(byte);
        const auto event = replies_.receive(byte);
        using Kind = flexmac::ReplyDecoder::Event::Kind;
        if (event.kind == Kind::reply) {
            MonitorEvent told{.at = received_.at};
            told.received = split(received_, flexmac::encode_reply(event.reply, event.reply.value).size);
            told.answer = message_words(event.reply) + " is " + value_words_of(event.reply);
            told.value = event.reply.value;
            if (const auto number = register_of(event.reply)) told.reg = *number;
            tell(std::move(told));
        } else if (event.kind == Kind::status) {
            received_.bytes.pop_back();
            flush(received_, true);
            if (last_status_ == event.status) return;
            last_status_ = event.status;
            tell({.at = at,
                  .answer = fmt::format("{:02X} {}", event.status,
                                        status_words(fastmac::decode_status(event.status))),
                  .received = {event.status}});
        }
    }

    /// The last `size` bytes; earlier ones belonged to no message.
    std::vector<std::uint8_t> split(Stray& stray, std::size_t size) {
        std::vector<std::uint8_t> own(stray.bytes.end() - static_cast<std::ptrdiff_t>(size),
                                      stray.bytes.end());
        stray.bytes.resize(stray.bytes.size() - size);
        flush(stray, &stray == &received_);
        return own;
    }

    void break_message() {
        requests_.abandon();
        flush(sent_, false);
    }

    void flush(Stray& stray, bool from_motor) {
        if (stray.empty()) return;
        const std::string what = fmt::format("no whole FlexMAC message{}: {}",
                                             from_motor ? " from the motor" : "", hex_words(stray.bytes));
        std::vector<std::uint8_t> bytes = std::exchange(stray.bytes, {});
        MonitorEvent event{.at = stray.at, .flaw = what};
        (from_motor ? event.received : event.sent) = std::move(bytes);
        tell(std::move(event));
    }

    std::optional<std::uint8_t> register_of(const flexmac::Message& message) const {
        const auto target = static_cast<std::uint8_t>(message.target);
        switch (message.level) {
            case flexmac::Level::reg:
                return target;
            case flexmac::Level::address:
                return flexmac::register_of_address(message.target);
            case flexmac::Level::index:
                break;
        }
        const std::uint8_t number =
            message.read ? flexmac::register_of_read_index(target) : flexmac::register_of_write_index(target);
        return number == 0 ? std::nullopt : std::optional(number);
    }

    std::string message_words(const flexmac::Message& message) const {
        if (flexmac::is_protocol_command(message))
            return message.target == flexmac::kReadIndexUseFastMac ? "FlexMAC: use FastMAC" : "FlexMAC: stay";
        const auto number = register_of(message);
        std::string name =
            number ? register_words(options_.model, *number) : fmt::format("address {:04X}", message.target);
        if (message.level == flexmac::Level::address && number)
            name += fmt::format(" at {:04X}", message.target);
        if (message.read) return "FlexMAC: read " + name;
        return fmt::format("FlexMAC: write {} := {}", name, value_words_of(message));
    }

    std::string value_words_of(const flexmac::Message& message) const {
        const std::size_t bytes = message.longword ? 4 : 2;
        const auto number = register_of(message);
        if (!number) return fmt::format("{:0{}X}", message.value, 2 * bytes);
        return bytes_words(options_.model, *number, message.value, bytes);
    }

    MonitorOptions options_;
    base::Microseconds pause_;
    bool flexmac_ = false;
    std::optional<bool> last_toggle_;
    std::optional<std::uint8_t> last_command_;
    std::optional<std::uint8_t> last_status_;
    base::Instant last_sent_{};
    flexmac::RequestDecoder requests_;
    flexmac::ReplyDecoder replies_;
    Stray sent_;
    Stray received_;
};

}  // namespace

std::unique_ptr<Monitor> make_fastmac_monitor(const MonitorOptions& options) {
    return std::make_unique<FastMacMonitor>(options);
}

}  // namespace nplc::macreg
