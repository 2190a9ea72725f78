#include "plant_part.h"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "faces/program_version.h"
#include "hal_linux/tcp_listener.h"
#include "mqtt/client.h"
#include "panel/web_server.h"

namespace nplc::boards {
namespace {

constexpr base::Milliseconds kBetweenTries{5'000};

std::string orders_in_words(const deployment::Settings& settings) {
    constexpr const char* kHow[]{"while the sequence is stopped", "and stops the sequence for it",
                                 "and restarts the sequence for it"};
    return fmt::format("MQTT takes tables that a key of {} has signed, {}{}", settings.keys,
                       kHow[static_cast<std::size_t>(settings.activation)],
                       settings.window ? ", at " + settings.window->text() : "");
}

/// "axis x is unit 1, axis y is unit 2"
std::string units_in_words(const Config& config, const modbus::Settings& settings, std::uint8_t first) {
    std::vector<std::string> all;
    for (std::size_t i = 0; i < config.axes.size(); ++i)
        all.push_back(
            fmt::format("axis {} is unit {}", config.axes[i].name, modbus::unit_of(settings, i, first)));
    return fmt::format("{}", fmt::join(all, ", "));
}

/// Axes whose Modbus units change when another axis is added or removed.
std::optional<Mistake> moving_units(const Config& config) {
    const bool has_modbus = config.modbus.listen.is_there() || config.modbus.rtu_port.is_there();
    if (!has_modbus || config.axes.size() < 2) return std::nullopt;
    std::vector<std::string> names;
    int line = 0;
    for (const AxisConfig& axis : config.axes) {
        if (axis.modbus_unit.is_there()) continue;
        if (names.empty()) line = axis.line;
        names.push_back(axis.name);
    }
    if (names.empty()) return std::nullopt;
    return Mistake{
        line, "axis",
        fmt::format("{} {} no modbus_unit: when an axis before {} is removed or added, a PLC commands "
                    "another machine; write one for each axis",
                    fmt::join(names, ", "), names.size() == 1 ? "has" : "have",
                    names.size() == 1 ? "it" : "them")};
}

bool is_number(const std::string& host) {
    in6_addr address{};
    return ::inet_pton(AF_INET, host.c_str(), &address) == 1 ||
           ::inet_pton(AF_INET6, host.c_str(), &address) == 1;
}

/// "tcp:[::]:502" and "[::]:502": "::"
std::string host_in(std::string place) {
    if (place.starts_with("tcp:")) place.erase(0, 4);
    std::string host = place.substr(0, place.rfind(':'));
    return host.starts_with('[') && host.ends_with(']') ? host.substr(1, host.size() - 2) : host;
}

}  // namespace

std::vector<Mistake> plant_warnings(const Config& config) {
    std::vector<Mistake> warnings;
    for (const auto& warning : {clear_text(config.mqtt), no_password(config.mqtt), moving_units(config)}) {
        if (warning) warnings.push_back(*warning);
    }
    return warnings;
}

std::vector<Mistake> port_warnings(const Config& config) {
    std::vector<Mistake> warnings;
    for (const LocatedText& place : config.tcp_places()) {
        const unsigned port = hal_linux::TcpListener::port_in(place.text);
        if (!hal_linux::is_privileged(port)) continue;
        warnings.push_back(
            {place.line, place.key, fmt::format("port {}: {}", port, hal_linux::listen_remedy(EACCES))});
    }
    return warnings;
}

std::vector<std::string> closed_doors(const Config& config) {
    std::vector<std::string> lines;
    const std::string& broker = config.mqtt.options.host;
    if (config.mqtt.broker.is_there() && !panel::is_loopback(broker))
        lines.push_back(fmt::format(
            "the package's service reaches {} only after `systemctl edit nanoplc` with [Service], "
            "IPAddressAllow={} and a restart",
            broker,
            is_number(broker) ? broker
                              : "ADDRESS (the broker's, and the name server's if that is another machine)"));
    const auto places = config.tcp_places();
    const bool is_open = std::any_of(places.begin(), places.end(), [](const LocatedText& place) {
        return !panel::is_loopback(host_in(place.text));
    });
    if (is_open)
        lines.emplace_back(
            "the package's service lets another machine in only after `systemctl edit nanoplc` with "
            "[Service], IPAddressAllow=ADDRESS (that machine's) and a restart");
    return lines;
}

std::vector<std::string> faces_in_words(const Config& config) {
    std::vector<std::string> lines;
    if (config.panel.listen.is_there())
        lines.push_back(fmt::format("the panel listens at {}", config.panel.listen.text));
    const ModbusConfig& modbus = config.modbus;
    const char* const rights = modbus.options.settings.writes ? "and operates" : "for reading and stopping";
    if (modbus.listen.is_there())
        lines.push_back(fmt::format("Modbus TCP listens at {}, {}: {}", modbus.listen.text, rights,
                                    units_in_words(config, modbus.options.settings, 1)));
    if (modbus.rtu_port.is_there())
        lines.push_back(fmt::format("Modbus RTU answers on {}, {} baud, {}: {}", modbus.rtu_port.text,
                                    modbus.rtu.baud, rights,
                                    units_in_words(config, modbus.rtu.settings, modbus.rtu.unit)));
    if (config.metrics.listen.is_there())
        lines.push_back(
            fmt::format("metrics are served at {}, for reading only", config.metrics.listen.text));
    if (config.mqtt.broker.is_there()) {
        const mqtt::Options& mqtt = config.mqtt.options;
        std::vector<std::string> commands;
        for (const auto command : mqtt.commands) commands.emplace_back(registers::gateway::name_of(command));
        if (mqtt.may_set("*"))
            commands.emplace_back("all set-points");
        else
            for (const auto& name : mqtt.set_points) commands.push_back("set-point " + name);
        if (mqtt.recipes) commands.emplace_back("recipes");
        lines.push_back(
            fmt::format("MQTT goes out to {}{}, as {}/{}, and takes {}", config.mqtt.broker.text,
                        mqtt.ca_file.empty() ? " without TLS" : " with TLS", mqtt.group, mqtt.node,
                        commands.empty() ? "no commands" : fmt::format("{}", fmt::join(commands, ", "))));
        if (mqtt.orders.takes_orders()) lines.push_back(orders_in_words(mqtt.orders));
    }
    return lines;
}

void PlantPart::open(faces::Axes axes, base::Instant now) {
    axes_ = std::move(axes);
    for (const Mistake& warning : plant_warnings(config_))
        journal_.write(
            LogLevel::warning, JournalEvent::configuration,
            fmt::format("configuration, line {}: {}: {}", warning.line, warning.key, warning.text));
    if (config_.modbus.listen.is_there()) add_modbus();
    if (config_.modbus.rtu_port.is_there()) add_modbus_rtu();
    if (config_.metrics.listen.is_there()) add_metrics();
    if (config_.mqtt.broker.is_there()) add_mqtt();
    look(now);
}

void PlantPart::look(base::Instant now) {
    again_ = base::kNever;
    for (Face& face : faces_) {
        if (face.running) continue;
        std::string where;
        std::string error;
        face.running = face.open(where, error);
        if (face.running) {
            journal_.write(LogLevel::notice, JournalEvent::face_open,
                           fmt::format("{}: {}", face.name, where));
            continue;
        }
        again_ = now + kBetweenTries;
        if (!std::exchange(face.was_told, true))
            journal_.write(LogLevel::error, JournalEvent::face_missing,
                           fmt::format("{}: {}; tries again", face.name, error));
    }
}

/// The journal is written from any thread.
modbus::Settings PlantPart::telling(modbus::Settings settings) {
    settings.tell = [this](const std::string& axis, const std::string& text) {
        AxisJournal(journal_, axis).write(LogLevel::warning, JournalEvent::master_silent, text);
    };
    return settings;
}

void PlantPart::add_modbus() {
    faces_.push_back({"Modbus", [this](std::string& where, std::string& error) {
                          modbus::TcpServer::Options options = config_.modbus.options;
                          options.settings = telling(options.settings);
                          auto opened = modbus::TcpServer::open(options, axes_);
                          error = opened.error;
                          if (opened.server) where = "listens at " + opened.server->name();
                          return std::shared_ptr<void>(std::move(opened.server));
                      }});
}

void PlantPart::add_modbus_rtu() {
    faces_.push_back({"Modbus RTU", [this](std::string& where, std::string& error) {
                          modbus::RtuServer::Options options = config_.modbus.rtu;
                          options.settings = telling(options.settings);
                          auto opened = modbus::RtuServer::open(options, axes_);
                          error = opened.error;
                          where = "answers on " + config_.modbus.rtu.port;
                          return std::shared_ptr<void>(std::move(opened.server));
                      }});
}

void PlantPart::add_mqtt() {
    faces_.push_back({"MQTT", [this](std::string& where, std::string& error) {
                          mqtt::Options options = config_.mqtt.options;
                          options.orders.folder = config_.state_directory;
                          options.tell = [this](bool is_error, const std::string& text) {
                              journal_.write(is_error ? LogLevel::warning : LogLevel::notice,
                                             is_error ? JournalEvent::mqtt_lost : JournalEvent::mqtt,
                                             "MQTT: " + text);
                          };
                          auto opened = mqtt::Client::open(options, axes_);
                          error = opened.error;
                          where = "goes out to " + config_.mqtt.broker.text;
                          return std::shared_ptr<void>(std::move(opened.client));
                      }});
}

void PlantPart::add_metrics() {
    faces_.push_back({"metrics", [this](std::string& where, std::string& error) {
                          auto opened = metrics::Server::open(
                              {.listen = config_.metrics.listen.text, .program = faces::program_version()},
                              axes_);
                          error = opened.error;
                          if (opened.server) where = "served at " + opened.server->url();
                          return std::shared_ptr<void>(std::move(opened.server));
                      }});
}

}  // namespace nplc::boards
