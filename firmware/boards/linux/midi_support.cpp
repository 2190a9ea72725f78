#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "drive_support.h"
#include "registers/midi.h"

namespace nplc::boards {

const DriveSupport& midi_support();

namespace {

namespace midi = registers::midi;
using motor::MidiFault;

/// Warnings that do not come and go with every braking (000 §VI 21h).
constexpr std::uint32_t kWarnings = midi::kUnderVoltage | midi::kOverVoltageKept;

/// With the pins of the line as far as the manuals give them (003 §VIII).
class MidiSupport final : public DriveSupport {
  public:
    std::span<const char* const> keys() const override {
        static constexpr std::array kKeys{"can", "bitrate", "baud", "address"};
        return kKeys;
    }
    void read(MotorConfig& motor, Section& section, int axis_line) const override;
    bool has_setting(store::Setting setting) const override {
        using store::Setting;
        return setting != Setting::motor_baud && setting != Setting::motor_is_mac800 &&
               setting != Setting::safe_communication && setting != Setting::old_register_codes &&
               setting != Setting::motor_silence;
    }
    std::vector<WiringRow> wiring(const MotorConfig& motor, std::uint32_t baud) const override;
    std::string notes(const MotorConfig& motor) const override;
    std::string silence_in_words(const motor::AnyDriver& driver, const std::string& line) const override;
    std::uint8_t fault(const motor::AnyDriver& driver) const override {
        return static_cast<std::uint8_t>(motor_of(driver).fault());
    }
    std::optional<LogMessage> fault_in_words(const motor::AnyDriver& driver) const override;
    std::uint32_t warnings(const motor::AnyDriver& driver) const override {
        return motor_of(driver).drive_status() & kWarnings;
    }
    std::string warning_in_words(std::uint32_t bit) const override;

