#include "registers/details.h"

#include <algorithm>

#include "names.h"
#include "text_tables.h"

namespace nplc::registers {

const Details* details_of(Model model, std::uint8_t number) {
    for (const Details& entry : model == Model::mac800 ? mac800_details() : small_details()) {
        if (entry.number == number) return &entry;
    }
    return nullptr;
}

std::span<const Field> fields_of(Model model, std::uint8_t number) {
    const auto all = model == Model::mac800 ? mac800_fields() : small_fields();
    const auto first =
        std::find_if(all.begin(), all.end(), [&](const Field& f) { return f.number == number; });
    const auto end = std::find_if(first, all.end(), [&](const Field& f) { return f.number != number; });
    return {first, end};
}

const Field* field_of(Model model, std::uint8_t number, std::string_view name) {
    for (const Field& field : fields_of(model, number)) {
        if (same_name(field.name, name)) return &field;
    }
    return nullptr;
}

const NamedValue* named(const Field& field, std::uint32_t value) {
    for (const NamedValue& entry : field.values) {
        if (entry.value == value) return &entry;
    }
    return nullptr;
}

std::string_view name_of(Format format) {
    switch (format) {
        case Format::word:
            return "Word";
        case Format::integer:
            return "Integer";
        case Format::long_int:
            return "LongInt";
        case Format::fixed4:
            return "Fixed4";
        case Format::fixed8:
            return "Fixed8";
        case Format::fixed16:
            return "Fixed16";
        case Format::fixed24:
            return "Fixed24";
    }
    return {};
}

std::string_view name_of(Access access) {
    switch (access) {
        case Access::read_write:
            return "read/write";
        case Access::motor_writes:
            return "read/write, motor too";
        case Access::read_only:
            return "read only";
    }
    return {};
}

}  // namespace nplc::registers
