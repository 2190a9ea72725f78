#include "config.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>

#include "drive_support.h"
#include "host/endpoint.h"
#include "panel_config.h"
#include "protocol/modbus_rtu.h"
#include "section.h"

namespace nplc::boards {
namespace {

using store::Setting;
using Kind = TomlValue::Kind;

constexpr std::size_t kMostAxes = 16;
const char* const kLineForms =
    "\"gpiochip0:17\", the line's name, or {line = \"gpiochip0:17\", active_low = true}; \"none\" without "
    "one";

bool is_name(const std::string& name) {
    return !name.empty() && name.size() <= 32 && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::islower(c) != 0 || std::isdigit(c) != 0 || c == '_' || c == '-';
    });
}

/// Octal file permissions, four digits without the higher bits.
bool is_mode(const std::string& text) {
    return text.size() == 4 && text[0] == '0' && text.find_first_not_of("01234567") == std::string::npos;
}

class Reader {
  public:
    ReadConfig read(std::string_view text) {
        const toml_files::File file = toml_files::read_toml(text);
        if (!file.error.empty()) {
            findings_.mistakes.push_back({file.line, "", file.error});
            return std::move(result_);
        }
        Section root(&file.root, "", findings_);
        read_service(root);
        result_.config.panel = read_panel(root, findings_);
        result_.config.modbus = read_modbus(root, findings_);
        result_.config.metrics = read_metrics(root, findings_);
        result_.config.mqtt = read_mqtt(root, findings_);
        read_axes(root);
        root.finish();
        number_units();
        find_doubles();
        find_double_units();
        find_double_ports();
        std::stable_sort(findings_.mistakes.begin(), findings_.mistakes.end(),
                         [](const Mistake& a, const Mistake& b) { return a.line < b.line; });
        return std::move(result_);
    }

  private:
    Section section(const TomlValue* value, const std::string& path) { return {value, path, findings_}; }

    void read_service(Section& root) {
        Section service = section(root.table("service"), "service");
        Config& config = result_.config;
        if (const auto folder = service.text("state_directory")) config.state_directory = *folder;
        if (!config.state_directory.starts_with('/'))
            service.complain("state_directory", "is no absolute path; write such as \"/var/lib/nanoplc\"");
        if (const auto level = service.choice("log_level", {"error", "warning", "notice", "info", "debug"}))
            config.log_level = static_cast<LogLevel>(static_cast<int>(*level) + 3);
        if (const auto priority = service.number("real_time_priority", 0, 99))
            config.real_time.priority = static_cast<int>(*priority);
        if (const auto lock = service.flag("lock_memory")) config.real_time.lock_memory = *lock;
        read_processors(service);
        config.watchdog_device = located_text(service, "watchdog_device");
        if (const auto seconds = service.number("watchdog_seconds", 1, 600))
            config.watchdog_seconds = static_cast<int>(*seconds);
        if (const auto waits = service.choice("after_power_cut", {"start", "wait", "auto"})) {
            if (*waits != 2) config.power_cut_waits = *waits == 1;
        }
        service.finish();
    }

    void read_processors(Section& service) {
        const TomlValue* list = service.list("processors", "a list of numbers: [2, 3]");
        if (list == nullptr) return;
        for (const TomlValue& item : list->items) {
            if (item.kind == Kind::integer && item.integer >= 0 && item.integer < 1024)
                result_.config.real_time.cpus.push_back(static_cast<int>(item.integer));
            else
                service.complain("processors", "holds something else than numbers from 0 to 1023");
        }
    }

    void read_axes(Section& root) {
        const TomlValue* list = root.list("axis", "[[axis]], in double brackets");
        if (list == nullptr || list->items.empty()) {
            if (list != nullptr || root.any("axis") == nullptr)
                root.complain(1, "axis", "there is none; write [[axis]] with a motor for each");
            return;
        }
        if (list->items.size() > kMostAxes)
            root.complain("axis", fmt::format("one process runs {} axes at the most", kMostAxes));
        for (std::size_t i = 0; i < list->items.size(); ++i) {
            if (list->items[i].kind == Kind::table)
                read_axis(list->items[i], i);
            else
                root.complain(list->items[i].line, "axis", "is no table; write [[axis]]");
        }
    }

