#include "nanofleet/roll_out.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/fleet.h"
#include "nanofleet/key_files.h"
#include "whole_files/whole_files.h"

namespace nplc::nanofleet::cli {
namespace {

struct RollOutOptions {
    std::string group;
    std::string table;
    std::string symbols;
    std::string proof;
    std::string name;
    std::string key;
    std::string report;
    double most_failures = 5;
    std::uint32_t patience = 600;
    std::uint32_t oldest = 300;
    std::uint32_t listen = 1'000;
    bool again = false;
};

RollOut::Plan plan_of(const Group& group, const RollOutOptions& options) {
    RollOut::Plan plan{.targets = group.gateways};
    const bool is_other = !options.table.empty();
    const std::string& table = is_other ? options.table : group.table;
    plan.artifact = artifact_of(table, is_other ? options.symbols : group.symbols,
                                is_other ? options.proof : group.proof);
    plan.name = name_of_table(table, options.name);
    plan.key = read_secret_file(options.key);
    plan.most_failures = options.most_failures;
    plan.patience = std::uint64_t{1'000} * options.patience;
    plan.oldest = std::uint64_t{1'000} * options.oldest;
    plan.again = options.again;
    return plan;
}

std::string progress_of(const RollOut& roll_out) {
    using Kind = Outcome::Kind;
    return fmt::format("stage {} of 3: {} done, {} failed, {} under way, {} silent, {} to come",
                       roll_out.stage() + 1, roll_out.count(Kind::done), roll_out.count(Kind::failed),
                       roll_out.count(Kind::ordered), roll_out.count(Kind::silent),
                       roll_out.count(Kind::waits));
}

Json document_of(const RollOut& roll_out, const Group& group) {
    Json list = Json::array();
    for (const Outcome& outcome : roll_out.outcomes()) {
        Json one{{"target", outcome.target},
                 {"outcome", name_of(outcome.kind)},
                 {"text", outcome.text},
                 {"counter", outcome.counter}};
        const bool has_taken_time = outcome.ordered_at != 0 && outcome.ended_at >= outcome.ordered_at;
        one["milliseconds"] = has_taken_time ? Json(outcome.ended_at - outcome.ordered_at) : Json();
        list.push_back(one);
    }
    return {{"group", group.name},
            {"sha256", roll_out.sha256()},
            {"stopped", roll_out.was_stopped()},
            {"done", roll_out.count(Outcome::Kind::done)},
            {"all", roll_out.outcomes().size()},
            {"gateways", list}};
}

/// The gateways that are not done, a line each.
std::string text_of(const RollOut& roll_out) {
    std::string text;
    for (const Outcome& outcome : roll_out.outcomes()) {
        if (outcome.kind != Outcome::Kind::done)
            text += fmt::format("{}: {}{}{}\n", outcome.target, name_of(outcome.kind),
                                outcome.text.empty() ? "" : ": ", outcome.text);
    }
    return text + fmt::format("{}{} of {} run it", roll_out.was_stopped() ? "stopped, too many failed: " : "",
                              roll_out.count(Outcome::Kind::done), roll_out.outcomes().size());
}

void roll_out(Common& common, const RollOutOptions& options) {
    if (!orders::has_crypto()) throw UserError(std::string(orders::kNoCrypto));
    const Fleet fleet = open_fleet(common);
    const Group group = groups_of(fleet, common, options.group).front();
    RollOut work(plan_of(group, options));
    if (!options.report.empty()) {
        if (const std::string why = whole_files::why_not_made(options.report); !why.empty())
            throw UserError(why);
    }
    Roster roster;
    Broker broker(fleet.broker, [&roster](auto topic, auto payload) { roster.take(topic, payload); });
    broker.subscribe(Roster::topics(group.gateways));
    listen(common, broker, options.listen);
    const auto publish = [&broker](const auto& topic, const auto& payload) {
        broker.publish(topic, payload);
    };
    work.publish_pieces(publish);
    constexpr int kPiece = 50;
    while (!work.is_over() && command_line::goes_on()) {
        work.look(roster, common.calendar(), publish);
        command_line::progress(common,
                               progress_of(work) + (broker.is_connected() ? "" : "; the broker is away"));
        broker.serve(kPiece);
    }
    while (broker.unconfirmed() != 0 && command_line::goes_on()) broker.serve(kPiece);
    command_line::progress(common, "");
    const Json document = document_of(work, group);
    if (!options.report.empty()) {
        if (const std::string why = whole_files::write_files({{options.report, document.dump(1) + "\n"}});
            !why.empty())
            throw UserError(why);
    }
    if (!work.is_over())
        throw command_line::Failure(command_line::kInterrupted,
                                    progress_of(work) + "; the same command goes on from here", document);
    command_line::tell(common, text_of(work), document);
    if (work.count(Outcome::Kind::done) != work.outcomes().size()) common.exit_code = command_line::kRefused;
}

}  // namespace

void add_roll_out(arguments::App& app, Common& common) {
    const auto [command, options] = command_line::add_command<RollOutOptions>(
        app, "roll-out", "Order a group's table: from one gateway, then from a tenth, then from all",
        [&common](const RollOutOptions& given) {
            command_line::guard(common, [&] { roll_out(common, given); });
        });
    command.add_option("GROUP", options.group, "Of the fleet's file")->required();
    command.add_option("--key", options.key, "NAME.key of nanofleet keys")->required();
    command.add_option("--table", options.table,
                       "Another table than the group's, such as the former one to go back");
    command.add_option("--sym", options.symbols, "With --table: its F.sym, if it is not beside it");
    command.add_option("--proof", options.proof, "With --table: its F.proof");
    command.add_option("--name", options.name, "Of the table, for people; the file's if left out");
    command
        .add_option("--most-failures", options.most_failures,
                    "Per cent of those ordered; beyond it nothing more is")
        ->in_range(0.0, 100.0)
        ->capture_default_str();
    command.add_option("--patience", options.patience, "Seconds from an order to its end")
        ->capture_default_str();
    command
        .add_option("--oldest", options.oldest,
                    "Who has not reported for so many seconds is left out as silent")
        ->capture_default_str();
    command.add_option("--listen", options.listen, "For what the broker retains, so many ms")
        ->capture_default_str();
    command.add_flag("--again", options.again, "Order it once more where it has failed before");
    command.add_option("--report", options.report, "Write the outcome to this file, as JSON");
}

}  // namespace nplc::nanofleet::cli
