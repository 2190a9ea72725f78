// Devices in the configuration that this machine does not have.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <net/if_arp.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>

#include "broker/session.h"
#include "config.h"
#include "hal_linux/group.h"
#include "hal_linux/tcp_listener.h"
#include "registers/gateway.h"
#include "seat/secret.h"

namespace nplc::boards {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_in(const std::string& folder, const std::vector<std::string>& prefixes) {
    std::vector<std::string> found;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        const bool fits =
            std::any_of(prefixes.begin(), prefixes.end(), [&](const auto& p) { return name.starts_with(p); });
        if (fits) found.push_back(entry.path().string());
    }
    std::sort(found.begin(), found.end());
    return found;
}

std::string serial_ports() {
    auto ports = files_in("/dev/serial/by-id", {""});
    const auto plain = files_in("/dev", {"ttyUSB", "ttyACM", "ttyAMA", "ttyS", "serial"});
    ports.insert(ports.end(), plain.begin(), plain.end());
    constexpr std::size_t kMost = 8;
    if (ports.size() > kMost) ports.resize(kMost);
    return ports.empty() ? "this machine has no serial port at all"
                         : fmt::format("there are {}", fmt::join(ports, ", "));
}

bool is_character_device(const std::string& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 && S_ISCHR(status.st_mode);
}

void check_serial(const LocatedText& port, std::vector<Mistake>& missing) {
    if (!port.is_there() || is_endpoint(port.text)) return;
    std::error_code error;
    if (!fs::exists(port.text, error))
        missing.push_back({port.line, port.key,
                           fmt::format("there is no {}; plug the adapter in, or name another: {}", port.text,
                                       serial_ports())});
    else if (!is_character_device(port.text))
        missing.push_back(
            {port.line, port.key, fmt::format("{} is no device; {}", port.text, serial_ports())});
    else if (::access(port.text.c_str(), R_OK | W_OK) != 0)
        missing.push_back(
            {port.line, port.key,
             fmt::format("you may not use {}; join the group dialout, or run as the service does",
                         port.text)});
}

/// An interface that is down is no mistake: it may come up later.
void check_can(const LocatedText& can, std::vector<Mistake>& missing) {
    if (!can.is_there()) return;
    const std::string path = "/sys/class/net/" + can.text;
    std::error_code error;
    int type = 0;
    std::ifstream(path + "/type") >> type;
    if (!fs::exists(path, error))
        missing.push_back({can.line, can.key,
                           fmt::format("there is no interface {}; set it up, or name another: `ip -o link | "
                                       "grep link/can` lists them",
                                       can.text)});
    else if (type != ARPHRD_CAN)
        missing.push_back({can.line, can.key,
                           fmt::format("{} is no interface for CAN; `ip -o link | grep link/can` lists "
                                       "those",
                                       can.text)});
}

void check_group(const LocatedText& group, std::vector<Mistake>& missing) {
    if (group.is_there() && !hal_linux::group_number(group.text))
        missing.push_back(
            {group.line, group.key, fmt::format("there is no group {}; name one of /etc/group", group.text)});
}

void check_secret(const LocatedText& file, std::size_t most, std::vector<Mistake>& missing) {
    if (!file.is_there()) return;
    if (const std::string error = faces::read_secret(file.text, most).error; !error.empty())
        missing.push_back({file.line, file.key, error});
}

bool may_read(const LocatedText& file, std::vector<Mistake>& missing) {
    std::error_code error;
    const bool is_file = fs::exists(file.text, error) && !fs::is_directory(file.text, error);
    if (is_file && ::access(file.text.c_str(), R_OK) == 0) return true;
    missing.push_back(
        {file.line, file.key,
         is_file ? fmt::format("you may not read {}; run as the service does, which must be let read it",
                               file.text)
                 : fmt::format("there is no file {}; put it there, or name another", file.text)});
    return false;
}

