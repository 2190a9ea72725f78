#pragma once

#include <optional>

#include "mqtt/options.h"
#include "section.h"

namespace nplc::boards {

/// Table `mqtt`. Without `broker` there is no client.
struct MqttConfig {
    LocatedText broker;
    LocatedText user{};
    LocatedText password_file{};
    std::vector<LocatedText> tls_files{};
    mqtt::Options options{};
};
MqttConfig read_mqtt(Section& root, Findings& findings);
/// What goes over the network in clear text, and most likely is not to.
std::optional<Mistake> clear_text(const MqttConfig& config);
/// A user without password and without certificate.
std::optional<Mistake> no_password(const MqttConfig& config);

/// "run", "stop", ...: the commands that can be allowed over MQTT.
std::vector<std::string> mqtt_command_names();

}  // namespace nplc::boards
