#include "eeprom_file.h"

#include <fmt/format.h>

#include <functional>

#include "sim/value_file.h"

namespace nplc::sim {
namespace {

namespace midi = registers::midi;

constexpr const char* kForm = "NAME = VALUE";

struct Entry {
    const char* name;
    std::int64_t min;
    std::int64_t max;
    std::int64_t (*get)(const MidiMemory&);
    void (*set)(MidiMemory&, std::int64_t);
};

#define NPLC_ENTRY(field, min, max)                                                         \
    {                                                                                       \
#field, min, max, [](const MidiMemory& m) { return static_cast<std::int64_t>(m.field); }, \
     [](MidiMemory& m, std::int64_t v) { m.field = static_cast<decltype(m.field)>(v); } \
    }

// Limits as in registers/midi.h; a module for CAN has no address 0.
constexpr Entry kEntries[] = {
    NPLC_ENTRY(address, 0, 0x7F),
    NPLC_ENTRY(baud_code, 1, 3),
    NPLC_ENTRY(upper_stop, INT32_MIN, INT32_MAX),
    NPLC_ENTRY(lower_stop, INT32_MIN, INT32_MAX),
    NPLC_ENTRY(torque, 0, midi::kMostTorque),
    NPLC_ENTRY(period, 1, 0xFFFF),
    NPLC_ENTRY(unstall, 1, 0xFF),
    NPLC_ENTRY(ramp, 0, 0xFF),
    NPLC_ENTRY(standby, 0, 1),
    NPLC_ENTRY(stops, 0, 9),
    NPLC_ENTRY(tolerance, 0, 0xFF),
    NPLC_ENTRY(position, midi::kMinPosition, midi::kMaxPosition),
};

#undef NPLC_ENTRY

std::string heading(const MidiModule& module) {
    return fmt::format("# EEPROM of a virtual {}", midi::facts_of(module.model()).name);
}

/// 000 §VI 03h: of 0..9 only some.
bool is_legal(const MidiMemory& memory) {
    return midi::pack(*midi::find_command(midi::END_STOPS), memory.stops).has_value();
}

bool take(MidiMemory& memory, const NamedValue& line) {
    for (const Entry& entry : kEntries) {
        if (line.name != entry.name) continue;
        if (line.value < entry.min || line.value > entry.max) return false;
        entry.set(memory, line.value);
        return is_legal(memory);
    }
    return false;
}

}  // namespace

std::string load_eeprom(const std::string& path, MidiModule& module) {
    const ValueFile file = read_values(path, heading(module), kForm);
    if (!file.error.empty()) return file.error;
    if (!file.exists) return {};
    MidiMemory memory = module.memory();
    for (const NamedValue& line : file.values) {
        if (!take(memory, line) || (module.is_can() && memory.address == 0))
            return bad_value(path, line, kForm);
    }
    module.set_memory(memory);
    return {};
}

std::string save_eeprom(const std::string& path, const MidiModule& module) {
    std::vector<NamedValue> values;
    for (const Entry& entry : kEntries) values.push_back({entry.name, entry.get(module.memory())});
    return write_values(path, heading(module), values);
}

}  // namespace nplc::sim