    void read_axis(const TomlValue& value, std::size_t index) {
        const TomlValue* named = value.find("name");
        const bool has_name = named != nullptr && named->kind == Kind::text;
        const std::string path = fmt::format("axis[{}]", has_name ? named->text : std::to_string(index + 1));
        Section section(&value, path, findings_);
        AxisConfig axis;
        axis.line = value.line;
        axis.name = section.text("name").value_or("");
        if (named == nullptr)
            section.complain("name", "is missing; its store, its log lines and its messages go by it");
        else if (has_name && !is_name(axis.name))
            section.complain("name", "may have small letters, digits, - and _, 32 at the most");
        axis.table = located_text(section, "table");
        axis.symbols = located_text(section, "symbols");
        if (const auto unit =
                section.number("modbus_unit", protocol::modbus::kLowestUnit, protocol::modbus::kHighestUnit))
            axis.modbus_unit = {std::to_string(*unit), section.line_of("modbus_unit"), path + ".modbus_unit"};
        axis.motor = read_motor(section, axis.line, findings_);
        Section user(section.table("user"), path + ".user", findings_);
        axis.user_port = located_text(user, "port");
        check_port(user, axis.user_port, true);
        read_socket(user, axis);
        user.finish();
        read_lines(section, "inputs", "IN", axis.inputs, axis);
        read_lines(section, "outputs", "OUT", axis.outputs, axis);
        read_control(section, axis.faces, findings_);
        axis.scaling = read_scale(section, findings_);
        read_settings(section, axis);
        section.finish();
        result_.config.axes.push_back(std::move(axis));
    }

    void read_socket(Section& user, AxisConfig& axis) {
        axis.socket_group = located_text(user, "socket_group");
        const auto mode = user.text("socket_mode");
        if (mode && !is_mode(*mode))
            user.complain("socket_mode", "is no mode; write four octal digits such as \"0660\"");
        else if (mode)
            axis.socket_mode = static_cast<unsigned>(std::stoul(*mode, nullptr, 8));
        const bool is_socket = host::Endpoint(axis.user_port.text).kind == host::Endpoint::Kind::unix_socket;
        axis.password_file = located_text(user, "password_file");
        if (axis.password_file.is_there() && !host::Endpoint(axis.user_port.text).is_socket())
            user.complain(
                "password_file",
                "is for a port unix:PATH or tcp:ADDRESS:PORT: elsewhere clients cannot be told apart; "
                "leave it out, or name such a port");
        for (const char* key : {"socket_mode", "socket_group"}) {
            if (!is_socket && user.any(key) != nullptr)
                user.complain(key, "is for a port unix:PATH; leave it out, or name such a port");
        }
    }

    template <std::size_t count>
    void read_lines(Section& axis_section, const std::string& key, const std::string& prefix,
                    Lines<count>& lines, AxisConfig& axis) {
        Section section(axis_section.table(key), axis_section.path() + "." + key, findings_);
        for (std::size_t i = 0; i < count; ++i)
            lines[i] = read_line(section, prefix + std::to_string(i), key == "inputs", axis);
        section.finish();
    }

    std::optional<hal_linux::GpioLine> read_line(Section& section, const std::string& key, bool is_input,
                                                 AxisConfig& axis) {
        const TomlValue* value = section.any(key);
        if (value == nullptr) return std::nullopt;
        hal_linux::GpioLine line;
        if (value->kind == Kind::text) {
            line.where = value->text;
        } else if (value->kind == Kind::table) {
            Section inner(value, section.path() + "." + key, findings_);
            line.where = inner.text("line").value_or("");
            line.active_low = inner.flag("active_low").value_or(false);
            if (is_input) {
                const auto bias = inner.choice("bias", {"as_is", "off", "pull_up", "pull_down"});
                line.bias = static_cast<hal_linux::GpioBias>(bias.value_or(0));
            }
            inner.finish();
        }
        if (line.where == "none") return std::nullopt;
        if (line.where.empty()) {
            section.complain(key, fmt::format("names no line; write {}", kLineForms));
            return std::nullopt;
        }
        axis.gpio.push_back({line.where, value->line, section.path() + "." + key});
        return line;
    }

