#include "registers/midi.h"

#include "registers/names.h"

namespace nplc::registers::midi {
namespace {

constexpr std::int32_t kLong = 0x7FFF'FFFF;
constexpr bool kRest = false;  ///< not while moving
constexpr bool kAny = true;
constexpr bool kNotKept = false;
constexpr bool kKept = true;

constexpr Field low(std::string_view name, Unit unit, std::int32_t min, std::int32_t max) {
    return {name, 0, 8, false, unit, min, max};
}
constexpr Field longword(std::string_view name, std::int32_t min, std::int32_t max) {
    return {name, 0, 32, true, Unit::increments, min, max};
}
constexpr Field period(std::int32_t min) {
    return {"period", 0, 16, false, Unit::period, min, 0xFFFF};
}
constexpr Field steps{"steps", 16, 16, true, Unit::increments, -0x8000, 0x7FFF};
constexpr Field direction{"direction", 16, 8, false, Unit::choice, 0, 0xFF};

constexpr CommandRow parameter(std::uint8_t number, std::string_view name, bool while_moving, bool kept,
                               Field field, std::string_view section) {
    return {.number = number,
            .name = name,
            .while_moving = while_moving,
            .kept = kept,
            .fields = {field},
            .section = section};
}

struct Motion {
    bool while_moving = true;
    bool with_fault = true;
    bool waits = false;
    std::array<Field, 2> fields{};
};
constexpr CommandRow motion(std::uint8_t number, std::string_view name, const Motion& how,
                            std::string_view section) {
    return {.number = number,
            .name = name,
            .kind = Kind::motion,
            .while_moving = how.while_moving,
            .with_fault = how.with_fault,
            .waits_for_sync = how.waits,
            .fields = how.fields,
            .section = section};
}

constexpr CommandRow initialisation(std::uint8_t number, std::string_view name) {
    return {.number = number, .name = name, .kind = Kind::initialisation, .section = "000 §VI, 003 §VII"};
}

constexpr CommandRow on_v24_only(CommandRow row) {
    row.on_can = false;
    return row;
}

constexpr std::string_view kBoth = "000 §VI, 003 §VII";

// STOP_TORQUE, END_STOPS and TOLERANCE: no manual says whether they are non-volatile; all three have a
// factory value (R).
// clang-format off
constexpr CommandRow kCommands[] = {
    initialisation(RESET, "RESET"),
    initialisation(FACTORY, "FACTORY"),
    parameter(STOP_TORQUE, "STOP_TORQUE", kRest, kKept, low("standby", Unit::choice, 0, 1), kBoth),
    parameter(END_STOPS, "END_STOPS", kRest, kKept, low("stops", Unit::choice, 0, 9), kBoth),
    parameter(REFERENCE, "REFERENCE", kAny, kNotKept, low("enabled", Unit::choice, 0, 1), kBoth),
    on_v24_only(parameter(ADDRESS, "ADDRESS", kAny, kKept, low("address", Unit::none, 0, 0x7F), "000 §VI")),
    parameter(UPPER_STOP, "UPPER_STOP", kRest, kKept, longword("position", -kLong - 1, kLong), kBoth),
    parameter(LOWER_STOP, "LOWER_STOP", kRest, kKept, longword("position", -kLong - 1, kLong), kBoth),
    parameter(ZERO_POSITION, "ZERO_POSITION", kAny, kNotKept, {}, kBoth),
    parameter(TORQUE, "TORQUE", kAny, kKept, low("torque", Unit::torque, 0, kMostTorque), kBoth),
    parameter(SPEED, "SPEED", kRest, kKept, period(1), kBoth),
    parameter(UNSTALL, "UNSTALL", kAny, kKept, {"period", 8, 8, false, Unit::long_period, 1, 0xFF}, kBoth),
    parameter(RAMP, "RAMP", kRest, kKept, low("ramp", Unit::ramp, 0, 0xFF), kBoth),
    motion(WAIT_SYNC, "WAIT_SYNC", {}, kBoth),
    motion(SYNC, "SYNC", {.with_fault = false}, kBoth),
    motion(GO_TO, "GO_TO", {kRest, false, true, {longword("position", kMinPosition, kMaxPosition)}}, kBoth),
    motion(GO_TO_ZERO, "GO_TO_ZERO", {kRest, false, true}, kBoth),
    motion(RUN, "RUN", {kAny, false, true, {direction, period(0)}}, kBoth),
    motion(SEGMENT, "SEGMENT", {kAny, false, false, {steps, period(1)}}, kBoth),
    motion(STOP, "STOP", {}, kBoth),
    motion(EMERGENCY_STOP, "EMERGENCY_STOP", {}, kBoth),
    motion(POWER_ON, "POWER_ON", {.with_fault = false}, kBoth),
    motion(POWER_OFF, "POWER_OFF", {}, kBoth),
    on_v24_only(parameter(BAUD, "BAUD", kAny, kKept, low("code", Unit::choice, 1, 3), "000 §VI")),
    parameter(TOLERANCE, "TOLERANCE", kAny, kKept, low("tolerance", Unit::increments, 0, 0xFF), kBoth),
    motion(PAUSE, "PAUSE", {kAny, false, false, {steps, period(1)}}, kBoth),
};

constexpr Field whole(std::string_view name, Unit unit, bool is_signed) {
    return {.name = name, .bits = 32, .is_signed = is_signed, .unit = unit, .min = -kLong - 1, .max = kLong};
}
constexpr Field byte(std::string_view name, std::uint8_t shift, Unit unit, std::int32_t max = 0xFF) {
    return {.name = name, .shift = shift, .bits = 8, .unit = unit, .max = max};
}
constexpr Field digit(std::string_view name, std::uint8_t shift, std::int32_t max) {
    return {.name = name, .shift = shift, .bits = 4, .unit = Unit::choice, .max = max};
}

constexpr QueryRow kQueries[] = {
    {.number = GET_POSITION, .name = "GET_POSITION", .fields = {whole("position", Unit::increments, true)}, .section = kBoth},
    {.number = GET_STATUS, .name = "GET_STATUS", .fields = {whole("status", Unit::bits, false)}, .section = kBoth},
    {.number = GET_UPPER_STOP, .name = "GET_UPPER_STOP", .fields = {whole("position", Unit::increments, true)}, .section = kBoth},
    {.number = GET_LOWER_STOP, .name = "GET_LOWER_STOP", .fields = {whole("position", Unit::increments, true)}, .section = kBoth},
    {.number = GET_RELEASE, .name = "GET_RELEASE", .fields = {whole("release", Unit::none, false)}, .section = kBoth},
    {.number = GET_SPEEDS, .name = "GET_SPEEDS", .fields = {byte("unstall", 24, Unit::long_period), period(0)}, .section = kBoth},
    {.number = GET_SETTINGS, .name = "GET_SETTINGS", .fields = {byte("ramp", 24, Unit::ramp), byte("torque", 16, Unit::torque, kMostTorque), digit("standby", 12, 1), digit("stops", 8, 9), byte("tolerance", 0, Unit::increments)}, .section = kBoth},
    {.number = GET_MEASURES, .name = "GET_MEASURES", .fields = {byte("temperature", 24, Unit::temperature), byte("supply", 16, Unit::supply), {.name = "terminals", .bits = 16, .unit = Unit::bits, .max = 0xFFFF}}, .section = kBoth},
    {.number = GET_RAM, .name = "GET_RAM", .at_address = true, .fields = {whole("bytes", Unit::none, false)}, .section = kBoth},
    {.number = GET_EEPROM, .name = "GET_EEPROM", .at_address = true, .on_can = false, .fields = {whole("bytes", Unit::none, false)}, .section = "000 §VI"},
};

constexpr Bit kStatusBits[] = {
    {kOverVoltage, "supply too high"},
    {kUnderVoltage, "supply too low"},
    {kThermalTrip23, "tripped: too hot"},
    {kAmplifierTrip, "tripped: amplifier (heat, current, earth leak or supply over 125 %)"},
    {kThermalTrip, "tripped: motor over 95 °C"},
    {kEncoderTrip, "tripped: no encoder"},
    {kSupplyTrip, "tripped: supply was interrupted"},
    {kAtUpperInput, "stopped by the upper end-stop input"},
    {kAtLowerInput, "stopped by the lower end-stop input"},
    {kAtUpperStop, "stopped by the upper software stop"},
    {kAtLowerStop, "stopped by the lower software stop"},
    {kOverVoltageKept, "supply has been too high"},
};

constexpr Bit kTerminalBits[] = {
    {kUpperInput, "upper end-stop input"},
    {kNotBusy, "follows"},
    {kLowerInput, "lower end-stop input"},
    {kReferenceInput, "reference input"},
};

// No manual gives a MAC23's voltages: chosen so that all of them can be read (255 / 4.8 V = 53 V) (R).
constexpr Facts kFacts[] = {
    {"MAC23", 2'000, 40'000, 42'500, 21'000, false},
    {"MAC34-1", 10'000, 80'000, 85'000, 21'000, true},
    {"MAC34-2", 10'000, 160'000, 170'000, 42'000, true},
};
// clang-format on

bool in_range(const Field& field, std::int32_t value) {
    if (field.bits == 0) return value == 0;
    return value >= field.min && value <= field.max;
}

/// 000 §VI 03h: of 0..9 only these.
bool is_choice(const CommandRow& row, std::int32_t first) {
    return row.number != END_STOPS || first <= 1 || first >= 8;
}

constexpr std::uint32_t mask_of(const Field& field) {
    return field.bits == 32 ? 0xFFFF'FFFF : (1U << field.bits) - 1;
}

template <class Row>
const Row* find_in(std::span<const Row> rows, std::uint8_t number) {
    for (const Row& row : rows) {
        if (row.number == number) return &row;
    }
    return nullptr;
}

template <class Row>
const Row* find_in(std::span<const Row> rows, std::string_view name) {
    for (const Row& row : rows) {
        if (same_name(row.name, name)) return &row;
    }
    return nullptr;
}

}  // namespace

std::span<const CommandRow> commands() {
    return kCommands;
}
std::span<const QueryRow> queries() {
    return kQueries;
}
const CommandRow* find_command(std::uint8_t number) {
    return find_in(commands(), number);
}
const QueryRow* find_query(std::uint8_t number) {
    return find_in(queries(), number);
}
const CommandRow* find_command(std::string_view name) {
    return find_in(commands(), name);
}
const QueryRow* find_query(std::string_view name) {
    return find_in(queries(), name);
}

std::int32_t unpack(const Field& field, std::uint32_t data) {
    const std::uint32_t value = data >> field.shift & mask_of(field);
    const bool negative = field.is_signed && (value >> (field.bits - 1) & 1) != 0;
    return static_cast<std::int32_t>(negative ? value | ~mask_of(field) : value);
}

std::optional<std::uint32_t> pack(const CommandRow& row, std::int32_t first, std::int32_t second) {
    const std::array values{first, second};
    static_assert(std::tuple_size_v<decltype(values)> == std::tuple_size_v<decltype(row.fields)>);
    std::uint32_t data = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Field& field = row.fields[i];
        if (!in_range(field, values[i])) return std::nullopt;
        data |= (static_cast<std::uint32_t>(values[i]) & mask_of(field)) << field.shift;
    }
    if (!is_choice(row, first)) return std::nullopt;
    return data;
}

bool is_legal(const CommandRow& row, std::uint32_t data) {
    for (const Field& field : row.fields) {
        if (field.bits != 0 && !in_range(field, unpack(field, data))) return false;
    }
    return is_choice(row, row.fields[0].bits == 0 ? 0 : unpack(row.fields[0], data));
}

std::uint32_t baud_of(std::int32_t code) {
    return code >= 1 && code <= 3 ? 9'600U << (code - 1) : 0U;
}

std::span<const Bit> status_bits() {
    return kStatusBits;
}
std::span<const Bit> terminal_bits() {
    return kTerminalBits;
}

const Facts& facts_of(Model model) {
    return kFacts[static_cast<std::size_t>(model)];
}

std::optional<Model> model_of(std::string_view name) {
    for (const Model model : {Model::mac23, Model::mac34_1, Model::mac34_2}) {
        if (same_name(facts_of(model).name, name)) return model;
    }
    return std::nullopt;
}

}  // namespace nplc::registers::midi
