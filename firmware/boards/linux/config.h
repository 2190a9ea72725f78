#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal_linux/gpio.h"
#include "hal_linux/real_time.h"
#include "journal.h"
#include "motor_config.h"
#include "section.h"
#include "store/settings.h"
#include "toml_file.h"

namespace nplc::boards {

template <std::size_t count>
using Lines = std::array<std::optional<hal_linux::GpioLine>, count>;

/// One sequencer with its motor.
struct AxisConfig {
    std::string name;
    LocatedText table;  ///< a file whose table runs while none is stored
    MotorConfig motor;
    LocatedText user_port;        ///< a device, or an endpoint pty:, unix: or tcp:
    unsigned socket_mode = 0660;  ///< of a unix: endpoint
    LocatedText socket_group;
    Lines<6> inputs;
    Lines<4> outputs;
    std::vector<LocatedText> gpio;    ///< every line that is named
    store::SettingValues settings{};  ///< where none are stored
    int line = 0;
};

struct Config {
    std::string state_directory = "/var/lib/nanoplc";
    LogLevel log_level = LogLevel::info;
    hal_linux::RealTime real_time;
    LocatedText watchdog_device;
    int watchdog_seconds = 10;
    bool power_cut_waits = false;  ///< else the settings' autostart decides
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
