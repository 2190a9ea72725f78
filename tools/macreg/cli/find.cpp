#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "cli/session.h"
#include "host/terminal.h"
#include "macreg/finder.h"
#include "macreg/service.h"
#include "macreg/values.h"

namespace nplc::macreg::cli {
namespace {

using registers::Model;

struct FindArguments {
    bool every_address = false;
    bool this_speed = false;
    bool every_speed = false;
};

/// 001 §3.2.1: 4Eh is 4.14; 004 has six bits for the second part.
std::string version_text(const FoundUnit& unit) {
    const unsigned bits = unit.model == Model::mac800 ? 6 : 4;
    const std::int64_t major = unit.version >> bits & (unit.model == Model::mac800 ? 0x7F : 0xFFF);
    return fmt::format("firmware {}.{}", major, unit.version & ((1 << bits) - 1));
}

class Search {
  public:
    Search(Common& common, const FindArguments& options) : common_(common), options_(options) {}

    void run() {
        const bool socket = common_.port.starts_with("unix:") || common_.port.starts_with("tcp:") ||
                            common_.port.starts_with("pty:");
        if (socket || options_.this_speed) {
            at(common_.baud, socket);
        } else {
            for (const std::uint32_t baud : command_line::kSpeeds) {
                if (units_.empty() || options_.every_speed) at(baud, false);
            }
        }
        progress("");
        if (units_.empty())
            throw command_line::Failure(
                command_line::kNoAnswer,
                noise_ ? "bytes came, but no answer: is it another kind of device, or do several units "
                         "have the same address? Try --every-address, or one motor alone"
                       : "nobody answers; is the motor switched on, and are A and B, or RX and TX, the "
                         "right way round?");
        command_line::tell(common_, text_, {{"units", units_}});
    }

  private:
    void at(std::uint32_t baud, bool socket) {
        look_for_interruption();
        Common here = common_;
        here.baud = baud;
        const auto wire = command_line::open_port(here);
        FinderOptions options{
            .baud = baud, .patience = patience(baud), .every_address = options_.every_address};
        options.goes_on = goes_on;
        options.progress = [&](unsigned address) {
            progress(fmt::format("{} baud, address {}", baud, address));
        };
        const Found found = find_units(*wire, options);
        noise_ = noise_ || found.noise;
        for (const FoundUnit& unit : found.units) add(unit, baud, socket);
    }

    base::Microseconds patience(std::uint32_t baud) const {
        return base::Milliseconds{
                   static_cast<std::int64_t>(common_.patience_ms == 150 ? 60 : common_.patience_ms)} +
               base::Microseconds{20'000'000 / static_cast<std::int64_t>(baud)};
    }

    void add(const FoundUnit& unit, std::uint32_t baud, bool socket) {
        const std::string speed = socket ? "" : fmt::format(", {} baud", baud);
        if (!text_.empty()) text_ += '\n';
        if (unit.gateway) {
            text_ += fmt::format("address {:>3}{}: a NanoPLC gateway; the motor behind it answers here too",
                                 unit.address, speed);
            units_.push_back({{"address", unit.address}, {"baud", baud}, {"kind", "gateway"}});
            return;
        }
        const bool large = unit.model == Model::mac800;
        const std::string mode = mode_text(unit.model, unit.mode);
        text_ +=
            fmt::format("address {:>3}{}: {}, serial number {}, {}, {}", unit.address, speed,
                        large ? "MAC800" : "MAC50 to MAC141", unit.serial_number, version_text(unit), mode);
        units_.push_back({{"address", unit.address},
                          {"baud", baud},
                          {"kind", "motor"},
                          {"family", large ? "MAC800" : "MAC50-141"},
                          {"serial_number", unit.serial_number},
                          {"version", unit.version},
                          {"mode", unit.mode},
                          {"mode_name", mode}});
    }

    void progress(const std::string& text) const {
        if (common_.json || !host::is_terminal(stderr)) return;
        fmt::print(stderr, "\r\033[K{}", text);
        std::fflush(stderr);
    }

    Common& common_;
    const FindArguments& options_;
    std::string text_;
    Json units_ = Json::array();
    bool noise_ = false;
};

}  // namespace

void add_find(arguments::App& app, Common& common) {
    const auto options = std::make_shared<FindArguments>();
    arguments::App& command =
        add_command(app, "find",
                    "Which motors are on the line, by address and speed. Only reads. All "
                    "speeds that a serial line has are "
                    "tried, the usual one first");
    command.add_flag("--every-address", options->every_address,
                     "Ask 1 to 254 one by one, also where one motor seems to be alone");
    command.add_flag("--every-speed", options->every_speed,
                     "Go on with the other speeds when one has been answered at");
    command.add_flag("--this-speed", options->this_speed, "Only the speed of --baud");
    command.callback([options, &common] { guard(common, [&] { Search(common, *options).run(); }); });
}

}  // namespace nplc::macreg::cli
