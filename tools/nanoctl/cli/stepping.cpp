#include <fmt/format.h>

#include <memory>

#include "cli/subcommands.h"
#include "nanoctl/words.h"

namespace nplc::nanoctl::cli {
namespace {

constexpr base::Milliseconds kPause{20};

/// Waits until the sequence is held; false if it was stopped instead, or the user has had enough.
bool wait_until_held(Session& session, base::Milliseconds patience) {
    const base::Instant end = session.now() + patience;
    while (goes_on()) {
        const auto state = session.status().run_state;
        if (state == gw::RunState::held) return true;
        if (state == gw::RunState::stopped || session.now() >= end) return false;
        session.pause(kPause);
    }
    return false;
}

void tell_held(Session& session) {
    const Status status = session.status();
    const Fired fired = read_fired(session.gateway());
    const Names& names = session.names();
    std::string terms;
    for (const std::uint16_t term : fired.terms)
        terms += fmt::format("{}{}{}", terms.empty() ? "" : ", ", term, names.term_place(term));
    session.tell(fmt::format("{}, step {}, timer {} ms, counter {}, out {}, true terms of step {}: {}",
                             name_of(status.run_state), names.step(status.step), status.timer, status.counter,
                             signals_text(status.outputs, 4, names, false), names.step(fired.step),
                             terms.empty() ? "none" : terms),
                 {{"state", name_of(status.run_state)},
                  {"step", status.step},
                  {"step_name", names.step_name(status.step)},
                  {"timer", status.timer},
                  {"counter", status.counter},
                  {"outputs", status.outputs},
                  {"fired_step", fired.step},
                  {"fired_terms", fired.terms}});
}

struct StepOptions {
    unsigned times = 1;
    unsigned seconds = 10;
};

void go(Session& session, gw::Command order, const StepOptions& options) {
    for (unsigned i = 0; i < options.times && goes_on(); ++i) {
        session.gateway().command(order);
        if (!wait_until_held(session, base::Milliseconds{1000 * options.seconds})) {
            const Status status = session.status();
            const bool gives_up = status.run_state != gw::RunState::stopped;
            if (gives_up) session.gateway().command(gw::Command::hold);
            throw Refused(
                gw::Result::not_running, gw::COMMAND, 0,
                fmt::format(
                    "nothing happened in {} s: the sequence was {} in step {}{}", options.seconds,
                    name_of(status.run_state), session.names().step(status.step),
                    gives_up ? " and its conditions did not come; it is given up and held there" : ""));
        }
        tell_held(session);
    }
}

void add(CLI::App& app, Common& common, gw::Command order, const char* text) {
    const auto options = std::make_shared<StepOptions>();
    CLI::App& command = add_command(app, std::string(name_of(order)), text);
    command.add_option("times", options->times, "How often, 1 unless named")->check(CLI::Range(1, 10'000));
    command.add_option("--wait", options->seconds, "Seconds to wait for each")
        ->capture_default_str()
        ->check(CLI::Range(1, 86'400));
    command.callback(
        [options, order, &common] { work(common, [&](Session& s) { go(s, order, *options); }); });
}

}  // namespace

void add_stepping(CLI::App& app, Common& common) {
    add(app, common, gw::Command::step,
        "Run until the step changes, then hold with the motor stopped; from stopped it starts");
    add(app, common, gw::Command::scan,
        "Run one scan in which something happens, then hold; from stopped it starts");
}

}  // namespace nplc::nanoctl::cli
