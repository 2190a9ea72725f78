#include "panel_door.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <utility>

#include "faces/program_version.h"
#include "host/printable.h"
#include "input_file.h"
#include "panel/names.h"
#include "rehearsal/names.h"
#include "seqc/symbol_file.h"

namespace nplc::sim {
namespace {

constexpr std::size_t kMostWanted = 64;
constexpr std::size_t kMostRecord = 256 * 1024;
constexpr std::size_t kMostSymbols = 8;
constexpr std::string_view kBlocks = "motor blocked";

panel::WebOptions web_options(const std::string& where) {
    const auto colon = where.rfind(':');
    const std::string port = colon == std::string::npos ? "" : where.substr(colon + 1);
    panel::WebOptions web;
    const auto [end, error] = std::from_chars(port.data(), port.data() + port.size(), web.port);
    if (error != std::errc{} || end != port.data() + port.size() || colon == 0)
        throw InputError(
            fmt::format("--panel \"{}\": write an address and a port, such as 127.0.0.1:8080", where));
    web.address = where.substr(0, colon);
    if (web.address.starts_with('[') && web.address.ends_with(']'))
        web.address = web.address.substr(1, web.address.size() - 2);
    if (!panel::is_loopback(web.address))
        throw InputError(fmt::format(
            "--panel \"{0}\" would let other machines in, and a simulator has no password: write "
            "127.0.0.1:{1}; another machine reaches it through a tunnel, ssh -L {1}:127.0.0.1:{1} HERE",
            where, port));
    return web;
}

double milliseconds_of(const Session& session) {
    return static_cast<double>(session.now().count()) / 1e6;
}

/// Of another table; terminals and numbers where its symbols cannot be read. The machine stays the same.
Names names_in(std::string_view symbols, const Names& own) {
    const seqc::SymbolReading reading = seqc::read_symbols(symbols);
    Names names = reading.error.empty() ? rehearsal::names_of(reading.file.symbols) : Names{};
    names.motor = own.motor;
    names.drive = own.drive;
    return names;
}

/// The scenario actions of one line, or its error.
struct Read {
    Actions actions{};
    std::string error{};
};
Read read_action(const std::string& text, const Names& names) {
    if (text.find_first_of("\n\r#") != std::string::npos) return {{}, "write one action on one line"};
    ParsedScenario parsed = parse_scenario("at 0 s " + text, "action", names);
    if (!parsed.mistakes.empty()) return {{}, parsed.mistakes.front().message};
    if (parsed.scenario.at.size() != 1) return {{}, "this is no action; see host-sim/scenario"};
    return {std::move(parsed.scenario.at.front().actions), {}};
}

}  // namespace

PanelDoor::PanelDoor(const std::optional<std::string>& where, const Program& program, faces::AxisModel& axis)
    : program_(program), axis_(axis), names_(program.names) {
    if (!where) return;
    panel::PanelOptions options;
    options.web = web_options(*where);
    options.program = "nanoplc-sim " + faces::program_version();
    const auto* drive = program.names.drive;
    const std::string motor(drive != nullptr ? drive->name : registers::name_of(program.names.motor));
    auto opened = panel::Panel::open(options, {{.model = &axis, .motor = motor}}, this, this);
    if (!opened.panel) throw InputError("--panel: " + opened.error);
    panel_ = std::move(opened.panel);
}

void PanelDoor::open() {
    if (!is_open()) return;
    panel_->start();
    fmt::print("panel: {}\ntoken: {}\n", panel_->url(), panel_->token());
}

double PanelDoor::speed() const {
    const std::lock_guard lock(mutex_);
    return state_.is_paused ? 0 : state_.speed;
}

PanelDoor::State PanelDoor::state() const {
    const std::lock_guard lock(mutex_);
    return state_;
}

void PanelDoor::pause(bool on) {
    const std::lock_guard lock(mutex_);
    state_.is_paused = on;
}

void PanelDoor::set_speed(double speed) {
    const std::lock_guard lock(mutex_);
    state_.speed = speed;
}

std::string PanelDoor::record() const {
    const std::lock_guard lock(mutex_);
    return fmt::format("# Recorded with the panel, {}.\n{}end at {} ms\n",
                       program_.name.empty() ? "a table without names" : "program " + program_.name, record_,
                       state_.milliseconds + 1);
}

void PanelDoor::clear_record() {
    const std::lock_guard lock(mutex_);
    record_.clear();
    state_.recorded = 0;
}

std::string PanelDoor::act(std::string_view action) {
    Wanted wanted{.text = std::string(action), .actions = {}, .blocks = action == kBlocks};
    const std::lock_guard lock(mutex_);
    if (!wanted.blocks) {
        Read read = read_action(wanted.text, names_);
        if (!read.error.empty()) return read.error;
        wanted.actions = std::move(read.actions);
    }
    if (wanted_.size() >= kMostWanted) return "too much at once; try again";
    wanted_.push_back(std::move(wanted));
    return {};
}

void PanelDoor::perform(Session& session, Wanted wanted) {
    if (wanted.blocks) {
        wanted.text =
            fmt::format("motor stop above {0} counts, motor stop below {0} counts", session.seen().shaft);
        wanted.actions = read_action(wanted.text, program_.names).actions;
    }
    session.act(std::move(wanted.actions));
    const std::lock_guard lock(mutex_);
    add_to_record(milliseconds_of(session), wanted.text);
}

void PanelDoor::ordered(const faces::Command& command) {
    using gw = registers::gateway::Command;
    if (command.reg != registers::gateway::COMMAND) return;
    switch (static_cast<gw>(command.value)) {
        case gw::stop:
        case gw::safe:
        case gw::run:
        case gw::hold:
        case gw::step:
        case gw::scan:
            ordered_.push_back(
                fmt::format("gateway {}", registers::gateway::name_of(static_cast<gw>(command.value))));
            return;
        case gw::reset:
            ordered_.emplace_back("gateway restart");
            return;
        default:
            return;
    }
}

void PanelDoor::look(Session& session) {
    if (!is_open()) return;
    const gateway::Gateway& sequence = session.world().controller().sequence();
    const Set now{sequence.forces().inputs(), sequence.forces().outputs(), sequence.breakpoints()};
    if (now == set_) return;
    const Set before = std::exchange(set_, now);
    const double at = milliseconds_of(session);
    const std::lock_guard lock(mutex_);
    record_force(at, true, before.inputs, now.inputs);
    record_force(at, false, before.outputs, now.outputs);
    if (before.breakpoints == now.breakpoints) return;
    std::string steps;
    for (std::uint8_t step = 0; step < 63; ++step) {
        if ((now.breakpoints >> step & 1U) != 0) steps += (steps.empty() ? "" : " and ") + step_name(step);
    }
    add_to_record(at, "gateway break " + (steps.empty() ? "none" : steps));
}

void PanelDoor::record_force(double now, bool is_input, const registers::gateway::Force& before,
                             const registers::gateway::Force& after) {
    for (unsigned i = 0; i < (is_input ? kInputs : kOutputs); ++i) {
        const unsigned bit = 1U << i;
        const bool was = (before.mask & bit) != 0;
        const bool is = (after.mask & bit) != 0;
        const bool level = (after.levels & bit) != 0;
        if (!is && !was) continue;
        if (is && was && level == ((before.levels & bit) != 0)) continue;
        const std::string name = is_input ? names_.input(i) : names_.output(i);
        const bool holds = level != (is_input && names_.is_inverted(i));
        add_to_record(now, is ? fmt::format("gateway force {} := {:d}", name, holds)
                              : fmt::format("gateway release {}", name));
    }
}

/// A copy of a step by its number: its name is none of the program's.
std::string PanelDoor::step_name(std::uint8_t step) const {
    const bool is_named = names_.steps.contains(step) && !names_.copy_of.contains(step);
    return is_named ? names_.step(step) : fmt::format("{}", step);
}

void PanelDoor::add_to_record(double milliseconds, std::string_view text) {
    if (record_.size() > kMostRecord) return;
    record_ += fmt::format("at {:.3f} ms {}\n", milliseconds, text);
    ++state_.recorded;
}

void PanelDoor::note(std::string_view action) {
    const std::lock_guard lock(mutex_);
    add_to_record(static_cast<double>(state_.milliseconds), action);
}

void PanelDoor::serve(Session& session) {
    if (!is_open()) return;
    std::vector<Wanted> wanted;
    {
        const std::lock_guard lock(mutex_);
        wanted.swap(wanted_);
        state_.milliseconds = static_cast<std::uint64_t>(session.now().count() / 1'000'000);
    }
    for (const std::string& command : std::exchange(ordered_, {})) {
        const std::lock_guard lock(mutex_);
        add_to_record(milliseconds_of(session), command);
    }
    look(session);
    for (Wanted& one : wanted) perform(session, std::move(one));
    const std::lock_guard lock(mutex_);
    state_.is_cut = session.world().line_is_cut();
    state_.is_blocked = session.world().shaft_is_blocked();
}

PanelDoor::Found PanelDoor::find(std::size_t, std::uint32_t crc) {
    const auto kept = symbols_.find(crc);
    Found found;
    if (kept != symbols_.end()) {
        found.text = kept->second;
    } else if (crc == program_.crc32) {
        found = {program_.file, program_.symbols_text};
    }
    const std::lock_guard lock(mutex_);
    take_names(crc, found.text);
    return found;
}

void PanelDoor::take_names(std::uint32_t crc, std::string_view symbols) {
    const bool is_own = crc == program_.crc32 && symbols == program_.symbols_text;
    names_ = is_own ? program_.names : names_in(symbols, program_.names);
    if (std::exchange(active_, crc).value_or(crc) != crc)
        record_ += fmt::format("# at {} ms another table became active, which a scenario cannot do\n",
                               state_.milliseconds);
}

std::string PanelDoor::keep(std::size_t, std::uint32_t crc, std::string_view text) {
    // Of the active table and some others: one that is only stored may become active later.
    std::erase_if(symbols_,
                  [this](const auto& one) { return symbols_.size() > kMostSymbols && one.first != active_; });
    symbols_[crc] = std::string(text);
    if (const faces::Scaling scale = panel::scale_in(text); !panel::is_same(scale, axis_.scaling()))
        host::complain(
            fmt::format("the uploaded program's SCALE is {}: the panel shows it, Modbus, MQTT and "
                        "metrics keep to {}; start the simulator with this program for them",
                        panel::in_words(scale), panel::in_words(axis_.scaling())));
    return {};
}

}  // namespace nplc::sim
