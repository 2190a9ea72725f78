#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/midi.h"
#include "command_line/files.h"
#include "macreg/midi/path_file.h"
#include "macreg/midi/values.h"
#include "registers/midi_scale.h"
#include "text/text.h"

namespace nplc::macreg::cli {
namespace {

using midi_client::Plan;
using midi_client::Target;
using midi_client::Waypoint;

struct Job {
    std::vector<std::uint8_t> addresses{};
    std::vector<Waypoint> path{};  ///< absolute positions
    std::string about{};           ///< a note for the user before it begins
};

/// 003 §V.8: 0 is all of them.
void look_at_addresses(const MidiCommon& midi, const std::vector<std::uint8_t>& addresses) {
    for (const std::uint8_t address : addresses) look_at_address(midi, "axis", address);
}

Plan plan_of(const Job& job) {
    auto [plan, error] = midi_client::plan_path(job.addresses, job.path);
    if (!error.empty()) throw UserError(error);
    return std::move(plan);
}

double seconds_of(std::int64_t ticks) {
    return static_cast<double>(ticks) / midi::reg::kTicksPerSecond;
}

std::vector<Target> targets_of(const Job& job, const Waypoint& point) {
    std::vector<Target> targets;
    for (std::size_t i = 0; i < job.addresses.size(); ++i) {
        if (point.positions[i] < midi::reg::kMinPosition || point.positions[i] > midi::reg::kMaxPosition)
            throw UserError(fmt::format("{} is no position a module has: {} to {} inc", point.positions[i],
                                        midi::reg::kMinPosition, midi::reg::kMaxPosition));
        targets.push_back({job.addresses[i], static_cast<std::int32_t>(point.positions[i])});
    }
    return targets;
}

std::string places(const std::vector<Target>& targets) {
    std::string text;
    for (const Target& one : targets)
        text += fmt::format("{}axis {} at {} inc", text.empty() ? "" : ", ", one.address, one.position);
    return text;
}

Json document_of(const std::vector<Target>& targets) {
    Json axes = Json::array();
    for (const Target& one : targets) axes.push_back({{"address", one.address}, {"position", one.position}});
    return axes;
}

midi_client::PlayOptions play_options(const MidiSession& session) {
    return {.goes_on = goes_on, .progress = [&session](double part) {
                progress(session.common(), fmt::format("{:.0f} %, Ctrl-C stops", part * 100));
            }};
}

/// To the first point, each axis with its own speed and ramp, then along the path.
void carry_out(MidiSession& session, const Job& job) {
    const Plan plan = plan_of(job);
    const auto first = targets_of(job, job.path.front());
    const auto last = targets_of(job, job.path.back());
    hold_signals();
    remark(session.common(), job.about);
    const bool there = std::all_of(first.begin(), first.end(), [&](const Target& one) {
        return session.master().position(one.address) == one.position;
    });
    if (!there) midi_client::go_together(session.master(), first, {.goes_on = goes_on});
    midi_client::play(session.master(), plan, play_options(session));
    progress(session.common(), "");
    session.tell(fmt::format("done in {:.2f} s: {}", seconds_of(plan.ticks()), places(last)),
                 {{"seconds", seconds_of(plan.ticks())}, {"axes", document_of(last)}});
}

struct PathOptions {
    std::string file;
    bool check = false;
};

void path(const MidiCommon& midi, const PathOptions& options) {
    const std::string text = command_line::read_text(options.file);
    const midi::PathFile file = midi::read_path(text, {.model = midi_model(midi)});
    if (!file.problems.empty())
        throw UserError(fmt::format("{}: {}", options.file, fmt::join(file.problems, "; ")));
    Job job{.addresses = file.addresses, .path = file.path};
    const Plan plan = plan_of(job);
    job.about = fmt::format("{} axes, {} points, {:.2f} s", job.addresses.size(), job.path.size(),
                            seconds_of(plan.ticks()));
    if (options.check)
        return command_line::tell(midi.common, job.about,
                                  {{"seconds", seconds_of(plan.ticks())}, {"points", job.path.size()}});
    look_at_addresses(midi, job.addresses);
    MidiSession session(midi);
    carry_out(session, job);
}

struct CircleOptions {
    std::string axes, radius, speed, centre, acceleration, segment = "100ms";
    unsigned turns = 1;
    bool clockwise = false;
};

std::uint8_t axis_of(const MidiCommon& midi, std::string_view text) {
    const auto address = midi::read_address(text);
    if (!address)
        throw UserError(fmt::format("'{}' is no axis: write the address of a module, {} to 127", text,
                                    is_can(midi) ? 1 : 0));
    return *address;
}

midi_client::Circle circle_of(const MidiCommon& midi, const CircleOptions& options) {
    const auto model = midi_model(midi);
    midi_client::Circle circle{.turns = options.turns, .clockwise = options.clockwise};
    circle.radius = number_of(midi::typed_position(options.radius, model), "--radius ");
    circle.speed = static_cast<double>(number_of(midi::typed_rate(options.speed, model, false), "--speed "));
    if (!options.acceleration.empty())
        circle.acceleration = static_cast<double>(
            number_of(midi::typed_rate(options.acceleration, model, true), "--acceleration "));
    circle.segment_time =
        static_cast<double>(number_of(midi::typed_time(options.segment), "--segment ")) / 1e6;
    if (circle.radius <= 0) throw UserError("--radius: it must be more than 0");
    if (circle.speed <= 0) throw UserError("--speed: it must be more than 0");
    if (circle.segment_time <= 0) throw UserError("--segment: it must be more than 0");
    return circle;
}

void circle(const MidiCommon& midi, const CircleOptions& options) {
    const auto words = spelling::split(options.axes, ',');
    if (words.size() != 2) throw UserError("--axes: write the addresses of two modules, as 0,1");
    Job job{.addresses = {axis_of(midi, words[0]), axis_of(midi, words[1])}};
    if (job.addresses[0] == job.addresses[1]) throw UserError("--axes: they must be two different modules");
    look_at_addresses(midi, job.addresses);
    midi_client::Circle circle = circle_of(midi, options);
    const auto centre = spelling::split(options.centre, ',');
    if (!options.centre.empty()) {
        if (centre.size() != 2) throw UserError("--centre: write two positions, as 0,5rev");
        circle.centre_x = number_of(midi::typed_position(centre[0], midi_model(midi)), "--centre ");
        circle.centre_y = number_of(midi::typed_position(centre[1], midi_model(midi)), "--centre ");
    }
    MidiSession session(midi);
    if (options.centre.empty()) {
        circle.centre_x = session.master().position(job.addresses[0]) - circle.radius;
        circle.centre_y = session.master().position(job.addresses[1]);
    }
    job.path = midi_client::circle_path(circle);
    job.about = fmt::format(
        "a circle around {}, {} inc, {} corners, {:.2f} s; the ways between the corners are off it by {:.1f} "
        "inc",
        circle.centre_x, circle.centre_y, job.path.size() - 1, seconds_of(job.path.back().ticks),
        midi_client::circle_deviation(circle, job.path));
    carry_out(session, job);
}

void together(const MidiCommon& midi, const std::vector<std::string>& words) {
    std::vector<Target> targets;
    for (const std::string& word : words) {
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos)
            throw UserError(fmt::format("'{}': write ADDRESS=POSITION, as 1=20000 or 1=2rev", word));
        const std::int64_t position =
            number_of(midi::typed_position(word.substr(equals + 1), midi_model(midi)), "together: ");
        if (position < midi::reg::kMinPosition || position > midi::reg::kMaxPosition)
            throw UserError(fmt::format("'{}' is out of range: {} to {} inc (003 §IV)", word,
                                        midi::reg::kMinPosition, midi::reg::kMaxPosition));
        targets.push_back({axis_of(midi, word.substr(0, equals)), static_cast<std::int32_t>(position)});
        for (std::size_t i = 0; i + 1 < targets.size(); ++i) {
            if (targets[i].address == targets.back().address)
                throw UserError(fmt::format("together: address {} stands there twice", targets[i].address));
        }
    }
    for (const Target& one : targets) look_at_addresses(midi, {one.address});
    MidiSession session(midi);
    hold_signals();
    midi_client::go_together(session.master(), targets, {.goes_on = goes_on});
    session.tell(places(targets), {{"axes", document_of(targets)}});
}

}  // namespace

