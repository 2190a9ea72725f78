#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/session.h"
#include "nanoctl/forces.h"
#include "nanoctl/set_points.h"
#include "nanoctl/texts.h"
#include "text/text.h"

namespace nplc::nanoctl::cli {
namespace {

std::uint64_t read_breaks(GatewayClient& gateway) {
    return gateway.read(gw::BREAK_LOW) | static_cast<std::uint64_t>(gateway.read(gw::BREAK_HIGH)) << 32;
}

void tell_breaks(Session& session) {
    const std::uint64_t breaks = read_breaks(session.gateway());
    std::vector<unsigned> steps;
    std::string text;
    for (unsigned step = 0; step < 63; ++step) {
        if ((breaks >> step & 1U) == 0) continue;
        steps.push_back(step);
        text += (text.empty() ? "" : ", ") + session.names().step(step);
    }
    session.tell(text.empty() ? "no breakpoints" : "breakpoints at steps " + text, {{"steps", steps}});
}

std::uint64_t steps_mask(Session& session, const std::vector<std::string>& texts) {
    std::uint64_t mask = 0;
    for (const std::string& text : texts) {
        const auto step = session.right_names().find_step(text);
        if (!step)
            throw UserError(fmt::format("'{}' is no step: write 0..62, or a name of the program with --sym{}",
                                        text, session.right_names().guess(text, true)));
        mask |= session.right_names().with_copies(*step);
    }
    return mask;
}

struct BreakOptions {
    std::vector<std::string> added, removed;
    bool clear = false;
};

void change_breaks(Session& session, const BreakOptions& options) {
    const std::uint64_t add = steps_mask(session, options.added);
    const std::uint64_t remove = options.clear ? ~std::uint64_t{0} : steps_mask(session, options.removed);
    if (add == 0 && remove == 0) return tell_breaks(session);
    const std::uint64_t breaks = (read_breaks(session.gateway()) & ~remove) | add;
    session.gateway().write(gw::BREAK_LOW, static_cast<std::uint32_t>(breaks));
    session.gateway().write(gw::BREAK_HIGH, static_cast<std::uint32_t>(breaks >> 32));
    tell_breaks(session);
}

/// FORCE_IN or FORCE_OUT: levels below, mask at `mask_at`.
struct Force {
    std::uint8_t reg;
    unsigned mask_at;
    std::uint32_t levels = 0;
    std::uint32_t mask = 0;

