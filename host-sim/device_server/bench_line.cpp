#include "sim/bench_line.h"

namespace nplc::sim {
namespace {

constexpr const char* kHelp =
    "status: where the device is\n"
    "motor load 500, motor stop above 5 rev, motor power off for 2 s, motor supply 20 V, ...: what happens "
    "to it "
    "now; host-sim/scenario has them all";

}  // namespace

ControlPort::Answer carry_out(std::string_view line, const Names& names,
                              const std::function<std::string()>& status,
                              const std::function<std::string(Actions)>& act) {
    if (line == "status") return {.text = status()};
    if (line == "help") return {.text = kHelp};
    ParsedActions parsed = parse_actions(line, names);
    if (!parsed.mistake.empty()) return {false, parsed.mistake};
    const std::string why = act(std::move(parsed.actions));
    return {.text = why.empty() ? std::string() : "ok, but nothing follows: " + why};
}

}  // namespace nplc::sim
