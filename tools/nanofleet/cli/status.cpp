#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "cli/fleet.h"
#include "nanofleet/roster.h"

namespace nplc::nanofleet::cli {
namespace {

struct StatusOptions {
    std::string group;
    std::uint32_t oldest = 300;
    std::uint32_t listen = 1'000;
};

Json document_of(const std::string& target, const Standing& standing, const Heard& heard) {
    Json document{{"target", target},
                  {"standing", name_of(standing.kind)},
                  {"text", standing.text},
                  {"contact", standing.contact}};
    if (heard.report) document["report"] = Json::parse(orders::write_report(*heard.report));
    return document;
}

std::string line_of(const std::string& target, const Standing& standing, const Heard& heard,
                    std::uint64_t now) {
    std::string table = "-";
    if (heard.report && !heard.report->table_sha256.empty()) {
        const std::string& name = heard.report->table_name;
        table = fmt::format("{} {}", name.empty() ? "?" : name, heard.report->table_sha256.substr(0, 12));
    }
    return fmt::format("{:<28} {:<10} {:<30} {:>8}  {}\n", target, name_of(standing.kind), table,
                       standing.contact == 0 ? "never" : age_text(standing.contact, now), standing.text);
}

void status(Common& common, const StatusOptions& options) {
    const Fleet fleet = open_fleet(common);
    const std::vector<Group> groups = groups_of(fleet, common, options.group);
    std::vector<std::string> wanted;
    Roster roster;
    Broker broker(fleet.broker, [&roster](auto topic, auto payload) { roster.take(topic, payload); });
    for (const Group& group : groups) {
        wanted.push_back(orders::hex(orders::sha256(artifact_of(group.table, group.symbols, group.proof))));
        broker.subscribe(Roster::topics(group.gateways));
    }
    listen(common, broker, options.listen);
    const std::uint64_t now = common.calendar();
    std::string text;
    Json list = Json::array();
    std::size_t right = 0;
    std::size_t all = 0;
    std::uint64_t oldest = now;
    for (std::size_t i = 0; i < groups.size(); ++i) {
        text += fmt::format("{}: {} {}\n", groups[i].name, groups[i].table, wanted[i].substr(0, 12));
        for (const std::string& target : groups[i].gateways) {
            const Heard& heard = roster.of(target);
            const Standing standing = judge(heard, wanted[i], now, std::uint64_t{1'000} * options.oldest);
            ++all;
            if (standing.kind == Standing::Kind::as_wanted) ++right;
            oldest = std::min(oldest, standing.contact);
            text += line_of(target, standing, heard, now);
            list.push_back(document_of(target, standing, heard));
            list.back()["group"] = groups[i].name;
            list.back()["wanted"] = wanted[i];
        }
    }
    text += fmt::format("{} of {} as wanted; oldest contact {}", right, all,
                        oldest == 0 ? "never" : age_text(oldest, now) + " ago");
    command_line::tell(common, text, {{"gateways", list}, {"as_wanted", right}, {"all", all}});
    if (right != all) common.exit_code = command_line::kRefused;
}

}  // namespace

void listen(const Common& common, Broker& broker, std::uint32_t milliseconds) {
    constexpr int kPiece = 50;
    constexpr std::uint64_t kLongest = 30'000;
    const std::uint64_t begun = common.steady();
    while (broker.unconfirmed() != 0 && common.steady() - begun < kLongest) {
        command_line::look_for_interruption();
        broker.serve(kPiece);
    }
    if (broker.unconfirmed() != 0)
        throw command_line::Failure(command_line::kNoAnswer, "the broker does not answer");
    if (broker.is_denied())
        throw command_line::Failure(
            command_line::kNoAnswer,
            "the broker does not let us read reports and orders; its access list must "
            "let this user");
    for (const std::uint64_t confirmed = common.steady(); common.steady() - confirmed < milliseconds;) {
        command_line::look_for_interruption();
        broker.serve(kPiece);
    }
}

void add_status(arguments::App& app, Common& common) {
    const auto [command, options] = command_line::add_command<StatusOptions>(
        app, "status", "What the gateways run, beside what they are to run",
        [&common](const StatusOptions& given) {
            command_line::guard(common, [&] { status(common, given); });
        });
    command.add_option("GROUP", options.group, "Of the fleet's file; all if left out");
    command.add_option("--oldest", options.oldest, "Who has not reported for so many seconds is silent")
        ->capture_default_str();
    command.add_option("--listen", options.listen, "For what the broker retains, so many ms")
        ->capture_default_str();
}

}  // namespace nplc::nanofleet::cli