    void read_settings(Section& axis_section, AxisConfig& axis) {
        Section section(axis_section.table("settings"), axis_section.path() + ".settings", findings_);
        set(axis, Setting::motor_kind, axis.motor.model->motor_kind);
        set(axis, Setting::midi_address, axis.motor.drive_address);
        for (const registers::gateway::SettingInfo& info : registers::gateway::all_settings()) {
            if (std::find(kOfTheMotor.begin(), kOfTheMotor.end(), info.id) != kOfTheMotor.end()) continue;
            const std::string key(info.name);
            if (!support_of(axis.motor).has_setting(info.id) && section.any(key) != nullptr) {
                section.complain(key,
                                 fmt::format("is for a JVL motor, and this one is a {} drive; leave it out",
                                             axis.motor.model->family->name()));
                continue;
            }
            if (info.highest == 1) {
                if (const auto on = section.flag(key)) set(axis, info.id, *on ? 1 : 0);
                continue;
            }
            const TomlValue* value = section.any(key);
            if (value != nullptr && info.has_none && value->kind == Kind::text && value->text == "none") {
                set(axis, info.id, registers::gateway::kNone);
                continue;
            }
            const auto number = section.number(key, info.lowest, info.highest);
            if (number && !set(axis, info.id, static_cast<std::uint32_t>(*number)))
                section.complain(key,
                                 fmt::format("{} is no standard speed; write 9600, 19200, ...", *number));
        }
        if (axis.settings.get(Setting::gateway_address) == axis.settings.get(Setting::motor_address))
            section.complain("gateway_address", "is the motor's address too; one of them must change");
        section.finish();
    }

    static bool set(AxisConfig& axis, Setting setting, std::uint32_t value) {
        return axis.settings.set(setting, value).ok();
    }

    void number_units() {
        ModbusConfig& modbus = result_.config.modbus;
        for (const AxisConfig& axis : result_.config.axes)
            modbus.options.settings.units.push_back(
                axis.modbus_unit.is_there() ? static_cast<std::uint8_t>(std::stoi(axis.modbus_unit.text))
                                            : std::uint8_t{0});
        modbus.rtu.settings.units = modbus.options.settings.units;
    }

    /// Units that one axis has and another one gets by its place.
    void find_double_units() {
        const ModbusConfig& modbus = result_.config.modbus;
        if (modbus.listen.is_there()) find_double_units("TCP", 1);
        if (modbus.rtu_port.is_there()) find_double_units("RTU", modbus.rtu.unit);
    }

    void find_double_units(std::string_view face, std::size_t first) {
        const std::vector<AxisConfig>& axes = result_.config.axes;
        for (std::size_t i = 0; i < axes.size(); ++i) {
            if (axes[i].modbus_unit.is_there()) continue;
            const std::string unit = std::to_string(first + i);
            if (first + i > protocol::modbus::kHighestUnit)
                findings_.mistakes.push_back(
                    {result_.config.modbus.rtu_port.line, "modbus.rtu_unit",
                     fmt::format("leaves no address up to 247 for axis {}; write a lower one, or its "
                                 "modbus_unit",
                                 axes[i].name)});
            const auto same = std::find_if(axes.begin(), axes.end(), [&unit](const AxisConfig& other) {
                return other.modbus_unit.text == unit;
            });
            if (same == axes.end()) continue;
            findings_.mistakes.push_back(
                {same->modbus_unit.line, same->modbus_unit.key,
                 fmt::format("{} is used twice: axis {} in line {} has it on Modbus {} by its place; write a "
                             "modbus_unit there, too",
                             unit, axes[i].name, axes[i].line, face)});
        }
    }

