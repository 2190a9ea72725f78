#include "nanoctl/operating.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cli/session.h"

namespace nplc::nanoctl::cli {
namespace {

struct Options {
    bool take = false;
    bool release = false;
};

void tell_operator(const Session& session, const std::string& text, const Operator& who) {
    session.tell(text, {{"operator", in_words(who)},
                        {"way", static_cast<int>(who.way)},
                        {"peer", who.peer},
                        {"seconds_left", who.seconds_left},
                        {"you", who.is_you}});
}

/// The operator's lease ends with the connection: it is held until a signal comes.
void keep(Session& session) {
    while (goes_on() && output_has_reader()) {
        session.pause(base::Milliseconds{1'000});
        session.gateway().write(gw::OPERATE, static_cast<std::uint32_t>(gw::Operating::take));
    }
}

void operate(Session& session, const Options& options) {
    GatewayClient& gateway = session.gateway();
    const Operator before = read_operator(gateway);
    if (options.release) {
        gateway.write(gw::OPERATE, static_cast<std::uint32_t>(gw::Operating::give_back));
        return tell_operator(session, "nobody operates", {});
    }
    if (!options.take) {
        const bool is_free = before.way == gw::OperatorWay::nobody;
        const std::string left =
            is_free ? "" : fmt::format(", for {} s more unless it goes on", before.seconds_left);
        return tell_operator(session, fmt::format("{} operates{}", in_words(before), left), before);
    }
    gateway.write(gw::OPERATE, static_cast<std::uint32_t>(gw::Operating::take_over));
    const bool is_others = before.way != gw::OperatorWay::nobody && !before.is_you;
    tell_operator(session,
                  is_others ? fmt::format("taken over from {}; kept until Ctrl-C", in_words(before))
                            : "you operate; kept until Ctrl-C",
                  read_operator(gateway));
    keep(session);
}

}  // namespace

void add_operating(arguments::App& app, Common& common) {
    auto [command, options] = add_command(
        app, common, "operate",
        "Who operates: one client at a time, and all of a user's on a socket. With --take you do, as long "
        "as this runs",
        operate);
    command.add_flag("--take", options.take, "Operate, and replace the present operator, who is informed");
    command.add_flag("--release", options.release, "Give it back, for all your clients")->excludes("--take");
}

}  // namespace nplc::nanoctl::cli
