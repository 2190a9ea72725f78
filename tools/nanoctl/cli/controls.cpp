#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/dropped.h"
#include "cli/session.h"
#include "nanoctl/set_points.h"
#include "nanoctl/stopping.h"
#include "nanoctl/texts.h"

namespace nplc::nanoctl::cli {
namespace {

void tell_state(Session& session, const Status& status, std::string_view rest = "") {
    session.tell(
        fmt::format("{}, step {}{}", name_of(status.run_state), session.names().step(status.step), rest),
        {{"state", name_of(status.run_state)}, {"step", status.step}});
}

void tell_stop(Session& session, const Status& status) {
    Json document{{"state", name_of(status.run_state)},
                  {"step", status.step},
                  {"motor_told", !status.has(gw::kVirtualMotor)}};
    if (status.run_state == gw::RunState::held) document["can_go_on"] = !status.has(gw::kCannotGoOn);
    session.tell(fmt::format("{}, step {}{}", name_of(status.run_state), session.names().step(status.step),
                             stop_remark(status)),
                 document);
}

void start(Session& session) {
    session.gateway().command(gw::Command::run);
    const Status status = session.status();
    const bool is_alone =
        status.run_state == gw::RunState::waiting_for_motor && !status.has(gw::kLinkDelivers);
    tell_state(session, status,
               is_alone
                   ? "; it does not answer: the sequence starts as soon as it does, nanoctl stop ends that"
                   : "");
}

void activate(Session& session) {
    GatewayClient& gateway = session.gateway();
    const std::optional<ValuesBefore> before = read_before(gateway, {});
    gateway.activate();
    const std::uint32_t crc = gateway.read(gw::TABLE_CRC);
    std::vector<set_points::Dropped> dropped;
    if (before) dropped = read_dropped(gateway, before, read_active_record(gateway));
    session.tell(fmt::format("the stored table is active, CRC {:08X}h{}", crc, lines_of(dropped)),
                 {{"crc32", crc}, {"dropped", json_of(dropped)}});
}

void reset(Session& session) {
    const std::uint8_t before = session.gateway().address();
    session.gateway().reset();
    const Status status = session.status();
    const std::uint8_t address = session.gateway().address();
    const std::string moved =
        address == before ? "" : fmt::format(", answers at address {} from now on", address);
    const bool is_stopped = status.run_state == gw::RunState::stopped;
    const std::string doubt = is_stopped ? doubt_of_stop(session.gateway()) : "";
    session.tell(
        fmt::format("restarted: {}{}", doubt.empty() ? std::string(name_of(status.run_state)) : doubt, moved),
        {{"state", name_of(status.run_state)},
         {"step", status.step},
         {"address", address},
         {"stop_unconfirmed", !doubt.empty()}});
}

void give_up_stop(Session& session) {
    const bool is_wanted = session.status().has(gw::kStopUnconfirmed);
    if (is_wanted) session.gateway().command(gw::Command::give_up_stop);
    session.tell(is_wanted ? "the stop is given up; THE MOTOR MAY BE MOVING" : "no stop waits for the motor",
                 {{"given_up", is_wanted}});
}

void add_stop(arguments::App& app, Common& common, gw::Command order, const char* text) {
    arguments::App& command = add_command(app, std::string(name_of(order)), text);
    command.callback([order, &common] {
        stop_work(common,
                  [&](Session& session) { tell_stop(session, stop_machine(session.gateway(), order)); });
    });
}

}  // namespace

void add_controls(arguments::App& app, Common& common) {
    add_command(app, common, "run",
                "Start the sequence from step 0, the motor stopped first; or let a held one go on", start);
    add_stop(app, common, gw::Command::stop, "Stop sequence and motor; outputs take their safe values");
    add_stop(app, common, gw::Command::safe, "Stop, and end forces, breakpoints and an upload too");
    add_stop(app, common, gw::Command::hold,
             "Hold the sequence at the end of a scan, the motor stopped, outputs as they are");
    add_command(app, common, "give-up-stop",
                "Repeat no longer a stop that the motor has not confirmed, so that it can be run again",
                give_up_stop);
    add_command(app, common, "activate",
                "Make the stored table the active one; waits 5 s for the motor to stand still", activate);
    add_command(app, common, "reset", "Restart the gateway and wait until it answers; only while stopped",
                reset);
}

}  // namespace nplc::nanoctl::cli