    /// Finds values that must be unique over all axes.
    void find_doubles() {
        std::map<std::string, LocatedText> seen;
        const auto take = [&](const std::string& what, const LocatedText& place) {
            const auto [first, is_new] = seen.emplace(what, place);
            if (is_new) return;
            const bool is_line = place.key.ends_with(".motor.port");
            findings_.mistakes.push_back(
                {place.line, place.key,
                 fmt::format("{} is used twice: {} in line {} has it already{}", place.text,
                             first->second.key, first->second.line,
                             is_line ? "; a motor's serial line is its axis's alone (a CAN bus can be shared)"
                                     : "")});
        };
        const ModbusConfig& modbus = result_.config.modbus;
        if (modbus.rtu_port.is_there()) take("port " + port_id(modbus.rtu_port.text), modbus.rtu_port);
        for (const AxisConfig& axis : result_.config.axes) {
            if (!axis.name.empty()) take("name " + axis.name, {axis.name, axis.line, "axis.name"});
            if (axis.modbus_unit.is_there()) take("unit " + axis.modbus_unit.text, axis.modbus_unit);
            for (const LocatedText& line : axis.gpio) take("line " + line_id(line.text), line);
            for (const LocatedText& port : {axis.motor.port, axis.motor.mactalk_port, axis.user_port}) {
                if (port.is_there() && !port.text.starts_with("tcp:"))
                    take("port " + port_id(port.text), port);
            }
            if (axis.motor.is_on_can())
                take("on " + axis.motor.line_in_words(),
                     {axis.motor.line_in_words(), axis.motor.address.line, axis.motor.address.key});
        }
    }

    /// "tcp:ADDRESS:PORT" or "ADDRESS:PORT"; port 0 is any free one.
    static bool share_a_port(std::string_view one, std::string_view other) {
        const auto split = [](std::string_view text) {
            if (text.starts_with("tcp:")) text.remove_prefix(4);
            const std::size_t colon = std::min(text.rfind(':'), text.size());
            return std::pair(text.substr(0, colon), text.substr(colon));
        };
        const auto is_all = [](std::string_view address) {
            return address == "0.0.0.0" || address == "[::]" || address == "::";
        };
        const auto [address, port] = split(one);
        const auto [other_address, other_port] = split(other);
        if (port != other_port || port.size() < 2 || port == ":0") return false;
        return address == other_address || is_all(address) || is_all(other_address);
    }

    /// Two that listen at one port of this machine, at one address or one of them at all.
    void find_double_ports() {
        const std::vector<LocatedText> listeners = result_.config.tcp_places();
        for (auto one = listeners.begin(); one != listeners.end(); ++one) {
            const auto first = std::find_if(listeners.begin(), one, [one](const LocatedText& other) {
                return share_a_port(other.text, one->text);
            });
            if (first == one) continue;
            findings_.mistakes.push_back(
                {one->line, one->key,
                 fmt::format("{} is used twice: {} in line {} listens at {}; write another port", one->text,
                             first->key, first->line, first->text)});
        }
    }

    /// Links such as those in /dev/serial resolve to one device.
    static std::string port_id(const std::string& port) {
        std::error_code error;
        const auto path = std::filesystem::canonical(port, error);
        return error ? port : path.string();
    }

    ReadConfig result_;
    Findings& findings_ = result_.findings;
};

}  // namespace

std::vector<LocatedText> Config::tcp_places() const {
    std::vector<LocatedText> places;
    for (const LocatedText& place : {panel.listen, modbus.listen, metrics.listen}) {
        if (place.is_there()) places.push_back(place);
    }
    for (const AxisConfig& axis : axes) {
        if (axis.user_port.text.starts_with("tcp:")) places.push_back(axis.user_port);
    }
    return places;
}

std::string line_id(const std::string& where) {
    return where.starts_with("/dev/") ? where.substr(5) : where;
}

ReadConfig read_config(std::string_view text) {
    return Reader().read(text);
}

}  // namespace nplc::boards
