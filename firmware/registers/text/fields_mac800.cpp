// Bits, modes and pointers of the MAC800 (004). If 004 only lists a register, the meanings are from 001.
#include "text_tables.h"
#include "values.h"

namespace nplc::registers {
namespace {

// clang-format off
constexpr Field kFields[] = {
    {1, 0, 6, "MINOR", "second part of the version"},
    {1, 6, 7, "MAJOR", "first part of the version"},
    {1, 13, 1, "BETA", "a test version"},
    {1, 14, 1, "RESERVED", "no meaning"},
    {1, 15, 1, "LARGE", "a MAC400 or MAC800"},
    {2, 0, 32, "MODE", "the mode the motor is in, or shall go to", kMac800Modes},

    {23, 0, 1, "SET_UV_ERR", "undervoltage sets UV_ERR"},
    {23, 1, 1, "UV_GO_PASSIVE", "undervoltage leads to the passive mode"},
    {23, 2, 1, "UV_VSOLL0", "undervoltage sets V_SOLL to 0"},

    {35, 0, 1, "I2T_ERR", "overload: I2T passed I2TLIM"},
    {35, 1, 1, "FLW_ERR", "FLWERR passed FLWERRMAX"},
    {35, 2, 1, "FNC_ERR", "FNCERR passed FNCERRMAX"},
    {35, 3, 1, "UIT_ERR", "too much braking energy: UIT passed UITLIM"},
    {35, 4, 1, "IN_POS", "in position, or at velocity (INPOSWIN, INPOSCNT)"},
    {35, 5, 1, "ACC_FLAG", "speeding up"},
    {35, 6, 1, "DEC_FLAG", "slowing down"},
    {35, 7, 1, "PLIM_ERR", "P_IST is outside MIN_P_IST .. MAX_P_IST"},
    {35, 8, 1, "DEGC_ERR", "too hot: DEGC passed DEGCMAX"},
    {35, 9, 1, "UV_ERR", "undervoltage, as an error (UV_HANDLE)"},
    {35, 10, 1, "UV_DETECT", "the bus voltage is low"},
    {35, 11, 1, "OV_ERR", "bus voltage above 450 V"},
    {35, 12, 1, "IPEAK_ERR", "motor current too high"},
    {35, 13, 1, "SPEED_ERR", "faster than 3600 rpm"},
    {35, 14, 1, "DIS_P_LIM", "position limits are not watched"},
    {35, 15, 1, "INDEX_ERR", "fault of the encoder"},
    {35, 16, 1, "OLD_FILT_ERR", "the filters' settings are not valid"},
    {35, 17, 1, "U24V_ERR", "the control supply was too low"},

    {36, 0, 1, "RECORDBIT", "starts recording"},
    {36, 1, 1, "REWINDBIT", "back to the start of the record"},
    {36, 2, 1, "RECINNERBIT", "records at the rate of the current loop"},
    {36, 3, 1, "RELPOSPSOLL", "a selected position is added to P_SOLL instead of replacing it"},
    {36, 4, 1, "RELPOSPFNC", "a selected position, times 16, is taken off P_FUNC: endless relative moves"},
    {36, 5, 1, "SYNCPOSAUTO", "resynchronises the position registers by itself (001: AUTO_RESYNC)"},
    {36, 6, 1, "SYNCPOSMAN", "resynchronises them once (001: MAN_RESYNC)"},
    {36, 7, 1, "MAN_NO_BRAKE", "the brake is not used"},
    {36, 8, 1, "SYNCPOSREL", "resynchronising adds P_NEW instead of setting it (001: REL_RESYNC)"},
    {36, 9, 1, "INDEX_HOME", "homing ends at the encoder's index mark"},

    {37, 0, 32, "MODE", "mode after power-up or after homing", kMac800Modes},

    {39, 0, 1, "DIRAWR", "not described"},
    {39, 1, 1, "DIRBWR", "not described"},
    {39, 2, 1, "PULSEOUT", "not described"},
    {39, 3, 1, "XSEL1", "not described"},
    {39, 4, 1, "XPRINP", "not described"},
    {39, 5, 1, "NOFILT", "not described"},
    {39, 6, 1, "INVXDIR", "not described"},

    {42, 0, 8, "AT_POWER_UP", "homing at power-up", kHomingModes},
    {42, 8, 8, "BY_COMMAND", "homing that FastMAC command 10h starts", kHomingModes},
    {42, 16, 1, "HOME_DONE", "homing has been done"},
    {43, 0, 32, "POINTER", "which position to use", kToP},
    {44, 0, 32, "POINTER", "which velocity to use", kToV},
    {45, 0, 32, "POINTER", "which acceleration to use", kToA},
    {46, 0, 32, "POINTER", "which torque to use", kToT},
    {47, 0, 32, "POINTER", "which load factor to use", kToL},
    {48, 0, 32, "POINTER", "which window to use", kToZ},
};
// clang-format on

}  // namespace

std::span<const Field> mac800_fields() {
    return kFields;
}

}  // namespace nplc::registers
