// Bits, modes and pointers of MAC50, MAC95, MAC140 and MAC141 (001 §3.2).
#include "text_tables.h"
#include "values.h"

namespace nplc::registers {
namespace {

// clang-format off
constexpr Field kFields[] = {
    {1, 0, 4, "MINOR", "second part of the version: 4Eh is 4.14"},
    {1, 4, 12, "MAJOR", "first part of the version"},
    {2, 0, 16, "MODE", "the mode the motor is in, or shall go to", kSmallModes},

    {35, 0, 1, "I2T_ERR", "overload: I2T passed I2TLIM. Stops the motor; reset before it moves again"},
    {35, 1, 1, "FLW_ERR", "FLWERR passed FLWERRMAX. Stops the motor; reset before it moves again"},
    {35, 2, 1, "FNC_ERR", "FNCERR passed FNCERRMAX. Stops the motor; reset before it moves again"},
    {35, 3, 1, "UIT_ERR", "too much braking energy: UIT passed UITLIM. Stops the motor; reset before it moves again"},
    {35, 4, 1, "IN_POS", "in position, or at velocity (INPOSWIN, INPOSCNT)"},
    {35, 5, 1, "ACC_FLAG", "the profile is speeding up"},
    {35, 6, 1, "DEC_FLAG", "the profile is slowing down"},
    {35, 7, 1, "PLIM_ERR", "P_IST is outside MIN_P_IST .. MAX_P_IST. Stops the motor"},
    {35, 8, 1, "FRAME_ERR_TX", "the motor saw a framing error on the FastMAC line"},
    {35, 9, 1, "RELPOSPSOLL", "a selected position is added to P_SOLL instead of replacing it"},
    {35, 10, 1, "RELPOSPFNC", "a selected position, times 16, is taken off P_FNC: endless relative moves"},
    {35, 11, 1, "IX_ERR", "a phase current was at the end of its measuring range"},
    {35, 12, 1, "UV_ERR", "undervoltage, as an error (UV_HANDLE)"},
    {35, 13, 1, "UV_DETECT", "the supply is, or lately was, below U_MIN_SUP"},
    {35, 14, 1, "DIS_P_LIM", "position limits are not watched, as in a homing beyond them"},

    {36, 0, 2, "USERINTF", "what the user interface's pins are for; taken over at reset", kUserInterfaces},
    {36, 2, 1, "PULSEDIR", "pulse input: 1 pulse and direction, 0 quadrature; taken over at reset"},
    {36, 3, 1, "INPSIGN", "turns the direction of the pulse input round; taken over at reset"},
    {36, 4, 1, "HICLK", "filter of the pulse input: 1 up to 1 MHz, 0 up to 31 kHz; taken over at reset"},
    {36, 5, 1, "HALL_INT", "corrects the rotor angle at every change of the hall elements, not only the first after power-up"},
    {36, 6, 1, "RECORDBIT", "starts recording; the motor clears it when the buffer is full"},
    {36, 7, 1, "REWINDBIT", "back to the start of the record; the motor clears it when done"},
    {36, 8, 1, "RECINNERBIT", "records at 1 the current loop's rate (7812.5 Hz), at 0 the position loop's (520.8 Hz)"},
    {36, 9, 1, "AUTO_RESYNC", "in INIT_MODE P_FNC follows P_IST"},
    {36, 10, 1, "MAN_RESYNC", "takes P_NEW over into P_SOLL, P_IST and P_FNC; the motor clears it when done"},
    {36, 11, 1, "INDEX_HOME", "rounds the home position to the nearest of the two hall marks of a turn"},
    {36, 12, 1, "REL_RESYNC", "MAN_RESYNC adds P_NEW instead of setting it"},
    {36, 13, 3, "HALL", "state of the three hall elements (the manual gives the bits no name)"},

    {37, 0, 16, "MODE", "mode after power-up or after homing", kSmallModes},
    {42, 0, 8, "AT_POWER_UP", "homing at power-up (the manual gives the bytes no name)", kHomingModes},
    {42, 8, 8, "BY_COMMAND", "homing that FastMAC command 10h starts", kHomingModes},
    {43, 0, 16, "POINTER", "which position to use", kToP},
    {44, 0, 16, "POINTER", "which velocity to use", kToV},
    {45, 0, 16, "POINTER", "which acceleration to use", kToA},
    {46, 0, 16, "POINTER", "which torque to use", kToT},
    {47, 0, 16, "POINTER", "which load factor to use", kToL},
    {48, 0, 16, "POINTER", "which window to use", kToZ},

    {160, 0, 1, "SET_UV_ERR", "undervoltage sets UV_ERR"},
    {160, 1, 1, "UV_GO_PASSIVE", "undervoltage leads to INIT_MODE"},
    {160, 3, 1, "UV_VSOLL0", "undervoltage sets V_SOLL to 0"},
};
// clang-format on

}  // namespace

std::span<const Field> small_fields() {
    return kFields;
}

}  // namespace nplc::registers