  private:
    static const motor::MidiMotor& motor_of(const motor::AnyDriver& driver) {
        return *driver.get<motor::MidiMotor>();
    }
};

const char* supply_of(const MotorConfig& motor) {
    switch (static_cast<midi::Model>(motor.model->index)) {
        case midi::Model::mac34_1:
            return "22 to 80 V DC";
        case midi::Model::mac34_2:
            return "22 to 160 V DC";
        case midi::Model::mac23:
            break;
    }
    return "";
}

void choose_line(const MotorConfig& motor, Section& section) {
    const bool has_can = motor.model->has_can;
    if (motor.can.is_there() && !has_can)
        section.complain("can", "a MAC23 has no CAN; name the serial port at its V24 line with port");
    else if (motor.can.is_there() && motor.port.is_there())
        section.complain("can", "port is there too, and a drive has one line; leave one of them out");
    else if (!motor.can.is_there() && !motor.port.is_there())
        section.complain(section.line(), "port",
                         has_can ? "is missing; name the serial port at the drive's V24 line, such as "
                                   "\"/dev/serial/by-id/...\", or its bus: can = \"can0\""
                                 : "is missing; name the serial port at the drive's V24 line, such as "
                                   "\"/dev/serial/by-id/...\"");
}

void read_baud(MotorConfig& motor, Section& section) {
    motor.baud = midi::kFactoryBaud;
    const auto baud = section.number("baud", 9'600, 38'400);
    if (!baud) return;
    if (motor.can.is_there())
        section.complain("baud", "is a V24 line's; the rate of a bus is bitrate");
    else if (*baud != 9'600 && *baud != 19'200 && *baud != 38'400)
        section.complain("baud", fmt::format("{} is no speed of these drives; write 9600, 19200 or "
                                             "38400 (as command 1Bh has set it)",
                                             *baud));
    else
        motor.baud = static_cast<std::uint32_t>(*baud);
}

void read_can(MotorConfig& motor, Section& section) {
    const auto bitrate = section.number("bitrate", 10'000, 1'000'000);
    if (bitrate) motor.bitrate = static_cast<std::uint32_t>(*bitrate);
    if (bitrate && !motor.can.is_there())
        section.complain("bitrate", "is a CAN bus's; the speed of a V24 line is baud");
    const std::string& name = motor.can.text;
    const bool is_name = name.size() < 16 && std::none_of(name.begin(), name.end(), [](unsigned char c) {
                             return c == '/' || c == ':' || std::isspace(c) != 0;
                         });
    if (!is_name) section.complain("can", fmt::format("{} is no interface; write such as \"can0\"", name));
}

void MidiSupport::read(MotorConfig& motor, Section& section, int) const {
    motor.port = located_text(section, "port");
    motor.can = located_text(section, "can");
    check_port(section, motor.port, false);
    choose_line(motor, section);
    read_baud(motor, section);
    read_can(motor, section);
    const bool on_can = motor.is_on_can();
    const auto address = section.number("address", on_can ? 1 : 0, 127);
    motor.drive_address = static_cast<std::uint8_t>(address.value_or(on_can ? 1 : 0));
    const bool is_written = section.any("address") != nullptr;
    motor.address = {std::to_string(motor.drive_address),
                     is_written ? section.line_of("address") : section.line(), section.path() + ".address"};
}

std::vector<WiringRow> MidiSupport::wiring(const MotorConfig& motor, std::uint32_t) const {
    const std::string to = fmt::format("{}, address {}", motor.model->name, motor.drive_address);
    if (!motor.is_on_can())
        return {{"motor", motor.port.text, fmt::format("V24 (RS-232), {} baud, 8N1", *motor.baud),
                 to + ": serial port"}};
    const std::string rate =
        motor.bitrate ? fmt::format("CAN, {} bit/s", *motor.bitrate) : "CAN, at the rate that the drive has";
    return {{"motor", motor.can.text, rate, to + ": J4, sub-D 9 male"},
            {"", "CAN_L", "", "J4 pin 2"},
            {"", "CAN_H", "", "J4 pin 7"},
            {"", "GND", "", "J4 pin 3"},
            {"", "shield", "", "J4 pin 5"}};
}

std::string MidiSupport::notes(const MotorConfig& motor) const {
    if (!motor.model->has_can)
        return "\n  The drive's manual gives no connector pins: go by its label or data sheet. Its line has "
               "RS-232\n"
               "  levels, not RS422 and not 3.3 V.\n";
    std::string text = fmt::format(
        "\n  The drive (manual of the MAC34 CAN, section VIII):\n"
        "    J2, Burndy 3 male: 1 earth, 2 0 V, 3 supply, {}\n"
        "    J5, sub-D 15 male: +/- pins of upper end stop 3/10, lower end stop 4/11, reference 5/12,\n"
        "      safety 6/13 (resets the drive), BUSY output 8/15 (40 V and 50 mA at the most)\n"
        "    Inputs: 3.5 V and 5 mA; in series 1 kOhm from 8 V on, 2.2 kOhm from 15 V to 30 V\n",
        supply_of(motor));
    if (motor.is_on_can()) return text + "    The bus needs 120 Ohm at both of its ends, and nowhere else.\n";
    return text +
           "    The manuals give no pins of J4 for V24, only for CAN: go by the drive's label. Its line has\n"
           "    RS-232 levels, not RS422 and not 3.3 V.\n";
}

std::optional<LogMessage> MidiSupport::fault_in_words(const motor::AnyDriver& driver) const {
    const motor::MidiMotor& motor = motor_of(driver);
    const MidiFault fault = motor.fault();
    if (fault == MidiFault::none || fault == MidiFault::link_lost) return std::nullopt;
    std::string text = fmt::format("ERROR: {}", motor::text_of(fault));
    if (fault == MidiFault::bad_value) text += fmt::format(": {}", midi::text_of(motor.limitation()));
    const std::uint32_t shown = fault == MidiFault::tripped ? midi::kTrips : ~midi::kTrips;
    if (fault != MidiFault::tripped && fault != MidiFault::end_stop) return LogMessage{LogLevel::error, text};
    std::string bits;
    for (const midi::Bit& bit : midi::status_bits()) {
        if ((bit.mask & motor.drive_status() & shown) == 0) continue;
        bits += (bits.empty() ? "" : ", ") + std::string(bit.text);
    }
    if (!bits.empty()) text += fmt::format(" ({})", bits);
    return LogMessage{LogLevel::error, text};
}

std::string MidiSupport::silence_in_words(const motor::AnyDriver& driver, const std::string& line) const {
    const motor::MidiOutcome& probe = motor_of(driver).probe();
    if (motor_of(driver).fault() == MidiFault::several) return "no link to the motor on " + line;
    if (probe.kind == motor::MidiOutcome::Kind::refused)
        return fmt::format(
            "something answers to {} and refuses to tell its status, which no MIDI drive does; is it another "
            "kind of device?",
            line);
    if (probe.damaged)
        return fmt::format(
            "what comes from {} cannot be read; is the speed right, is there noise, or do two drives have "
            "this address?",
            line);
    return {};
}

std::string MidiSupport::warning_in_words(std::uint32_t bit) const {
    for (const midi::Bit& known : midi::status_bits()) {
        if (known.mask == bit) return std::string(known.text);
    }
    return {};
}

}  // namespace

const DriveSupport& midi_support() {
    static constexpr MidiSupport kSupport;
    return kSupport;
}

}  // namespace nplc::boards
