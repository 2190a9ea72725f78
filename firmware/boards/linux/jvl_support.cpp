#include <fmt/format.h>

#include <array>

#include "drive_support.h"

namespace nplc::boards {

const DriveSupport& jvl_support();

namespace {

class JvlSupport final : public DriveSupport {
  public:
    std::span<const char* const> keys() const override {
        static constexpr std::array kKeys{"mactalk_port", "rs485", "rs485_before_ms", "rs485_after_ms"};
        return kKeys;
    }
    void read(MotorConfig& motor, Section& section, int axis_line) const override;
    bool streams_status() const override { return true; }
    std::vector<WiringRow> wiring(const MotorConfig& motor, std::uint32_t baud) const override;
    std::string closing_note() const override;
    std::string loss_in_words(const motor::AnyDriver& driver, const std::string& line) const override;
};

void JvlSupport::read(MotorConfig& motor, Section& section, int axis_line) const {
    motor.port = located_text(section, "port");
    if (!motor.port.is_there())
        section.complain(section.is_there() ? section.line() : axis_line, "port",
                         "is missing; name the serial port at the motor's FastMAC line, such as "
                         "\"/dev/serial/by-id/...\"");
    motor.mactalk_port = located_text(section, "mactalk_port");
    check_port(section, motor.port, false);
    check_port(section, motor.mactalk_port, false);
    motor.rs485 = read_rs485(section);
}

std::vector<WiringRow> JvlSupport::wiring(const MotorConfig& motor, std::uint32_t baud) const {
    std::vector<WiringRow> rows{
        {"motor", motor.port.text,
         fmt::format("RS422, {} baud, 8N1{}", baud, motor.rs485 ? ", RS-485 mode" : ""),
         "to the motor's FastMAC port"}};
    if (motor.mactalk_port.is_there())
        rows.push_back(
            {"motor MacTalk", motor.mactalk_port.text, "19200 baud, 8N1", "to the motor's MacTalk port"});
    return rows;
}

std::string JvlSupport::closing_note() const {
    return "The JVL motor's manual (section 6.1) gives the module six logic inputs, four outputs, a FastMAC "
           "line and a\n"
           "MacTalk line, but no connector pins: go by the labels on the dead module or by its own data "
           "sheet, and\n"
           "measure before you connect. The motor's RS422 pair needs a converter.\n";
}

std::string JvlSupport::loss_in_words(const motor::AnyDriver& driver, const std::string& line) const {
    const auto* motor = driver.get<motor::JvlMotor>();
    if (motor == nullptr || !motor->was_too_late()) return {};
    return fmt::format(
        "the motor's answers on {} come too late, {:.1f} ms after what they answer, and 40 ms are allowed; "
        "most "
        "likely a USB adapter holds them back: set its latency timer to 1 ms "
        "(/sys/bus/usb-serial/devices/ttyUSB0/latency_timer), or use another adapter",
        line, static_cast<double>(motor->echo_time().count()) / 1'000);
}

}  // namespace

const DriveSupport& jvl_support() {
    static constexpr JvlSupport kSupport;
    return kSupport;
}

}  // namespace nplc::boards
