#include "panel_door.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <utility>

#include "faces/program_version.h"
#include "host/printable.h"
#include "input_file.h"
#include "panel/names.h"

namespace nplc::sim {
namespace {

constexpr std::size_t kMostWanted = 64;
constexpr std::size_t kMostRecord = 256 * 1024;
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
    return web;
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
    : program_(program), axis_(axis) {
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
    Wanted wanted{std::string(action), action == kBlocks};
    if (!wanted.blocks) {
        if (const Read read = read_action(wanted.text, program_.names); !read.error.empty())
            return read.error;
    }
    const std::lock_guard lock(mutex_);
    if (wanted_.size() >= kMostWanted) return "too much at once; try again";
    wanted_.push_back(std::move(wanted));
    return {};
}

void PanelDoor::perform(Session& session, const Wanted& wanted) {
    const auto shaft = session.seen().shaft;
    const std::string text =
        wanted.blocks ? fmt::format("motor stop above {0} counts, motor stop below {0} counts", shaft)
                      : wanted.text;
    Read read = read_action(text, program_.names);
    if (!read.error.empty()) return;
    session.act(std::move(read.actions));
    const std::lock_guard lock(mutex_);
    add_to_record(static_cast<double>(session.now().count()) / 1e6, text);
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
    for (const Wanted& one : wanted) perform(session, one);
    const std::lock_guard lock(mutex_);
    state_.is_cut = session.world().line_is_cut();
    state_.is_blocked = session.world().shaft_is_blocked();
}

PanelDoor::Found PanelDoor::find(std::size_t, std::uint32_t crc) {
    if (crc == program_.crc32 && !program_.symbols_text.empty())
        return {program_.file, program_.symbols_text};
    const auto found = symbols_.find(crc);
    return found == symbols_.end() ? Found{crc == program_.crc32 ? program_.file : "", ""}
                                   : Found{"", found->second};
}

std::string PanelDoor::keep(std::size_t, std::uint32_t crc, std::string_view text) {
    symbols_.clear();  // the previous program's names are in program_, or it had none
    symbols_[crc] = std::string(text);
    if (const faces::Scaling scale = panel::scale_in(text); !panel::is_same(scale, axis_.scaling()))
        host::complain(
            fmt::format("the uploaded program's SCALE is {}: the panel shows it, Modbus, MQTT and "
                        "metrics keep to {}; start the simulator with this program for them",
                        panel::in_words(scale), panel::in_words(axis_.scaling())));
    return {};
}

}  // namespace nplc::sim
