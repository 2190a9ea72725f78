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
    LocatedText symbols;  ///< a symbol file with the table's names
    MotorConfig motor;
    LocatedText user_port;        ///< a device, or an endpoint pty:, unix: or tcp:
    unsigned socket_mode = 0660;  ///< of a unix: endpoint
    LocatedText socket_group;
    LocatedText password_file;  ///< of a socket
    faces::LoopSettings faces{};
    faces::Scaling scaling{};
    Lines<6> inputs;
    Lines<4> outputs;
    std::vector<LocatedText> gpio;    ///< every named line
    store::SettingValues settings{};  ///< used while none are stored
    LocatedText modbus_unit;          ///< a number; without one its place among the axes gives it
    int line = 0;
};

inline constexpr std::size_t kMostPanelSecret = 4096;

/// The browser panel; off without `listen`.
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
    /// After a power cut during a run: whether the axis waits for the operator. Unset: the axis waits if the
    /// driver of watchdog_device cannot report its own resets, which then look like power cuts.
    std::optional<bool> power_cut_waits{};
    PanelConfig panel;
    ModbusConfig modbus;
    MetricsConfig metrics;
    MqttConfig mqtt;
    std::vector<AxisConfig> axes;

    /// Where TCP ports are listened at: "tcp:ADDRESS:PORT" or "ADDRESS:PORT".
    std::vector<LocatedText> tcp_places() const;
};

struct ReadConfig {
    Config config;
    Findings findings;  ///< mistakes by line; with any, the configuration must not be used
};
/// All checks that need no access to the machine.
ReadConfig read_config(std::string_view text);

/// Devices in the configuration that this machine does not have.
std::vector<Mistake> missing_devices(const Config& config);

/// Equal for two spellings of one GPIO line, as far as the text shows it.
std::string line_id(const std::string& where);

}  // namespace nplc::boards
