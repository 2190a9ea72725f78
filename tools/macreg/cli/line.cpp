#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cstdio>
#include <functional>
#include <memory>

#include "cli/session.h"
#include "host/endpoint.h"
#include "macreg/monitor.h"
#include "macreg/motor.h"
#include "macreg/service.h"
#include "macreg/values.h"
#include "registers/gateway.h"

namespace nplc::macreg::cli {

using registers::Model;

namespace {

struct FindArguments {
    bool every_address = false;
    Search::Speeds speeds;
};

/// 001 §3.2.1: 4Eh is 4.14; 004 has six bits for the second part.
std::string version_text(const FoundUnit& unit) {
    const unsigned bits = unit.model == Model::mac800 ? 6 : 4;
    const std::int64_t major = unit.version >> bits & (unit.model == Model::mac800 ? 0x7F : 0xFFF);
    return fmt::format("firmware {}.{}", major, unit.version & ((1 << bits) - 1));
}

void tell_unit(Search& search, const FoundUnit& unit, std::uint32_t baud, bool served) {
    const std::string where =
        fmt::format("address {:>3}{}", unit.address, served ? "" : fmt::format(", {} baud", baud));
    if (unit.gateway)
        return search.add(where + ": a NanoPLC gateway; the motor behind it answers here too",
                          {{"address", unit.address}, {"baud", baud}, {"kind", "gateway"}});
    const std::string mode = mode_text(unit.model, unit.mode);
    search.add(fmt::format("{}: {}, serial number {}, {}, {}", where, family_words(unit.model),
                           unit.serial_number, version_text(unit), mode),
               {{"address", unit.address},
                {"baud", baud},
                {"kind", "motor"},
                {"family", unit.model == Model::mac800 ? "MAC800" : "MAC50-141"},
                {"serial_number", unit.serial_number},
                {"version", unit.version},
                {"mode", unit.mode},
                {"mode_name", mode}});
}

void find(Common& common, const FindArguments& options) {
    const bool served = host::Endpoint(common.port).is_served();
    Search search(common, {.only_this = served || options.speeds.only_this, .every = options.speeds.every});
    search.run(common.baud, command_line::kSpeeds, [&](std::uint32_t baud) {
        look_for_interruption();
        Common here = common;
        here.baud = baud;
        const auto wire = command_line::open_port(here);
        const auto patience = static_cast<std::int64_t>(common.patience_ms == 150 ? 60 : common.patience_ms);
        FinderOptions how{.baud = baud,
                          .patience = base::Milliseconds{patience} + base::Microseconds{20'000'000 / baud},
                          .every_address = options.every_address,
                          .goes_on = goes_on};
        how.progress = [&](unsigned address) {
            progress(common, fmt::format("{} baud, address {}", baud, address));
        };
        const Found found = find_units(*wire, how);
        search.hear(found.noise);
        for (const FoundUnit& unit : found.units) tell_unit(search, unit, baud, served);
    });
    search.tell(
        "units",
        "bytes came, but no answer: is it another kind of device, or do several units have the same "
        "address? Try --every-address, or one motor alone",
        "nobody answers; is the motor switched on, and are A and B, or RX and TX, the right way round?");
}

struct MonitorArguments {
    std::string protocol = "mactalk";
    std::string from;
    std::string motor_port;
    std::string replay;
    unsigned gateway = registers::gateway::kDefaultAddress;
    bool old_code = false;
    bool bytes = false;
};

class Teller {
  public:
    Teller(const Common& common, const MonitorArguments& options) : common_(common), options_(options) {}

    void tell(Monitor& monitor, base::Instant start) {
        for (const MonitorEvent& event : order_.take(monitor)) {
            std::string line = line_of(event, start);
            if (options_.bytes && event.flaw.empty()) {
                if (!event.sent.empty()) line += "   > " + hex_words(event.sent);
                if (!event.received.empty()) line += "   < " + hex_words(event.received);
            }
            if (common_.json)
                command_line::tell(common_, line, document(event, start));
            else
                fmt::print("{}\n", line);
        }
    }

  private:
    static Json document(const MonitorEvent& event, base::Instant start) {
        Json document{{"time_s", static_cast<double>((event.at - start).count()) / 1e6}};
        if (event.address) document["address"] = *event.address;
        if (event.reg) document["register"] = *event.reg;
        if (event.value) document["value"] = *event.value;
        if (!event.request.empty()) document["request"] = event.request;
        if (!event.answer.empty()) document["answer"] = event.answer;
        if (!event.flaw.empty()) document["flaw"] = event.flaw;
        if (!event.sent.empty()) document["sent"] = hex_words(event.sent);
        if (!event.received.empty()) document["received"] = hex_words(event.received);
        return document;
    }

