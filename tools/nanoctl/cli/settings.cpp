#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/session.h"
#include "text/text.h"

namespace nplc::nanoctl::cli {
namespace {

using gw::Setting;
using gw::SettingInfo;

const SettingInfo& find(const std::string& name) {
    for (const SettingInfo& info : gw::all_settings()) {
        if (info.name == name) return info;
    }
    throw UserError(fmt::format("'{}' is no setting; `nanoctl settings list` shows them all", name));
}

std::string value_text(const SettingInfo& info, std::uint32_t value) {
    if (info.has_none && value == gw::kNone) return "none";
    return fmt::format("{}{}{}", value, info.unit.empty() ? "" : " ", info.unit);
}

std::string range_text(const SettingInfo& info) {
    return fmt::format("{} to {}{}{}", info.lowest, value_text(info, info.highest),
                       info.has_none ? ", or none" : "",
                       info.id == Setting::user_baud || info.id == Setting::motor_baud
                           ? ", of 1200 2400 4800 9600 19200 38400 57600 115200 230400 460800 921600"
                           : "");
}

void list(Session& session) {
    std::string text;
    Json all = Json::object();
    for (const SettingInfo& info : gw::all_settings()) {
        const std::uint32_t value = session.gateway().read(gw::register_of(info.id));
        text += fmt::format("{}{:<18} {:<12} {} ({})", text.empty() ? "" : "\n", info.name,
                            value_text(info, value), info.help, range_text(info));
        all[std::string(info.name)] = value;
    }
    session.tell(text, {{"settings", all}});
}

void get(Session& session, const std::vector<std::string>& names) {
    std::string text;
    Json some = Json::object();
    for (const std::string& name : names) {
        const SettingInfo& info = find(name);
        const std::uint32_t value = session.gateway().read(gw::register_of(info.id));
        text += fmt::format("{}{} = {}", text.empty() ? "" : "\n", name, value_text(info, value));
        some[name] = value;
    }
    session.tell(text, {{"settings", some}});
}

struct Assignment {
    const SettingInfo* info;
    std::uint32_t value;
};

Assignment parse(const std::string& text) {
    const auto equals = text.find('=');
    if (equals == std::string::npos) throw UserError(fmt::format("'{}': write NAME=VALUE", text));
    const SettingInfo& info = find(text.substr(0, equals));
    const std::string typed = text.substr(equals + 1);
    const auto number = info.has_none && typed == "none" ? std::optional<std::int64_t>(gw::kNone)
                                                         : spelling::whole_number(typed);
    const bool fits = number && *number >= 0 && *number <= 0xFFFF'FFFF;
    const std::uint32_t value = fits ? static_cast<std::uint32_t>(*number) : 0;
    if (!fits || !gw::is_allowed(info.id, value))
        throw UserError(fmt::format("'{}': {} is {}", text, info.name, range_text(info)));
    return {&info, value};
}

bool is_taken(Session& session, const Assignment& one) {
    const auto other =
        one.info->id == Setting::gateway_address ? Setting::motor_address : Setting::gateway_address;
    if (one.info->id != Setting::gateway_address && one.info->id != Setting::motor_address) return false;
    return session.gateway().read(gw::register_of(other)) == one.value;
}

void write_one(Session& session, const Assignment& one) {
    try {
        session.gateway().write(gw::register_of(one.info->id), one.value);
    } catch (const Refused& refused) {
        const std::string why = refused.result() == gw::Result::bad_value && is_taken(session, one)
                                    ? "the address is taken: gateway and motor need one each"
                                    : std::string(gw::describe(refused.result()));
        throw Refused(refused.result(), refused.reg(), refused.detail(),
                      fmt::format("{}={}: {}", one.info->name, one.value, why));
    }
}

std::string set_text(const std::vector<Assignment>& assignments, bool keep) {
    const bool late = std::any_of(assignments.begin(), assignments.end(),
                                  [](const Assignment& one) { return one.info->at_reset; });
    if (keep)
        return late ? "set and kept; it counts from the next reset on (`nanoctl reset`)" : "set and kept";
    return late ? "set, but not kept: what counts from the next reset on does so only if kept; keep it with "
                  "--keep"
                : "set until the next reset; keep them with --keep";
}

struct SetOptions {
    std::vector<std::string> texts;
    bool keep = false;
};

/// All are checked before the first is written.
void set(Session& session, const SetOptions& options) {
    const auto& [texts, keep] = options;
    std::vector<Assignment> assignments;
    for (const std::string& text : texts) assignments.push_back(parse(text));
    Json changed = Json::object();
    for (const Assignment& one : assignments) {
        write_one(session, one);
        changed[std::string(one.info->name)] = one.value;
    }
    if (keep) session.gateway().command(gw::Command::keep_settings, base::Milliseconds{2'000});
    session.tell(set_text(assignments, keep), {{"settings", changed}, {"kept", keep}});
}

}  // namespace

void add_settings(arguments::App& app, Common& common) {
    arguments::App& command =
        add_command(app, "settings", "The gateway's settings; changed only while the sequence is stopped");
    command.require_subcommand(1);
    add_command(command, common, "list", "All of them, with their ranges", list);
    auto [getter, names] = add_command(command, common, "get", "Some of them", get);
    getter.add_option("names", names, "Names of settings")->required();
    auto [setter, options] = add_command(command, common, "set", "Change some of them", set);
    setter.add_option("values", options.texts, "NAME=VALUE ...")->required();
    setter.add_flag("--keep", options.keep, "Store all settings, so that they outlive a power cut");
}

}  // namespace nplc::nanoctl::cli