    bool touched() const { return mask != 0; }
    void set(unsigned index, bool level) {
        mask |= 1U << index;
        levels = level ? levels | 1U << index : levels & ~(1U << index);
    }
    /// Includes what was forced before.
    std::uint32_t over(std::uint32_t before) const {
        return (before & ~mask & ~(mask << mask_at)) | levels | mask << mask_at;
    }
};

struct ForceOptions {
    std::vector<std::string> what;
    bool off = false;
    bool keep = false;
    double seconds = 0;
};

void parse_force(Session& session, const std::string& text, Force& in, Force& out) {
    const auto equals = text.find('=');
    const std::string name = text.substr(0, equals);
    const std::string level = equals == std::string::npos ? "" : text.substr(equals + 1);
    const Names& names = session.right_names();
    const auto input = names.find_input(name);
    const auto output = names.find_output(name);
    if ((!input && !output) || (level != "0" && level != "1"))
        throw UserError(
            fmt::format("'{}': write IN0..IN5 or OUT0..OUT3, or a name of the program with --sym, and "
                        "=0 or =1{}",
                        text, input || output ? "" : names.guess(name, false)));
    if (input && names.is_inverted(*input) && spelling::is_same(name, names.input(*input)))
        throw UserError(fmt::format(
            "'{0}': {1} is NOT IN{2}, and a force is of the wire: write IN{2}=0 for {1} on, IN{2}=1 for off",
            text, names.input(*input), *input));
    if (input ? (in.mask >> *input & 1U) != 0 : (out.mask >> *output & 1U) != 0)
        throw UserError(fmt::format("'{}': {} is named twice; name it once", text, name));
    if (input)
        in.set(*input, level == "1");
    else
        out.set(*output, level == "1");
}

void tell_forces(Session& session) {
    const std::uint32_t in = session.gateway().read(gw::FORCE_IN);
    const std::uint32_t out = session.gateway().read(gw::FORCE_OUT);
    const std::uint32_t left = session.gateway().read(gw::FORCE_LEFT);
    std::string text;
    Json forced = Json::object();
    const auto add = [&](const std::string& name, bool level) {
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", name, level ? 1 : 0);
        forced[name] = level ? 1 : 0;
    };
    for (unsigned i = 0; i < 6; ++i) {
        if ((in >> (8 + i) & 1U) != 0) add(session.names().wire(i), (in >> i & 1U) != 0);
    }
    for (unsigned i = 0; i < 4; ++i) {
        if ((out >> (8 + i) & 1U) != 0) add(session.names().output(i), (out >> i & 1U) != 0);
    }
    const bool kept_safe = (out >> 8 & 0x0F) != 0 && session.status().has(gw::kSafe);
    if (kept_safe) text += "; the safe state keeps the outputs until the sequence runs";
    session.tell(text.empty() ? "nothing is forced" : fmt::format("forced for {} ms: {}", left, text),
                 {{"forced", forced}, {"left_ms", left}, {"outputs_kept_safe", kept_safe}});
}

/// Forces time out unless renewed. Whoever ended or changed them meant it: nothing is forced anew then.
void keep_forces(Session& session, const Forces& kept, double seconds) {
    const base::Instant begun = session.now();
    const base::Microseconds limit{static_cast<std::int64_t>(seconds * 1e6)};
    const std::uint32_t timeout = std::max(session.gateway().read(gw::FORCE_LEFT), 100U);
    while (goes_on() && output_has_reader() && (seconds == 0 || session.now() - begun < limit)) {
        session.pause(base::Milliseconds{std::min(timeout / 4, 500U)});
        if (const auto ended = renew_forces(session.gateway(), kept))
            throw command_line::Failure(command_line::kRefused, *ended);
    }
    session.gateway().write(gw::FORCE_IN, 0);
    session.gateway().write(gw::FORCE_OUT, 0);
}

void force(Session& session, const ForceOptions& options) {
    GatewayClient& gateway = session.gateway();
    Force in{.reg = gw::FORCE_IN, .mask_at = 8};
    Force out{.reg = gw::FORCE_OUT, .mask_at = 8};
    for (const std::string& text : options.what) parse_force(session, text, in, out);
    for (const Force& one : {in, out}) {
        if (options.off) gateway.write(one.reg, 0);
        if (one.touched()) gateway.write(one.reg, one.over(gateway.read(one.reg)));
    }
    const Forces kept = options.what.empty() ? read_forces(gateway)
                                             : Forces{.in = in.levels | in.mask << in.mask_at,
                                                      .out = out.levels | out.mask << out.mask_at};
    tell_forces(session);
    if (options.keep || options.seconds > 0) keep_forces(session, kept, options.seconds);
}

bool is_of_set_points(const LogEntry& entry) {
    const auto event = static_cast<gw::Event>(entry.event);
    return event == gw::Event::set_points_changed || event == gw::Event::recipe_loaded ||
           event == gw::Event::recipe_saved || event == gw::Event::recipe_deleted;
}

bool is_of_drop(const LogEntry& entry) {
    return static_cast<gw::Event>(entry.event) == gw::Event::set_points_dropped;
}

/// The cause of each change, and the values with their old ones.
std::string set_point_text(const LogEntry& entry, const KnownChanges& known) {
    const std::string by(gw::name_of(static_cast<gw::Origin>(entry.detail >> 8)));
    const bool of_recipe = static_cast<gw::Event>(entry.event) != gw::Event::set_points_changed;
    std::string text = fmt::format(" by {}", by);
    if (of_recipe) text += fmt::format(", {}", entry.detail & 0xFF);
    if (of_recipe && static_cast<gw::Event>(entry.event) != gw::Event::recipe_loaded) return text;
    const std::string changes = set_points::changes_text(known.changes, known.record, entry.uptime);
    return changes.empty() ? text : text + ": " + changes;
}

/// The names of another table's set-points are unknown.
std::string dropped_text(const LogEntry& entry, const KnownChanges& known) {
    return entry.number >= known.record_since ? set_points::names_of(known.record, entry.detail)
                                              : fmt::format("{}", std::popcount(entry.detail));
}

std::string detail_text(const LogEntry& entry, const KnownChanges& known) {
    if (is_of_set_points(entry)) return set_point_text(entry, known);
    if (is_of_drop(entry)) return ": " + dropped_text(entry, known);
    switch (static_cast<gw::Event>(entry.event)) {
        case gw::Event::forced:
            return entry.detail == gw::FORCE_OUT ? ", outputs" : ", inputs";
        case gw::Event::forces_ended:
            return entry.detail == 1 ? ", by silence" : ", by the user";
        case gw::Event::held:
        case gw::Event::breakpoint:
            return entry.detail == 1
                       ? ", cannot go on from there: the motor cannot take it up again, or orders were "
                         "dropped"
                       : "";
        case gw::Event::stop_confirmed:
            return fmt::format(", {} ms after it was asked", entry.detail);
        case gw::Event::line_late:
            return fmt::format(
                ", {} ms where 40 ms are allowed: set the latency timer of its USB adapter to 1 ms",
                entry.detail);
        case gw::Event::upload_failed:
            return fmt::format(", {}", gw::describe(static_cast<gw::Result>(entry.detail & 0xFF)));
        case gw::Event::motor_fault:
            return fmt::format(", {}", name_of(static_cast<gw::DriveFault>(entry.detail)));
        default:
            return entry.detail == 0 ? "" : fmt::format(", {}", entry.detail);
    }
}

void log(Session& session, const bool& clear) {
    const auto entries = read_log(session.gateway());
    KnownChanges known;
    const auto has = [&](auto what) { return std::any_of(entries.begin(), entries.end(), what); };
    if (has(is_of_set_points) || has(is_of_drop)) known = read_changes(session.gateway());
    for (const LogEntry& entry : entries) {
        const auto event = static_cast<gw::Event>(entry.event);
        if (event == gw::Event::table_activated || event == gw::Event::started)
            known.record_since = entry.number;
    }
    std::string text;
    Json list = Json::array();
    for (const LogEntry& entry : entries) {
        text +=
            fmt::format("{:>14}  step {}  {}{}\n", time_text(entry.uptime), session.names().step(entry.step),
                        gw::name_of_log_code(entry.event), detail_text(entry, known));
        list.push_back({{"number", entry.number},
                        {"uptime_ms", entry.uptime},
                        {"event", gw::name_of_log_code(entry.event)},
                        {"step", entry.step},
                        {"detail", entry.detail}});
        if (is_of_set_points(entry)) {
            list.back()["by"] = gw::name_of(static_cast<gw::Origin>(entry.detail >> 8));
            list.back()["changes"] = set_points::changes_text(known.changes, known.record, entry.uptime);
        }
        if (is_of_drop(entry)) list.back()["dropped"] = dropped_text(entry, known);
    }
    if (clear) session.gateway().command(gw::Command::clear_log);
    if (!text.empty()) text.pop_back();
    session.tell(text.empty() ? "the log is empty" : text, {{"entries", list}});
}

}  // namespace

void add_break(arguments::App& app, Common& common) {
    auto [command, options] =
        add_command(app, common, "break",
                    "Breakpoints: the sequence is held when it enters such a step, the motor "
                    "stopped. Without more: list them",
                    change_breaks);
    command.add_option("steps", options.added, "Steps to add, by number or name");
    command.add_option("--remove", options.removed, "Steps to remove");
    command.add_flag("--clear", options.clear, "Remove all");
}

void add_force(arguments::App& app, Common& common) {
    auto [command, options] =
        add_command(app, common, "force",
                    "Force inputs and outputs. Forces end by themselves after 5 s (setting "
                    "force_timeout) unless kept. Without more: show them",
                    force);
    command.add_option("what", options.what, "IN2=1 OUT0=0 ..., or names of the program with --sym");
    command.add_flag("--off", options.off, "End all forces first");
    command.add_flag("--keep", options.keep,
                     "Keep them until Ctrl-C, or until nobody reads this, then end them");
    command.add_option("--for", options.seconds, "Keep them for so many seconds, then end them")
        ->non_negative();
}

void add_log(arguments::App& app, Common& common) {
    auto [command, clear] =
        add_command(app, common, "log", "The gateway's last 16 events, oldest first", log);
    command.add_flag("--clear", clear, "Empty it afterwards");
}

}  // namespace nplc::nanoctl::cli