    const Common& common_;
    const MonitorArguments& options_;
    InOrder order_;
};

/// `50 50`, `505050`, `0x50`, or as the manuals write `50h,50h,50h - 08h,F7h`; # and what follows it in a
/// line is a remark. A file is read piece by piece, and so is a word without end.
class HexReader {
  public:
    using Take = std::function<void(std::uint8_t byte)>;
    HexReader(std::string name, Take take) : name_(std::move(name)), take_(std::move(take)) {}

    void add(std::string_view piece, bool ends_line) {
        for (const char c : piece) add(c);
        if (!ends_line) return;
        end_word();
        remark_ = false;
        ++line_;
    }

  private:
    static bool is_digit(char c) { return std::isxdigit(static_cast<unsigned char>(c)) != 0; }

    void add(char c) {
        constexpr std::size_t kLongestHeld = 64;  // an even number
        remark_ = remark_ || c == '#';
        if (remark_ || std::isspace(static_cast<unsigned char>(c)) != 0 || c == ',' || c == '-')
            return end_word();
        if (word_.size() > kLongestHeld) {
            const std::size_t prefix = length_of_prefix();
            give(std::string_view(word_).substr(prefix, kLongestHeld - prefix));
            word_.erase(0, kLongestHeld);
            is_open_ = true;
        }
        word_ += c;
    }

    std::size_t length_of_prefix() const {
        return !is_open_ && (word_.starts_with("0x") || word_.starts_with("0X")) ? 2 : 0;
    }

    void give(std::string_view digits) {
        if (digits.size() % 2 != 0 || !std::all_of(digits.begin(), digits.end(), is_digit))
            throw UserError(
                fmt::format("{}:{}: '{}' is no byte in hex; write two digits a byte", name_, line_, word_));
        for (std::size_t i = 0; i < digits.size(); i += 2)
            take_(static_cast<std::uint8_t>(std::stoi(std::string(digits.substr(i, 2)), nullptr, 16)));
    }

    void end_word() {
        std::string_view digits = std::string_view(word_).substr(length_of_prefix());
        if (digits.ends_with('h') || digits.ends_with('H')) digits.remove_suffix(1);
        give(digits);
        word_.clear();
        is_open_ = false;
    }

