#include "macreg/mactalk_names.h"

#include <algorithm>
#include <iterator>

namespace nplc::macreg {

namespace {

struct Name {
    std::string_view reg;
    std::string_view name;
};

// By the names of both maps. 28 and 30 are labelled the wrong way round in 004: by what they do.
constexpr Name kNames[] = {
    {"P_SOLL", "Position"},
    {"V_SOLL", "Max velocity"},
    {"A_SOLL", "Acceleration"},
    {"T_SOLL", "Torque"},
    {"P_IST", "Actual position"},
    {"V_IST_16", "Actual velocity"},
    {"V_IST", "Actual velocity"},
    {"KVOUT", "Load"},
    {"GEARF1", "Input"},
    {"GEARF_1", "Input"},
    {"GEARF2", "Output"},
    {"GEARF_2", "Output"},
    {"I2T", "Motor load (mean)"},
    {"UIT", "Regenerative load"},
    {"FLWERR", "Follow error"},
    {"U_24V", "Logic supply"},
    {"FLWERRMAX", "EH:Follow error"},
    {"UV_HANDLE", "Set error bit, Go to passive, Set velocity to 0"},
    {"FNCERR", "Function error"},
    {"FNCERRMAX", "EH:Function error"},
    {"MIN_P_IST", "Position limit min"},
    {"MAX_P_IST", "Position limit max"},
    {"DEGC", "Temperature"},
    {"ACC_EMERG", "Error acceleration"},
    {"INPOSWIN", "In pos. window / At vel. window"},
    {"INPOSCNT", "In pos. count"},
    {"STARTMODE", "Mode"},
    {"START_MODE", "Mode"},
    {"P_HOME", "Zero search position"},
    {"V_HOME", "Zero search speed"},
    {"T_HOME", "Zero search torque"},
    {"HOME_MODE", "Zero search mode"},
    {"V_EXT", "Velocity of input"},
    {"VF_OUT", "Actual motor torque"},
    {"ANINP", "Analogue input"},
    {"ANINP_OFFSET", "Analogue input offset"},
    {"U_BUS", "Bus voltage"},
    {"U_SUPPLY", "Bus voltage"},
    {"MYADDR", "Motor address"},
    {"MY_ADDR", "Motor address"},
};
// POS0 to POS7, VEL0 ... ZERO3 of a MAC800 are P1 to P8, V1 ... Z4.
constexpr Name kNumbered[] = {{"POS", "P"}, {"VEL", "V"},  {"ACC", "A"},
                              {"TQ", "T"},  {"LOAD", "L"}, {"ZERO", "Z"}};
constexpr std::string_view kOneToEight[] = {"P1", "P2", "P3", "P4", "P5", "P6", "P7", "P8", "V1", "V2", "V3",
                                            "V4", "V5", "V6", "V7", "V8", "A1", "A2", "A3", "A4", "T1", "T2",
                                            "T3", "T4", "L1", "L2", "L3", "L4", "Z1", "Z2", "Z3", "Z4"};

std::string_view numbered(std::string_view reg) {
    for (const Name& one : kNumbered) {
        if (reg.size() != one.reg.size() + 1 || !reg.starts_with(one.reg)) continue;
        const char digit = static_cast<char>(reg.back() + 1);
        const auto found =
            std::find_if(std::begin(kOneToEight), std::end(kOneToEight),
                         [&](std::string_view name) { return name[0] == one.name[0] && name[1] == digit; });
        if (found != std::end(kOneToEight)) return *found;
    }
    return {};
}

}  // namespace

std::string_view mactalk_name(const registers::Register& reg) {
    const auto found = std::find_if(std::begin(kNames), std::end(kNames),
                                    [&](const Name& one) { return one.reg == reg.name; });
    return found != std::end(kNames) ? found->name : numbered(reg.name);
}

}  // namespace nplc::macreg
