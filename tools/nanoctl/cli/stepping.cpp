#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/session.h"
#include "nanoctl/stopping.h"
#include "nanoctl/texts.h"

namespace nplc::nanoctl::cli {
namespace {

void tell_held(Session& session) {
    const Status status = session.status();
    const Fired fired = read_fired(session.gateway());
    const Names& names = session.names();
    std::string terms;
    for (const std::uint16_t term : fired.terms)
        terms += fmt::format("{}{}{}", terms.empty() ? "" : ", ", term, names.term_place(term));
    session.tell(fmt::format("{}, step {}, timer {} ms, counter {}, out {}, true terms of step {}: {}{}",
                             name_of(status.run_state), names.step(status.step), status.timer, status.counter,
                             signals_text(status.outputs, 4, names, false), names.step(fired.step),
                             terms.empty() ? "none" : terms, held_remark(status)),
                 {{"state", name_of(status.run_state)},
                  {"step", status.step},
                  {"step_name", names.step_name(status.step)},
                  {"timer", status.timer},
                  {"counter", status.counter},
                  {"outputs", status.outputs},
                  {"can_go_on", !status.has(gw::kCannotGoOn)},
                  {"fired_step", fired.step},
                  {"fired_terms", fired.terms}});
}

struct StepOptions {
    gw::Command order{};
    unsigned times = 1;
    unsigned seconds = 10;
};

/// A pending step must be cancelled: it would hold the sequence later, unexpectedly.
std::string cancel(Session& session) {
    try {
        stop_machine(session.gateway(), gw::Command::hold);
    } catch (const Refused&) {  // the sequence was stopped meanwhile
    }
    const Status status = session.status();
    return fmt::format("the sequence is {} in step {}", name_of(status.run_state),
                       session.names().step(status.step));
}

/// The sequence is held, which is no proof that the motor is stopped.
void expect_no_doubt(Session& session, gw::Command order) {
    const std::string doubt = doubt_of_stop(session.gateway());
    if (!doubt.empty()) throw NotConfirmed(fmt::format("{}: {}", name_of(order), doubt));
}

void go_once(Session& session, gw::Command order, unsigned seconds) {
    session.gateway().command(order);
    bool held = false;
    try {
        held = session.wait_until_held(base::Milliseconds{std::int64_t{1000} * seconds});
    } catch (const Interrupted&) {
        session.gateway().set_goes_on({});
        throw Interrupted("interrupted and cancelled: " + cancel(session));
    }
    if (held) return expect_no_doubt(session, order);
    const bool stopped = session.status().run_state == gw::RunState::stopped;
    if (stopped) throw Refused(gw::Result::not_running, gw::COMMAND, 0, "the sequence was stopped meanwhile");
    throw Refused(gw::Result::not_running, gw::COMMAND, 0,
                  fmt::format("nothing happened in {} s and the {} was cancelled: {}; --wait waits longer",
                              seconds, name_of(order), cancel(session)));
}

void go(Session& session, const StepOptions& options) {
    session.right_names();
    for (unsigned i = 0; i < options.times; ++i) {
        session.gateway().look_for_interruption();
        go_once(session, options.order, options.seconds);
        tell_held(session);
    }
}

void add(arguments::App& app, Common& common, gw::Command order, const char* text) {
    auto [command, options] = add_command(app, common, std::string(name_of(order)), text, go);
    options.order = order;
    command.add_option("times", options.times, "How often, 1 unless named")->in_range(1, 10'000);
    command.add_option("--wait", options.seconds, "Seconds to wait for each")
        ->capture_default_str()
        ->in_range(1, 86'400);
}

}  // namespace

void add_stepping(arguments::App& app, Common& common) {
    add(app, common, gw::Command::step,
        "Run until the step changes, then hold with the motor stopped; from stopped it starts");
    add(app, common, gw::Command::scan,
        "Run one scan in which something happens, then hold; from stopped it starts");
}

}  // namespace nplc::nanoctl::cli
