#include "midi_wiring.h"

#include <fmt/format.h>

namespace nplc::boards {
namespace {

namespace midi = registers::midi;

const char* supply_of(midi::Model model) {
    switch (model) {
        case midi::Model::mac34_1:
            return "22 to 80 V DC";
        case midi::Model::mac34_2:
            return "22 to 160 V DC";
        case midi::Model::mac23:
            break;
    }
    return "";
}

}  // namespace

std::vector<WiringRow> midi_rows(const MotorConfig& motor) {
    const std::string to =
        fmt::format("{}, address {}", midi::facts_of(*motor.midi).name, motor.midi_address);
    if (!motor.is_on_can())
        return {{"motor", motor.port.text, fmt::format("V24 (RS-232), {} baud, 8N1", motor.v24_baud),
                 to + ": serial port"}};
    const std::string rate =
        motor.bitrate ? fmt::format("CAN, {} bit/s", *motor.bitrate) : "CAN, at the rate that the drive has";
    return {{"motor", motor.can.text, rate, to + ": J4, sub-D 9 male"},
            {"", "CAN_L", "", "J4 pin 2"},
            {"", "CAN_H", "", "J4 pin 7"},
            {"", "GND", "", "J4 pin 3"},
            {"", "shield", "", "J4 pin 5"}};
}

std::string midi_notes(const MotorConfig& motor) {
    if (*motor.midi == midi::Model::mac23)
        return "\n  The drive's manual gives no connector pins: go by its label or data sheet. Its line has "
               "RS-232\n"
               "  levels, not RS422 and not 3.3 V.\n";
    std::string text = fmt::format(
        "\n  The drive (manual of the MAC34 CAN, section VIII):\n"
        "    J2, Burndy 3 male: 1 earth, 2 0 V, 3 supply, {}\n"
        "    J5, sub-D 15 male: +/- pins of upper end stop 3/10, lower end stop 4/11, reference 5/12,\n"
        "      safety 6/13 (resets the drive), BUSY output 8/15 (40 V and 50 mA at the most)\n"
        "    Inputs: 3.5 V and 5 mA; in series 1 kOhm from 8 V on, 2.2 kOhm from 15 V to 30 V\n",
        supply_of(*motor.midi));
    if (motor.is_on_can()) return text + "    The bus needs 120 Ohm at both of its ends, and nowhere else.\n";
    return text +
           "    The manuals give no pins of J4 for V24, only for CAN: go by the drive's label. Its line has\n"
           "    RS-232 levels, not RS422 and not 3.3 V.\n";
}

}  // namespace nplc::boards
