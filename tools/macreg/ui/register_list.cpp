#include "macreg/register_list.h"

#include <fmt/format.h>

#include "macreg/values.h"
#include "registers/convert.h"
#include "registers/layout.h"
#include "stepped.h"
#include "text/text.h"

namespace nplc::macreg {

using registers::Field;
using registers::Register;
using spelling::lower;

namespace {

/// ERR_STAT's bits that have stopped a motor, or will; the others are information only.
bool is_error(const Field& field) {
    return field.name.ends_with("_ERR") && !field.name.starts_with("FRAME");
}

}  // namespace

RegisterList::RegisterList(registers::Model model) : model_(model) {
    for (const Register& reg : registers::map_of(model)) rows_.push_back(&reg);
}

std::span<const Register* const> RegisterList::visible() const {
    const std::size_t above = row_ - std::min(row_, page_ / 2);
    const std::size_t first = std::min(above, rows_.size() - std::min(rows_.size(), page_));
    return std::span<const Register* const>(rows_).subspan(first, std::min(page_, rows_.size() - first));
}

std::span<const Field> RegisterList::fields() const {
    return registers::fields_of(model_, selected().number);
}

std::optional<std::int64_t> RegisterList::raw_of(std::uint8_t number) const {
    const auto found = values_.find(number);
    return found == values_.end() ? std::nullopt : std::optional(found->second);
}

bool RegisterList::has_error() const {
    const auto bits = static_cast<std::uint32_t>(raw_of(registers::ERR_STAT).value_or(0));
    for (const Field& field : registers::fields_of(model_, registers::ERR_STAT)) {
        if (is_error(field) && registers::value_in(field, bits) != 0) return true;
    }
    return false;
}

std::string RegisterList::state_words() const {
    const auto mode = raw_of(registers::MODE_REG);
    const auto errors = raw_of(registers::ERR_STAT);
    if (!mode || !errors) return "reading";
    std::string words = value_text(*registers::find(model_, registers::MODE_REG), model_, *mode);
    const auto bits = static_cast<std::uint32_t>(*errors);
    bool any = false;
    for (const Field& field : registers::fields_of(model_, registers::ERR_STAT)) {
        if (!is_error(field) || registers::value_in(field, bits) == 0) continue;
        words += fmt::format(" {}", field.name);
        any = true;
    }
    return any ? words : words + ", no error";
}

void RegisterList::store(const Snapshot& values) {
    for (const auto& [number, value] : values.values()) values_[number] = value;
}

void RegisterList::move(int steps) {
    row_ = stepped(row_, steps, rows_.size());
    field_ = 0;
}

void RegisterList::move_field(int steps) {
    field_ = stepped(field_, steps, fields().size());
}

bool RegisterList::search(const std::string& text, bool next) {
    const std::string wanted = lower(text);
    const std::size_t from = next ? row_ + 1 : row_before_search_;
    const auto look = [&](auto text_of) {
        for (std::size_t i = 0; i < rows_.size(); ++i) {
            const std::size_t at = (from + i) % rows_.size();
            if (lower(text_of(*rows_[at])).find(wanted) == std::string::npos) continue;
            row_ = at;
            field_ = 0;
            return true;
        }
        return false;
    };
    const auto name = [](const Register& reg) { return fmt::format("{} {}", reg.number, reg.name); };
    const auto title = [&](const Register& reg) {
        const auto* details = registers::details_of(model_, reg.number);
        return fmt::format("{} {}", details != nullptr ? details->title : "", mactalk_name(reg));
    };
    if (look(name) || look(title)) return true;
    if (!next) give_up_search();
    return false;
}

}  // namespace nplc::macreg
