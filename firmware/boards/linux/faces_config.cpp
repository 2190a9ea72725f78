#include "faces_config.h"

#include "hal_linux/tcp_listener.h"
#include "motor_config.h"
#include "protocol/modbus_rtu.h"

namespace nplc::boards {

namespace {

void read_rtu(Section& section, ModbusConfig& config) {
    modbus::RtuServer::Options& rtu = config.rtu;
    config.rtu_port = located_text(section, "rtu_port");
    check_port(section, config.rtu_port, true);
    rtu.port = config.rtu_port.text;
    if (rtu.port.starts_with("unix:") || rtu.port.starts_with("tcp:"))
        section.complain("rtu_port",
                         "is no serial port; write such as \"/dev/ttyUSB1\", or \"pty:PATH\" to try it");
    constexpr std::int64_t kSlowest = 1'200;
    constexpr std::int64_t kFastest = 921'600;
    if (const auto baud = section.number("rtu_baud", kSlowest, kFastest))
        rtu.baud = static_cast<std::uint32_t>(*baud);
    if (const auto parity = section.choice("rtu_parity", {"none", "even", "odd"}))
        rtu.parity = static_cast<hal_linux::Parity>(*parity);
    using protocol::modbus::kHighestUnit;
    if (const auto unit = section.number("rtu_unit", protocol::modbus::kLowestUnit, kHighestUnit))
        rtu.unit = static_cast<std::uint8_t>(*unit);
    rtu.rs485 = read_rs485(section);
    rtu.settings = config.options.settings;
}

}  // namespace

ModbusConfig read_modbus(Section& root, Findings& findings) {
    ModbusConfig config;
    Section section(root.table("modbus"), "modbus", findings);
    config.listen = located_text(section, "listen");
    if (config.listen.is_there()) {
        if (const std::string mistake = hal_linux::TcpListener::mistake_in(config.listen.text);
            !mistake.empty())
            section.complain("listen", mistake);
    }
    config.options.listen = config.listen.text;
    if (const auto clients = section.number("clients", 1, 60))
        config.options.clients = static_cast<std::size_t>(*clients);
    modbus::Settings& settings = config.options.settings;
    if (const auto order = section.choice("word_order", {"high_first", "low_first"}))
        settings.low_word_first = *order == 1;
    if (const auto operates = section.flag("operate")) settings.writes = *operates;
    if (const auto what = section.choice("on_silence", {"nothing", "stop", "safe"}))
        settings.on_silence = static_cast<modbus::Silence>(*what);
    if (const auto silence = section.number("silence", 100, 3'600'000))
        settings.silence = base::Milliseconds(*silence);
    read_rtu(section, config);
    section.finish();
    return config;
}

MetricsConfig read_metrics(Section& root, Findings& findings) {
    MetricsConfig config;
    Section section(root.table("metrics"), "metrics", findings);
    config.listen = located_text(section, "listen");
    if (config.listen.is_there()) {
        if (const std::string mistake = metrics::Server::mistake_in(config.listen.text); !mistake.empty())
            section.complain("listen", mistake);
    }
    section.finish();
    return config;
}

void read_control(Section& axis, faces::LoopSettings& settings, Findings& findings) {
    Section section(axis.table("control"), axis.path() + ".control", findings);
    const auto from =
        section.choice("from", {"any", "local", "remote", "IN0", "IN1", "IN2", "IN3", "IN4", "IN5"});
    constexpr std::size_t kFirstInput = 3;
    if (from && *from >= kFirstInput)
        settings.remote_input = static_cast<std::uint8_t>(*from - kFirstInput);
    else if (from)
        settings.control = static_cast<faces::Control>(*from);
    if (const auto silence = section.number("seat_timeout", 1'000, 3'600'000))
        settings.seat_silence = base::Milliseconds(*silence);
    if (const auto period = section.number("motor_period", 0, 60'000))
        settings.motor_period = base::Milliseconds(*period);
    section.finish();
}

faces::Scaling read_scale(Section& axis, Findings& findings) {
    constexpr std::int64_t kMost = 1'000'000'000;
    faces::Scaling scaling;
    Section section(axis.table("scale"), axis.path() + ".scale", findings);
    if (const auto unit = section.text("unit")) scaling.unit = *unit;
    const auto units = section.number("units", 1, kMost);
    const auto revolutions = section.number("revolutions", 1, kMost);
    scaling.per_revolution =
        static_cast<double>(units.value_or(1)) / static_cast<double>(revolutions.value_or(1));
    const bool is_plain = !scaling.unit.empty() && scaling.unit.size() <= 16 &&
                          scaling.unit.find_first_of(",\"\n\r\t") == std::string::npos;
    if (!is_plain) section.complain("unit", "is no unit; write such as \"mm\", 16 characters at the most");
    section.finish();
    return scaling;
}

}  // namespace nplc::boards
