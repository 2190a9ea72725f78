#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "faces_config.h"
#include "hal_linux/gpio.h"
#include "hal_linux/real_time.h"
#include "journal.h"
#include "motor_config.h"
#include "mqtt_config.h"
#include "section.h"
#include "store/settings.h"

namespace nplc::boards {

template <std::size_t count>
using Lines = std::array<std::optional<hal_linux::GpioLine>, count>;

/// One sequencer with its motor.
struct AxisConfig {
    std::string name;
    LocatedText table;    ///< a file whose table runs while none is stored
    LocatedText symbols;  ///< a file with a table's names, for people
    MotorConfig motor;
    LocatedText user_port;        ///< a device, or an endpoint pty:, unix: or tcp:
    unsigned socket_mode = 0660;  ///< of a unix: endpoint
    LocatedText socket_group;
    LocatedText password_file;  ///< of a socket
    faces::LoopSettings faces{};
    faces::Scaling scaling{};
    Lines<6> inputs;
    Lines<4> outputs;
    std::vector<LocatedText> gpio;    ///< every line that is named
    store::SettingValues settings{};  ///< where none are stored
    int line = 0;
};

inline constexpr std::size_t kMostPanelSecret = 4096;

/// The panel in a browser; none where `listen` is not there.
struct PanelConfig {
    LocatedText listen;  ///< as it is written
    std::string address;
    std::uint16_t port = 0;
    std::vector<std::string> hosts;
    LocatedText token_file;
    LocatedText password_file;
};

struct Config {
    std::string state_directory = "/var/lib/nanoplc";
    LogLevel log_level = LogLevel::info;
    hal_linux::RealTime real_time;
    LocatedText watchdog_device;
    int watchdog_seconds = 10;
    /// After a power cut in a run; false: the settings' autostart decides. Nothing: it waits where
    /// watchdog_device is one whose driver cannot tell its own resets, which look like power cuts.
    std::optional<bool> power_cut_waits{};
    PanelConfig panel;
    ModbusConfig modbus;
    MetricsConfig metrics;
    MqttConfig mqtt;
    std::vector<AxisConfig> axes;
};

struct ReadConfig {
    Config config;
    Findings findings;  ///< mistakes by line; with one the configuration is not to be used
};
/// Everything that can be said without looking at the machine.
ReadConfig read_config(std::string_view text);

/// What it names and this machine has not.
std::vector<Mistake> missing_devices(const Config& config);

/// The same for two ways to write a GPIO line, as far as its words tell.
std::string line_id(const std::string& where);

}  // namespace nplc::boards
