#include "registers/gateway.h"

#include <array>

namespace nplc::registers::gateway {
namespace {

constexpr auto kRead = Access::read;
constexpr auto kBoth = Access::read_write;

constexpr std::array kMap{
    Row{IDENTITY, 1, "IDENTITY", kRead, "474C504Eh: `NPLG` on the line"},
    Row{FW_VERSION, 1, "FW_VERSION", kRead, "major in bits 31..16, minor 15..8, patch 7..0"},
    Row{MAP_VERSION, 1, "MAP_VERSION", kRead, "1; rises when a register changes its meaning"},
    Row{TABLE_CRC, 1, "TABLE_CRC", kRead, "CRC-32 of the active table, its end term included; 0 without one"},
    Row{TABLE_BYTES, 1, "TABLE_BYTES", kRead, "length of the active table, end term included; 0 without one"},
    Row{STORED_CRC, 1, "STORED_CRC", kRead, "CRC-32 of the stored table as it was uploaded; 0 without one"},
    Row{STORED_BYTES, 1, "STORED_BYTES", kRead, "its length; 0 without one"},
    Row{STORED_MAX, 1, "STORED_MAX", kRead,
        "bytes that a table may have, what follows it for its certificate included"},
    Row{STORE_FLAGS, 1, "STORE_FLAGS", kRead,
        "bit 0: the last stored table is damaged or gone, and an older one or none is in use; bit 1: the "
        "same "
        "of the settings, with older or initial ones; bit 2: the same of the set-points, with older values "
        "or "
        "defaults; bit 3: nobody has commanded run with this store yet, and nothing starts by itself before; "
        "only on Linux and with bit 3, bit 4: the axis had another store here, which is lost; bit 5: it is "
        "the store of another axis"},
    Row{PASSWORD_STATE, 1, "PASSWORD_STATE", kRead,
        "0: this port asks for no password; 1: it does, and this client has not given it; 2: it has"},
    Row{PASSWORD, 1, "PASSWORD", Access::write, "the port's password, 8 to 128 bytes, see Password below"},
    Row{OPERATOR, 1, "OPERATOR", kRead,
        "who operates, see Operator below: bits 7..0 by which way it came, 0 nobody; bit 8: it is "
        "you; bit 9: it took over from you"},
    Row{OPERATOR_PEER, 1, "OPERATOR_PEER", kRead,
        "the number of its user on a Unix socket, its IPv4 address on TCP, else 0"},
    Row{OPERATOR_LEFT, 1, "OPERATOR_LEFT", kRead,
        "s until it operates no more unless it does something; 0: nobody does"},
    Row{OPERATE, 1, "OPERATE", Access::write,
        "1 operate if nobody else does, 2 take it over, 3 give it back"},
    Row{STATUS, 1, "STATUS", kRead, "see Status below"},
    Row{SAFE_REASON, 1, "SAFE_REASON", kRead, "why the outputs are safe, see Reasons below; 0: they are not"},
    Row{SAFE_SINCE, 1, "SAFE_SINCE", kRead, "UPTIME at which the reason came"},
    Row{UPTIME, 1, "UPTIME", kRead, "ms since the start, modulo 2^32"},
    Row{STEP, 1, "STEP", kRead, "0..62"},
    Row{TIMER, 1, "TIMER", kRead, "ms"},
    Row{COUNTER, 1, "COUNTER", kRead, ""},
    Row{INPUTS, 1, "INPUTS", kRead,
        "bits 5..0 as the sequence has them, forced ones included; bit 6 IN_POS, bit 7 ERROR; bits 13..8 the "
        "debounced terminals; bits 23..16 HW_INP of the last scan"},
    Row{OUTPUTS, 1, "OUTPUTS", kRead,
        "bits 3..0 the terminals; bits 11..8 what the sequence wrote; bits 19..16 which are forced"},
    Row{SCANS, 1, "SCANS", kRead, "finished scans, modulo 2^32"},
    Row{SCAN_TIME, 1, "SCAN_TIME", kRead, "us from the end of the scan before to the end of the last one"},
    Row{SCAN_WORST, 1, "SCAN_WORST", kBoth,
        "the longest SCAN_TIME since the run began; a write sets it and POLL_WORST to 0"},
    Row{LINK, 1, "LINK", kRead, "0 down, 1 starting, 2 works but the loss is not acknowledged (01h), 3 up"},
    Row{FORCE_LEFT, 1, "FORCE_LEFT", kBoth,
        "ms until forcing ends, 0: nothing is forced; a write of any value begins the time anew"},
    Row{LOG_COUNT, 1, "LOG_COUNT", kRead, "entries written since the start; number n is in slot n modulo 16"},
    Row{RESULT, 1, "RESULT", kRead,
        "of the last write or command to the gateway: bits 7..0 see Results below, bits 15..8 its register, "
        "bits 31..16 a detail (the term of a table's fault)"},
    Row{LINK_LOSSES, 1, "LINK_LOSSES", kRead, "times that the link to the motor was lost"},
    Row{RESENT, 1, "RESENT", kRead, "messages to the motor sent again"},
    Row{ORDERS, 1, "ORDERS", kRead, "orders of the sequence executed by the motor"},
    Row{DISCARDED, 1, "DISCARDED", kRead, "orders not delivered because the link was not up, or by a stop"},
    Row{ACCESSES, 1, "ACCESSES", kRead, "motor registers read and written for the user"},
    Row{ACCESS_FAILS, 1, "ACCESS_FAILS", kRead, "those that failed"},
    Row{MESSAGES, 1, "MESSAGES", kRead, "whole messages on the user's port, for whatever address"},
    Row{REFUSED, 1, "REFUSED", kRead, "those refused"},
    Row{LINE_FAULTS, kLines, "LINE_FAULTS", kRead,
        "of the user's port, the motor's and the motor's own MacTalk port, one register each: characters "
        "with a "
        "framing error, breaks too, in bits 15..0; characters lost by overruns in bits 31..16; each stays at "
        "65535"},
    Row{POLL_WORST, 1, "POLL_WORST", kRead,
        "us that a poll came late at the worst since the run began, from the poll before or from when a "
        "sleeping board was to wake"},
    Row{LATE_POLLS, 1, "LATE_POLLS", kRead,
        "polls later than the setting poll_limit since the start, while the sequence was not stopped"},
    Row{ECHO_TIME, 1, "ECHO_TIME", kRead,
        "us from the end of a message to a JVL motor to its echo, the worst of late; 0: not measured"},
    Row{STOP_SINCE, 1, "STOP_SINCE", kRead,
        "UPTIME when the motor was told to stop, while it has not confirmed that; else 0"},
    Row{COMMAND, 1, "COMMAND", Access::write, "see Commands below; reads the last one"},
    Row{FORCE_IN, 1, "FORCE_IN", kBoth, "bits 5..0 levels, bits 13..8 which inputs are forced; 0: none"},
    Row{FORCE_OUT, 1, "FORCE_OUT", kBoth, "bits 3..0 levels, bits 11..8 which outputs are forced; 0: none"},
    Row{BREAK_LOW, 1, "BREAK_LOW", kBoth, "breakpoints at steps 0..31, a bit each"},
    Row{BREAK_HIGH, 1, "BREAK_HIGH", kBoth, "breakpoints at steps 32..62; bit 31 cannot be set"},
    Row{UPLOAD_STATE, 1, "UPLOAD_STATE", kRead,
        "0 none, 1 erasing, 2 receiving, 3 closing, 4 stored, 5 failed (then RESULT's codes in bits 15..8, a "
        "term in bits 31..16)"},
    Row{UPLOAD_RECEIVED, 1, "UPLOAD_RECEIVED", kRead, "bytes taken"},
    Row{UPLOAD_BYTES, 1, "UPLOAD_BYTES", kBoth, "length that upload_commit is to find"},
    Row{UPLOAD_CRC, 1, "UPLOAD_CRC", kBoth, "CRC-32 that upload_commit is to find"},
    Row{TABLE_POINTER, 1, "TABLE_POINTER", kBoth,
        "byte at which TABLE_DATA goes on; upload_begin sets it to 0"},
    Row{TABLE_DATA, 1, "TABLE_DATA", kBoth, "the window on the table, see Upload and Read-back below"},
    Row{PROOF_BYTES, 1, "PROOF_BYTES", kRead,
        "40: what a certificate takes behind the end term; 0: this firmware takes none"},
    Row{PROOF, kProofWords, "PROOF", kRead,
        "SHA-256 of the certificate that the active table was uploaded with; 0 without one"},
    Row{FIRED_SCAN, 1, "FIRED_SCAN", kRead,
        "SCANS of the scan that FIRED is about; reading it (in a block too) takes a new one"},
    Row{FIRED_STEP, 1, "FIRED_STEP", kRead, "the step that it was in"},
    Row{FIRED_KEY, 1, "FIRED_KEY", kRead, "HW_INP in bits 7..0, timer = 0 in bit 8, counter = 0 in bit 9"},
    Row{SET_POINT_COUNT, 1, "SET_POINT_COUNT", kRead,
        "set-points of the active table in bits 7..0, most of them in bits 15..8, recipes that there is room "
        "for in bits 23..16; 0: this firmware keeps none"},
    Row{SET_POINT_STATE, 1, "SET_POINT_STATE", kRead, "see Set-points below"},
    Row{SET_POINT_CRC, 1, "SET_POINT_CRC", kRead,
        "CRC-32 of the values in force, 4 bytes each, in their order"},
    Row{SET_POINT_CHANGES, 1, "SET_POINT_CHANGES", kRead, "values changed since the start"},
    Row{SET_POINT_RECORD, 1, "SET_POINT_RECORD", kRead,
        "CRC-32 of the record of the active table's set-points; 0 without one"},
    Row{SET_POINT_BYTES, 1, "SET_POINT_BYTES", kRead, "the record's length; 0 without one"},
    Row{SET_POINT_POINTER, 1, "SET_POINT_POINTER", kBoth,
        "what SET_POINT_DATA shows: in bits 31..16 0 the record, 1 and on a recipe, 254 how the last "
        "requests "
        "ended, 255 the last changes; in bits 15..0 the byte from which"},
    Row{SET_POINT_DATA, 1, "SET_POINT_DATA", kRead,
        "in a block from SET_POINT_POINTER: 60 bytes of what it points at; see Set-points below"},
    Row{SET_POINT_WRITE, 1, "SET_POINT_WRITE", Access::write,
        "a request of 12 to 108 bytes, see Set-points below"},
    Row{FIRED, kFiredWords, "FIRED", kRead,
        "terms that were true in it: bit n of register 96 + k is term 32 k + n"},
    Row{LOG, 2 * kLogEntries, "LOG", kRead,
        "slot s in 128 + 2 s: UPTIME; 129 + 2 s: event in bits 7..0, step in 15..8, a detail in 31..16; "
        "0: empty"},
    Row{SET_POINT, kSetPoints, "SET_POINT", kRead,
        "values in force, in the steps of what takes them, signed"},
    Row{SET_POINT_WANTED, kSetPoints, "SET_POINT_WANTED", kRead,
        "values that are stored, in force as soon as the sequence takes them"},
    Row{FIRMWARE_BOARD, 1, "FIRMWARE_BOARD", kRead,
        "which board's firmware this is; 0: it is not renewed over this port, and the registers that follow "
        "read 0"},
    Row{FIRMWARE_STATE, 1, "FIRMWARE_STATE", kRead,
        "in bits 15..0 as UPLOAD_STATE, of a firmware; bit 16 the slot that runs; bit 17 it is confirmed"},
    Row{FIRMWARE_VERSION, kFirmwareSlots, "FIRMWARE_VERSION", kRead,
        "as FW_VERSION, of what is in slots 0 and 1; 0: none"},
    Row{FIRMWARE_SLOT, kFirmwareSlots, "FIRMWARE_SLOT", kRead,
        "of slots 0 and 1: bit 0 complete, bit 1 confirmed, bits 15..8 starts on trial"},
    Row{FIRMWARE_RECEIVED, 1, "FIRMWARE_RECEIVED", kRead, "bytes taken"},
    Row{FIRMWARE_DATA, 1, "FIRMWARE_DATA", Access::write, "a piece of a firmware, see Firmware below"},
    Row{SETTINGS, kMostSettings + 1, "SETTINGS", kBoth,
        "200 + n is setting n; written only while stopped; see Settings below"},
};

}  // namespace

std::span<const Row> map() {
    return kMap;
}

const Row* find(std::uint8_t number) {
    for (const Row& row : kMap) {
        if (number >= row.number && number - row.number < row.count) return &row;
    }
    return nullptr;
}

const Row* find(std::string_view name) {
    for (const Row& row : kMap) {
        if (row.name == name) return &row;
    }
    return nullptr;
}

}  // namespace nplc::registers::gateway
