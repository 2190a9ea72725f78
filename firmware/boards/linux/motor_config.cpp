#include "motor_config.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace nplc::boards {
namespace {

namespace midi = registers::midi;

constexpr std::array kModels{midi::Model::mac23, midi::Model::mac34_1, midi::Model::mac34_2};
constexpr std::array kJvlKeys{"mactalk_port", "rs485", "rs485_before_ms", "rs485_after_ms"};
constexpr std::array kMidiKeys{"can", "bitrate", "baud", "address"};

class MotorReader {
  public:
    MotorReader(Section& axis, int axis_line, Findings& findings)
        : section_(axis.table("motor"), axis.path() + ".motor", findings), axis_line_(axis_line) {}

    MotorConfig read() {
        const auto kind = section_.choice("kind", {"jvl", "mac23", "mac34-1", "mac34-2"});
        if (kind && *kind != 0) motor_.midi = kModels[*kind - 1];
        if (motor_.midi)
            read_midi();
        else
            read_jvl();
        section_.finish();
        return std::move(motor_);
    }

  private:
    /// Keys that the other kind of motor has: they exist, but not here.
    void refuse(const auto& keys, const std::string& why) {
        for (const char* key : keys) {
            if (section_.any(key) != nullptr) section_.complain(key, why);
        }
    }

    void read_jvl() {
        refuse(kMidiKeys,
               "is for a MIDI drive; write kind = \"mac23\", \"mac34-1\" or \"mac34-2\", or leave it out");
        motor_.port = placed(section_, "port");
        if (!motor_.port.is_there())
            section_.complain(section_.is_there() ? section_.line() : axis_line_, "port",
                              "is missing; name the serial port at the motor's FastMAC line, such as "
                              "\"/dev/serial/by-id/...\"");
        motor_.mactalk_port = placed(section_, "mactalk_port");
        check_port(section_, motor_.port, false);
        check_port(section_, motor_.mactalk_port, false);
        const auto mode = section_.choice("rs485", {"off", "rts_on_send", "rts_after_send"});
        const auto before = section_.number("rs485_before_ms", 0, 1000);
        const auto after = section_.number("rs485_after_ms", 0, 1000);
        if (mode.value_or(0) != 0) {
            motor_.rs485 = {.rts_on_send = mode == 1U,
                            .before_ms = static_cast<std::uint32_t>(before.value_or(0)),
                            .after_ms = static_cast<std::uint32_t>(after.value_or(0))};
        } else if (before || after) {
            section_.complain(before ? "rs485_before_ms" : "rs485_after_ms",
                              "has no meaning while rs485 is \"off\"; write \"rts_on_send\" or leave it out");
        }
    }

    void read_midi() {
        refuse(kJvlKeys, "is for a JVL motor, and this is a MIDI drive; leave it out");
        motor_.port = placed(section_, "port");
        motor_.can = placed(section_, "can");
        check_port(section_, motor_.port, false);
        choose_line();
        read_baud();
        read_can();
        const bool on_can = motor_.is_on_can();
        const auto address = section_.number("address", on_can ? 1 : 0, 127);
        motor_.midi_address = static_cast<std::uint8_t>(address.value_or(on_can ? 1 : 0));
        const bool is_written = section_.any("address") != nullptr;
        motor_.address = {std::to_string(motor_.midi_address),
                          is_written ? section_.line_of("address") : section_.line(),
                          section_.path() + ".address"};
    }

    void choose_line() {
        const bool has_can = midi::facts_of(*motor_.midi).has_can;
        if (motor_.can.is_there() && !has_can)
            section_.complain("can", "a MAC23 has no CAN; name the serial port at its V24 line with port");
        else if (motor_.can.is_there() && motor_.port.is_there())
            section_.complain("can", "port is there too, and a drive has one line; leave one of them out");
        else if (!motor_.can.is_there() && !motor_.port.is_there())
            section_.complain(section_.line(), "port",
                              has_can ? "is missing; name the serial port at the drive's V24 line, such as "
                                        "\"/dev/serial/by-id/...\", or its bus: can = \"can0\""
                                      : "is missing; name the serial port at the drive's V24 line, such as "
                                        "\"/dev/serial/by-id/...\"");
    }

    void read_baud() {
        const auto baud = section_.number("baud", 9'600, 38'400);
        if (!baud) return;
        if (motor_.can.is_there())
            section_.complain("baud", "is a V24 line's; the rate of a bus is bitrate");
        else if (*baud != 9'600 && *baud != 19'200 && *baud != 38'400)
            section_.complain("baud", fmt::format("{} is no speed of these drives; write 9600, 19200 or "
                                                  "38400 (as command 1Bh has set it)",
                                                  *baud));
        else
            motor_.v24_baud = static_cast<std::uint32_t>(*baud);
    }

    void read_can() {
        const auto bitrate = section_.number("bitrate", 10'000, 1'000'000);
        if (bitrate) motor_.bitrate = static_cast<std::uint32_t>(*bitrate);
        if (bitrate && !motor_.can.is_there())
            section_.complain("bitrate", "is a CAN bus's; the speed of a V24 line is baud");
        const std::string& name = motor_.can.text;
        const bool is_name = name.size() < 16 && std::none_of(name.begin(), name.end(), [](unsigned char c) {
                                 return c == '/' || c == ':' || std::isspace(c) != 0;
                             });
        if (!is_name)
            section_.complain("can", fmt::format("{} is no interface; write such as \"can0\"", name));
    }

    Section section_;
    int axis_line_;
    MotorConfig motor_;
};

}  // namespace

std::string MotorConfig::line_in_words() const {
    if (!midi) return port.text;
    return fmt::format("address {} on {}", midi_address, is_on_can() ? can.text : port.text);
}

MotorConfig read_motor(Section& axis, int axis_line, Findings& findings) {
    return MotorReader(axis, axis_line, findings).read();
}

bool is_for_jvl_only(store::Setting setting) {
    using store::Setting;
    return setting == Setting::motor_baud || setting == Setting::motor_is_mac800 ||
           setting == Setting::safe_communication || setting == Setting::old_register_codes ||
           setting == Setting::motor_silence;
}

}  // namespace nplc::boards