void add_midi_path(arguments::App& app, MidiCommon& midi) {
    auto [together_command, words] = add_command(app, midi, "together",
                                                 "Moves of several modules that begin at the same time (10h, "
                                                 "11h, SYNC), each with its SPEED and RAMP; Ctrl-C stops all",
                                                 together);
    together_command.add_option("targets", words, "ADDRESS=POSITION, as 0=20000 1=2rev")->required();

    auto [circle_command, circle_options] = add_command(app, midi, "circle",
                                                        "Two modules draw a circle, by segments (16h), from "
                                                        "its rightmost point back to it; Ctrl-C stops both",
                                                        circle);
    circle_command.add_option("--axes", circle_options.axes, "Addresses of the modules for x and y, as 0,1")
        ->required();
    circle_command.add_option("--radius", circle_options.radius, "10000, 2rev")->required();
    circle_command
        .add_option("--speed", circle_options.speed, "Along the circle: 20000inc/s, 2rev/s, 120rpm")
        ->required();
    circle_command.add_option("--centre", circle_options.centre,
                              "X,Y; if not said, so that the circle begins where the modules are");
    circle_command.add_option(
        "--acceleration", circle_options.acceleration,
        "At its start and end: 40000inc/s2, 4rev/s2; none if not said, for a segment has no ramp");
    circle_command.add_option("--turns", circle_options.turns, "How often round")
        ->capture_default_str()
        ->in_range(1U, 10'000U);
    circle_command.add_option("--segment", circle_options.segment, "About how long a segment takes")
        ->capture_default_str();
    circle_command.add_flag("--clockwise", circle_options.clockwise, "The other way round");

    auto [path_command, path_options] =
        add_command(app, midi, "path",
                    "Several modules follow a path: CSV with a heading `time,0 [inc],1 [rev]` and a row a "
                    "point, in seconds; they go to the first point first; Ctrl-C stops all",
                    path);
    path_command.add_option("file", path_options.file, "The path")->required();
    path_command.add_flag("--check", path_options.check, "Only read the file; needs no module");
}

}  // namespace nplc::macreg::cli
