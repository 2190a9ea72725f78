#include "mqtt_config.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "broker/session.h"
#include "mqtt/client.h"
#include "orders/order.h"
#include "panel/web_server.h"

namespace nplc::boards {
namespace {

namespace gw = registers::gateway;

constexpr std::array kCommands{gw::Command::run,  gw::Command::stop, gw::Command::safe,
                               gw::Command::hold, gw::Command::step, gw::Command::scan};

std::string host_name() {
    std::array<char, 65> name{};
    if (::gethostname(name.data(), name.size() - 1) != 0) return "nanoplc";
    const std::string text = name.data();
    return mqtt::is_topic_part(text) ? text : "nanoplc";
}

void read_names(Section& section, mqtt::Options& options) {
    options.node = host_name();
    const auto read = [&section](const char* key, std::string& part) {
        const LocatedText text = located_text(section, key);
        if (!text.is_there()) return;
        part = text.text;
        if (!mqtt::is_topic_part(part))
            section.complain(key, "is no part of a topic: 1 to 64 characters without + / and #");
    };
    read("group", options.group);
    read("node", options.node);
    read("primary_host", options.primary_host);
}

void read_secrets(Section& section, MqttConfig& config) {
    mqtt::Options& options = config.options;
    config.user = located_text(section, "user");
    options.user = config.user.text;
    config.password_file = located_text(section, "password_file");
    options.password_file = config.password_file.text;
    const auto read_file = [&](const char* key) {
        return config.tls_files.emplace_back(located_text(section, key)).text;
    };
    options.ca_file = read_file("ca_file");
    options.certificate_file = read_file("certificate_file");
    options.key_file = read_file("key_file");
    for (const broker::Mistake& mistake : broker::mistakes_of(options))
        section.complain(std::string(mistake.key), std::string(mistake.text));
}

void read_commands(Section& section, mqtt::Options& options) {
    const std::vector<std::string> names = mqtt_command_names();
    const TomlValue* list = section.list("commands", "a list of commands: [\"stop\"]");
    if (list == nullptr) return;
    for (const TomlValue& item : list->items) {
        const auto place = std::find(names.begin(), names.end(), item.text);
        if (item.kind != TomlValue::Kind::text || place == names.end()) {
            section.complain("commands", fmt::format("holds something else than {}", fmt::join(names, ", ")));
            return;
        }
        const gw::Command command = kCommands[static_cast<std::size_t>(place - names.begin())];
        if (std::find(options.commands.begin(), options.commands.end(), command) == options.commands.end())
            options.commands.push_back(command);
    }
}

void read_set_points(Section& section, mqtt::Options& options) {
    if (const auto recipes = section.flag("recipes")) options.recipes = *recipes;
    const TomlValue* list = section.list("set_points", "a list of names: [\"Length\"], or [\"*\"] for all");
    if (list == nullptr) return;
    for (const TomlValue& item : list->items) {
        if (item.kind != TomlValue::Kind::text || item.text.empty())
            return section.complain("set_points", "holds something else than names");
        options.set_points.push_back(item.text);
    }
}

/// Checks that need more than the name rules of one gateway.
void check_names(Section& section, const mqtt::Options& options) {
    for (const auto& [key, part] : {std::pair{"group", options.group}, {"node", options.node}}) {
        if (part.find('/') != std::string::npos || !orders::is_name(part, orders::kLongestName))
            section.complain(
                key,
                "cannot be ordered for: with mqtt.orders it is printable, without / and blanks at its ends");
    }
}

void read_orders(Section& mqtt, mqtt::Options& options, Findings& findings) {
    Section section(mqtt.table("orders"), "mqtt.orders", findings);
    deployment::Settings& settings = options.orders;
    const LocatedText keys = located_text(section, "keys");
    settings.keys = keys.text;
    if (keys.is_there() && !keys.text.starts_with('/'))
        section.complain("keys",
                         "is no absolute path of a folder; write such as \"/etc/nanoplc/order-keys\"");
    if (keys.is_there() && !orders::has_crypto())
        section.complain(
            "keys",
            "asks for signed orders, which this program was built without (they need libsodium); "
            "write \"none\"");
    if (const auto how = section.choice("activate", {"when_stopped", "stop", "restart"}))
        settings.activation = static_cast<deployment::Activation>(*how);
    const LocatedText window = located_text(section, "window");
    settings.window = deployment::read_window(window.text);
    if (window.is_there() && !settings.window)
        section.complain("window", "is no part of a day; write such as \"02:00-04:30\"");
    constexpr std::int64_t kDay = 86'400'000;
    if (const auto time = section.number("healthy_after", 0, kDay))
        settings.healthy_after = base::Milliseconds(*time);
    if (const auto time = section.number("healthy_within", 0, kDay))
        settings.healthy_within = base::Milliseconds(*time);
    if (settings.healthy_within < settings.healthy_after)
        section.complain("healthy_within", "is shorter than healthy_after: no table would ever be healthy");
    if (const auto step = section.number("healthy_step", 0, 62))
        settings.healthy_step = static_cast<std::uint8_t>(*step);
    if (const auto period = section.number("report_every", 1'000, kDay))
        settings.report_every = base::Milliseconds(*period);
    section.finish();
    if (settings.takes_orders()) check_names(mqtt, options);
}

}  // namespace

std::vector<std::string> mqtt_command_names() {
    std::vector<std::string> names;
    names.reserve(kCommands.size());
    for (const gw::Command command : kCommands) names.emplace_back(gw::name_of(command));
    return names;
}

MqttConfig read_mqtt(Section& root, Findings& findings) {
    MqttConfig config;
    Section section(root.table("mqtt"), "mqtt", findings);
    mqtt::Options& options = config.options;
    config.broker = located_text(section, "broker");
    read_names(section, options);
    read_secrets(section, config);
    read_commands(section, options);
    read_set_points(section, options);
    if (const auto period = section.number("period", 100, 3'600'000))
        options.period = base::Milliseconds(*period);
    if (const auto store = section.number("store", 1, 1'000'000))
        options.store = static_cast<std::size_t>(*store);
    if (const auto age = section.number("command_age", 500, 60'000))
        options.command_age = base::Milliseconds(*age);
    read_orders(section, options, findings);
    section.finish();
    if (!config.broker.is_there()) return config;
    if (!broker::read_address(config.broker.text, options))
        section.complain("broker", "is no broker; write HOST:PORT such as \"192.168.10.2:1883\"");
    if (!broker::kIsBuiltIn)
        section.complain("broker",
                         "asks for MQTT, which this program was built without (it needs libmosquitto); "
                         "write \"none\"");
    return config;
}

std::optional<Mistake> clear_text(const MqttConfig& config) {
    constexpr std::uint16_t kTlsPort = 8'883;
    const mqtt::Options& options = config.options;
    if (!config.broker.is_there() || !options.ca_file.empty()) return std::nullopt;
    const bool has_password = !options.password_file.empty();
    if (options.port == kTlsPort)
        return Mistake{
            config.broker.line, config.broker.key,
            fmt::format("port {} is TLS's, and without a ca_file clear text goes to it{}; name a ca_file",
                        kTlsPort, has_password ? ", the password with it" : "")};
    if (has_password && !panel::is_loopback(options.host))
        return Mistake{config.password_file.line, config.password_file.key,
                       fmt::format("without a ca_file the password goes to {} in clear text; name a ca_file",
                                   options.host)};
    return std::nullopt;
}

std::optional<Mistake> no_password(const MqttConfig& config) {
    const mqtt::Options& options = config.options;
    const bool proves_itself = !options.password_file.empty() || !options.certificate_file.empty();
    if (!config.broker.is_there() || !config.user.is_there() || proves_itself) return std::nullopt;
    return Mistake{
        config.user.line, config.user.key,
        fmt::format("{} goes to the broker without a password; name a password_file", options.user)};
}

}  // namespace nplc::boards
