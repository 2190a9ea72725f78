#include "macreg/assignments.h"

#include <fmt/format.h>

#include "macreg/values.h"
#include "registers/scale.h"

namespace nplc::macreg {

using registers::Model;
using registers::Register;

namespace {

/// A unit that stands apart, or one more bit's name.
bool belongs_to_value(const Register& reg, Model model, const std::string& word) {
    if (registers::find(model, std::string_view(word)) != nullptr) return false;
    if (reg.unit == registers::Unit::bits)
        return typed_value(reg, model, word).error.empty() && word.find_first_of("0123456789") != 0;
    return registers::raw_per_unit(reg, model, word).has_value();
}

ReadAssignments taken_apart(Model model, const std::vector<std::string>& words) {
    ReadAssignments read;
    for (std::size_t i = 0; i < words.size();) {
        const auto equals = words[i].find('=');
        const std::string name = words[i].substr(0, equals);
        const NamedRegister named = find_register(model, name);
        if (named.reg == nullptr) return {{}, named.error};
        Assignment one{.reg = named.reg,
                       .text = equals == std::string::npos ? "" : words[i].substr(equals + 1)};
        ++i;
        if (one.text.empty() && i < words.size()) one.text = words[i++];
        while (i < words.size() && belongs_to_value(*named.reg, model, words[i]))
            one.text += " " + words[i++];
        if (one.text.empty()) return {{}, fmt::format("'{}': write {} VALUE or {}=VALUE", name, name, name)};
        read.all.push_back(one);
    }
    return read;
}

}  // namespace

ReadAssignments read_assignments(Model model, const std::vector<std::string>& words) {
    ReadAssignments read = taken_apart(model, words);
    for (std::size_t i = 0; i < read.all.size(); ++i) {
        Assignment& one = read.all[i];
        TypedValue typed = typed_value(*one.reg, model, one.text);
        if (!typed.error.empty()) return {{}, typed.error};
        for (std::size_t k = 0; k < i; ++k) {
            if (read.all[k].reg == one.reg)
                return {{}, fmt::format("{} is named twice; name it once", one.reg->name)};
        }
        one.raw = typed.raw;
        one.rounding = std::move(typed.rounding);
    }
    return read;
}

}  // namespace nplc::macreg