/// The address alone: its port may be the running service's own.
void check_place(const LocatedText& place, std::vector<Mistake>& missing) {
    using hal_linux::TcpListener;
    const std::string where = (place.text.starts_with("tcp:") ? "" : "tcp:") + place.text;
    if (TcpListener::mistake_in(where).empty() && !TcpListener::has_address(where))
        missing.push_back({place.line, place.key,
                           fmt::format("{}: {}", place.text, hal_linux::listen_remedy(EADDRNOTAVAIL))});
}

/// Only of a client that is switched on.
void check_mqtt(const MqttConfig& mqtt, std::vector<Mistake>& missing) {
    if (!mqtt.broker.is_there()) return;
    for (const broker::Mistake& mistake : broker::mistakes_in_files(mqtt.options)) {
        const auto file = std::find_if(
            mqtt.tls_files.begin(), mqtt.tls_files.end(),
            [&mistake](const LocatedText& one) { return one.key == fmt::format("mqtt.{}", mistake.key); });
        if (file != mqtt.tls_files.end() && may_read(*file, missing))
            missing.push_back({file->line, file->key, mistake.text});
    }
    const LocatedText& file = mqtt.password_file;
    if (!file.is_there() || !may_read(file, missing)) return;
    std::string password;
    std::getline(std::ifstream(file.text), password);
    if (password.empty() || password == "\r")
        missing.push_back({file.line, file.key,
                           fmt::format("the first line of {} is empty; it must be the password", file.text)});
}

/// One line with two names is detected only here: only the kernel can resolve a name.
class LineCheck {
  public:
    explicit LineCheck(std::vector<Mistake>& missing) : missing_(missing) {}

    void check(const LocatedText& line) {
        const hal_linux::FoundLine found = hal_linux::find_line(line.text);
        if (!found.problem.empty())
            return complain(line, has_chips_ ? found.problem : problem_without_chips(found.problem));
        const auto [first, is_new] = seen_.emplace(found.place, line);
        if (is_new || line_id(first->second.text) == line_id(line.text)) return;
        complain(line,
                 fmt::format("{} is {}, which {} in line {} has already, as {}; each line once", line.text,
                             found.place, first->second.key, first->second.line, first->second.text));
    }

  private:
    static std::string problem_without_chips(const std::string& problem) {
        return problem.substr(0, problem.find(';')) +
               "; this machine has no GPIO chip at all, write \"none\" to do without";
    }

    void complain(const LocatedText& line, const std::string& text) {
        missing_.push_back({line.line, line.key, text});
    }

    std::vector<Mistake>& missing_;
    std::map<std::string, LocatedText> seen_;
    const bool has_chips_ = !files_in("/dev", {"gpiochip"}).empty();
};

}  // namespace

std::vector<Mistake> missing_devices(const Config& config) {
    std::vector<Mistake> missing;
    LineCheck lines(missing);
    for (const AxisConfig& axis : config.axes) {
        for (const LocatedText& port : {axis.motor.port, axis.motor.mactalk_port, axis.user_port})
            check_serial(port, missing);
        check_can(axis.motor.can, missing);
        check_group(axis.socket_group, missing);
        check_secret(axis.password_file, registers::gateway::kMostPassword, missing);
        for (const LocatedText& line : axis.gpio) lines.check(line);
    }
    check_serial(config.modbus.rtu_port, missing);
    for (const LocatedText& file : {config.panel.token_file, config.panel.password_file})
        check_secret(file, kMostPanelSecret, missing);
    for (const LocatedText& place : config.tcp_places()) check_place(place, missing);
    check_mqtt(config.mqtt, missing);
    if (const LocatedText& device = config.watchdog_device;
        device.is_there() && !is_character_device(device.text))
        missing.push_back({device.line, device.key,
                           fmt::format("there is no {}; leave it out on a board without one", device.text)});
    return missing;
}

}  // namespace nplc::boards
