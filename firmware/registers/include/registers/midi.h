#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

/// The commands and queries of MIDI Ingenierie's MAC23 and MAC34, one list for both transports (000 §V and
/// §VI for V24, 003 §VI and §VII for CAN). A command has the same number on both, 00h..1Eh; on CAN it is
/// index 2000h + number of a download. A query has numbers 0..9: index 20h + number on V24, 2000h + number of
/// an upload on CAN.
namespace nplc::registers::midi {

enum class Model : std::uint8_t { mac23, mac34_1, mac34_2 };

enum Command : std::uint8_t {
    RESET = 0x00,
    FACTORY = 0x01,
    STOP_TORQUE = 0x02,
    END_STOPS = 0x03,
    REFERENCE = 0x07,
    ADDRESS = 0x08,
    UPPER_STOP = 0x09,
    LOWER_STOP = 0x0A,
    ZERO_POSITION = 0x0B,
    TORQUE = 0x0C,
    SPEED = 0x0D,
    UNSTALL = 0x0E,
    RAMP = 0x0F,
    WAIT_SYNC = 0x10,
    SYNC = 0x11,
    GO_TO = 0x13,
    GO_TO_ZERO = 0x14,
    RUN = 0x15,
    SEGMENT = 0x16,
    STOP = 0x17,
    EMERGENCY_STOP = 0x18,
    POWER_ON = 0x19,
    POWER_OFF = 0x1A,
    BAUD = 0x1B,
    TOLERANCE = 0x1C,
    PAUSE = 0x1E,
};

enum Query : std::uint8_t {
    GET_POSITION = 0,
    GET_STATUS = 1,
    GET_UPPER_STOP = 2,
    GET_LOWER_STOP = 3,
    GET_RELEASE = 4,
    GET_SPEEDS = 5,
    GET_SETTINGS = 6,
    GET_MEASURES = 7,
    GET_RAM = 8,
    GET_EEPROM = 9,
};

/// The quantity of a field. Conversion to physical units: registers/midi_scale.h.
enum class Unit : std::uint8_t {
    none,
    choice,       ///< one of a few values
    bits,         ///< named by status_bits() and terminal_bits()
    increments,   ///< 2000 a revolution on MAC23, 10000 on MAC34
    period,       ///< 0.125 us an increment
    long_period,  ///< 200 us an increment
    ramp,         ///< 120 increments
    torque,       ///< Imax (RAM AFh) is full torque
    temperature,
    supply,
};

/// A part of the four bytes of parameters or of a reply, as a big-endian 32-bit number.
struct Field {
    std::string_view name{};
    std::uint8_t shift = 0;
    std::uint8_t bits = 0;
    bool is_signed = false;
    Unit unit = Unit::none;
    std::int32_t min = 0;
    std::int32_t max = 0;
};

enum class Kind : std::uint8_t { initialisation, parameter, motion };

struct CommandRow {
    std::uint8_t number = 0;
    std::string_view name{};
    Kind kind = Kind::parameter;
    bool while_moving = true;     ///< false: refused while the axis moves (both manuals' marks)
    bool with_fault = true;       ///< false: refused until a fault is acknowledged (003 §VII 01h)
    bool waits_for_sync = false;  ///< may be prepared by WAIT_SYNC and started by SYNC
    bool kept = false;            ///< survives power-off
    bool on_v24 = true;
    bool on_can = true;
    std::array<Field, 2> fields{};
    std::string_view section{};
};

struct QueryRow {
    std::uint8_t number = 0;
    std::string_view name{};
    bool at_address = false;  ///< the sub-index is the address of the first of four bytes
    bool on_v24 = true;
    bool on_can = true;
    std::array<Field, 5> fields{};
    std::string_view section{};
};

/// In ascending order of number; unused fields of a row have no bits.
std::span<const CommandRow> commands();
std::span<const QueryRow> queries();
const CommandRow* find_command(std::uint8_t number);
const QueryRow* find_query(std::uint8_t number);
const CommandRow* find_command(std::string_view name);
const QueryRow* find_query(std::string_view name);

/// A field's value in four bytes of parameters or reply.
std::int32_t unpack(const Field& field, std::uint32_t data);
/// The parameters of a command; empty if a value is out of its field's range.
std::optional<std::uint32_t> pack(const CommandRow& row, std::int32_t first = 0, std::int32_t second = 0);
/// Every field is within its range; bits outside the fields are ignored.
bool is_legal(const CommandRow& row, std::uint32_t data);

inline constexpr std::int32_t kMinPosition = -1'073'741'824;  ///< 003 §IV; the counter wraps (R)
inline constexpr std::int32_t kMaxPosition = 1'073'741'823;
inline constexpr std::int32_t kTurnsLeft = 0xF6;  ///< SS of RUN; every other value turns right
inline constexpr std::uint8_t kImaxAddress = 0xAF;
inline constexpr std::uint8_t kMostTorque = 0x80;  ///< if Imax is not known
inline constexpr std::uint32_t kFactoryBaud = 38'400;

/// Bauds of BAUD's code 1..3; 0 for others (000 §VI 1Bh).
std::uint32_t baud_of(std::int32_t code);

/// Bits of GET_STATUS's four bytes, its first byte highest. On a MAC23 all trips except that of the supply
/// are bit 28 (R).
enum StatusBit : std::uint32_t {
    kOverVoltage = 1U << 30,
    kUnderVoltage = 1U << 29,
    kThermalTrip23 = 1U << 28,
    kAmplifierTrip = 1U << 27,
    kThermalTrip = 1U << 26,
    kEncoderTrip = 1U << 25,
    kSupplyTrip = 1U << 24,
    kAtUpperInput = 1U << 19,
    kAtLowerInput = 1U << 18,
    kAtUpperStop = 1U << 17,
    kAtLowerStop = 1U << 16,
    kOverVoltageKept = 1U << 7,
};
/// Any of these cuts the motor power until RESET or power-off.
inline constexpr std::uint32_t kTrips =
    kThermalTrip23 | kAmplifierTrip | kThermalTrip | kEncoderTrip | kSupplyTrip;

/// Bits of GET_MEASURES.
enum TerminalBit : std::uint32_t {
    kUpperInput = 1U << 13,
    kNotBusy = 1U << 11,
    kLowerInput = 1U << 6,
    kReferenceInput = 1U << 5,
};

struct Bit {
    std::uint32_t mask;
    std::string_view text;  ///< message when it is 1
};
std::span<const Bit> status_bits();
std::span<const Bit> terminal_bits();

/// Data of a model from the manuals. Voltages in mV.
struct Facts {
    std::string_view name;
    std::int32_t increments_per_rev;
    std::int32_t max_supply;     ///< Vmax; 115 % of it ends braking, 125 % trips (003 §II.1)
    std::int32_t over_voltage;   ///< warning from here on
    std::int32_t under_voltage;  ///< warning up to here
    bool has_can;
};
const Facts& facts_of(Model model);
std::optional<Model> model_of(std::string_view name);

inline constexpr std::int32_t kLeastSupply = 19'000;  ///< mV; below it a fault (003 §IV)
inline constexpr std::int32_t kMotorTrip = 95'000;    ///< thousandths of a degree (003 §VII 01h)
inline constexpr std::int32_t kReleasePercent = 115;
inline constexpr std::int32_t kTripPercent = 125;

}  // namespace nplc::registers::midi
