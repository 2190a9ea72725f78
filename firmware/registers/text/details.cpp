#include "registers/details.h"

#include <algorithm>

#include "registers/names.h"
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

namespace {

bool is_whole(const Field& field) {
    return field.width >= 16;
}

}  // namespace

std::string_view name_of_value(Model model, const Register& reg, std::uint32_t bits) {
    const auto fields = fields_of(model, reg.number);
    if (fields.size() != 1 || !is_whole(fields[0])) return {};
    const NamedValue* value = named(fields[0], value_in(fields[0], bits));
    return value != nullptr ? value->name : std::string_view();
}

std::optional<std::uint32_t> bits_named(Model model, const Register& reg, std::string_view name) {
    for (const Field& field : fields_of(model, reg.number)) {
        if (field.width == 1 && same_name(field.name, name)) return mask_of(field);
        for (const NamedValue& value : field.values) {
            if (is_whole(field) && same_name(value.name, name))
                return std::uint32_t{value.value} << field.first;
        }
    }
    return std::nullopt;
}

std::optional<std::uint32_t> bits_named(Model model, const Register& reg, std::string_view part,
                                        std::string_view value) {
    const Field* field = field_of(model, reg.number, part);
    if (field == nullptr) return std::nullopt;
    for (const NamedValue& entry : field->values) {
        if (same_name(entry.name, value)) return std::uint32_t{entry.value} << field->first;
    }
    return std::nullopt;
}

bool is_name_of_value(Model model, std::string_view name) {
    const auto all = model == Model::mac800 ? mac800_fields() : small_fields();
    return std::any_of(all.begin(), all.end(), [&](const Field& field) {
        return same_name(field.name, name) ||
               std::any_of(field.values.begin(), field.values.end(),
                           [&](const NamedValue& value) { return same_name(value.name, name); });
    });
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