    std::string name_;
    Take take_;
    std::string word_;
    std::size_t line_ = 1;
    bool remark_ = false;
    bool is_open_ = false;  ///< the word has begun before what is held of it
};

bool is_midi(const MonitorArguments& options) {
    return options.protocol == "midi";
}

/// As for `midi`: --baud if given, else the factory setting.
Common line_of_midi(Common common) {
    common.baud = common.baud_or(registers::midi::kFactoryBaud);
    return common;
}

std::unique_ptr<Monitor> make_midi(const Common& common) {
    MidiMonitorOptions how{.baud = common.baud};
    if (!common.model.empty()) how.model = registers::midi::model_of(common.model);
    if (!common.model.empty() && !how.model)
        throw UserError(fmt::format("--model {}: write MAC23, MAC34-1 or MAC34-2", common.model));
    return make_midi_monitor(how);
}

std::unique_ptr<Monitor> make(const Common& common, const MonitorArguments& options) {
    if (is_midi(options)) return make_midi(common);
    MonitorOptions how{.gateway = static_cast<std::uint8_t>(options.gateway), .baud = common.baud};
    if (const auto model = model_option(common)) how.model = *model;
    if (options.old_code) how.code = protocol::fastmac::RegisterCode::older_example;
    if (options.protocol == "mactalk") return make_mactalk_monitor(how);
    if (options.protocol == "fastmac" || options.protocol == "flexmac") return make_fastmac_monitor(how);
    throw UserError(fmt::format("--protocol {}: write mactalk, fastmac (which is FlexMAC too) or midi",
                                options.protocol));
}

Side side_of(const MonitorArguments& options) {
    if (options.from == "motor") return Side::motor;
    if (options.from == "master") return Side::master;
    if (!options.from.empty()) throw UserError(fmt::format("--from {}: write master or motor", options.from));
    const bool own_pairs = options.protocol != "mactalk" && !is_midi(options);
    if (!options.motor_port.empty() || own_pairs) return Side::master;
    return Side::both;
}

void replay(const Common& common, const MonitorArguments& options) {
    const auto monitor = make(common, options);
    const Side side = side_of(options);
    const std::string name = name_of_input(options.replay);
    // A character takes ten bits; a file holds no times.
    const base::Microseconds character{10'000'000 / common.baud};
    base::Instant now{};
    Teller teller(common, options);
    HexReader reader(name, [&](std::uint8_t byte) {
        monitor->receive(side, byte, now);
        now += character;
        teller.tell(*monitor, {});
    });
    read_pieces(options.replay, [&](std::string_view piece, bool ends_line) {
        reader.add(piece, ends_line);
        return goes_on();
    });
    if (now == base::Instant{})
        throw UserError(name + ": there are no bytes in it; write two hex digits a byte");
    monitor->finish();
    teller.tell(*monitor, {});
}

void listen(const Common& common, const MonitorArguments& options) {
    const auto monitor = make(common, options);
    struct Line {
        std::unique_ptr<host::ByteClient> wire;
        Side side;
    };
    std::vector<Line> lines;
    lines.push_back({command_line::open_port(common), side_of(options)});
    if (!options.motor_port.empty()) {
        command_line::Common second = common;
        second.port = options.motor_port;
        lines.push_back({command_line::open_port(second), Side::motor});
    }
    Teller teller(common, options);
    const base::Instant start = lines.front().wire->now();
    constexpr base::Microseconds kWait{10'000};
    std::array<std::uint8_t, 256> bytes{};
    bool heard = false;
    while (goes_on() && output_has_reader()) {
        for (Line& line : lines) {
            const auto count = line.wire->read(bytes, kWait);
            if (!count) {
                monitor->finish();
                teller.tell(*monitor, start);
                throw mactalk_client::LineError(mactalk_client::LineError::Kind::port_gone,
                                                line.wire->name() + ": the other end is gone");
            }
            heard = heard || *count > 0;
            const base::Instant now = line.wire->now();
            for (std::size_t i = 0; i < *count; ++i) monitor->receive(line.side, bytes[i], now);
            monitor->pass(now);
        }
        teller.tell(*monitor, start);
        std::fflush(stdout);
    }
    monitor->finish();
    teller.tell(*monitor, start);
    if (!heard)
        remark(common,
               "nothing was heard: a wrong speed would show as noise, so either nobody spoke or the "
               "receiving wire does not lead to the line");
}

void monitor(Common& common, const MonitorArguments& options) {
    const Common line = is_midi(options) ? line_of_midi(common) : common;
    options.replay.empty() ? listen(line, options) : replay(line, options);
}

}  // namespace

void add_find(arguments::App& app, Common& common) {
    auto [command, options] = add_command(app, common, "find",
                                          "Which motors are on the line, by address and speed. Only reads. "
                                          "All speeds that a serial line has are tried, the usual one first",
                                          find);
    command.add_flag("--every-address", options.every_address,
                     "Ask 1 to 254 one by one, also where one motor seems to be alone");
    add_speed_options(command, options.speeds);
}

void add_monitor(arguments::App& app, Common& common) {
    auto [command, options] = add_command(
        app, common, "monitor",
        "Tell what others say on a line, decoded; only listens, with an adapter of its own, until Ctrl-C",
        monitor);
    command
        .add_option("--protocol", options.protocol,
                    "mactalk, fastmac (which is FlexMAC too), or midi (MAC23 and MAC34 on V24)")
        ->capture_default_str();
    command.add_option("--from", options.from,
                       "Whose bytes come: master or motor; both of a MacTalk or MIDI line, and the master of "
                       "a FastMAC line, if not said");
    command.add_option("--motor-port", options.motor_port,
                       "A second port for what the motor sends; --port then has what the master sends");
    command.add_option("--replay", options.replay, "Bytes in hex from a file instead; - is standard input");
    command
        .add_option("--gateway", options.gateway,
                    "Address of a gateway, whose registers have other names; 0: none")
        ->capture_default_str()
        ->in_range(0, 254);
    command.add_flag("--older-code", options.old_code, "FastMAC register codes of the manual's example");
    command.add_flag("--bytes", options.bytes, "Show the bytes in hex too");
}

}  // namespace nplc::macreg::cli
