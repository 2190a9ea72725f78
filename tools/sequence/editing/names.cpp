#include "editing/names.h"

#include <fmt/format.h>

#include <algorithm>

#include "language/names.h"
#include "language/reserved_words.h"

namespace nplc::seqc::analysis {
namespace {

bool is_signal(Kind kind) {
    return kind == Kind::input || kind == Kind::output || kind == Kind::motor_variable ||
           kind == Kind::constant || kind == Kind::set_point;
}

/// An existing name that conflicts with a new one.
const Definition* in_the_way(const Program& program, const Definition& renamed, std::string_view name) {
    for (const Definition& other : program.definitions()) {
        const bool same_space = other.kind == renamed.kind ||
                                (is_signal(other.kind) && is_signal(renamed.kind)) ||
                                (other.kind == Kind::step && renamed.kind == Kind::group) ||
                                (other.kind == Kind::group && renamed.kind == Kind::step);
        if (&other != &renamed && same_space && same_name(other.name, name)) return &other;
    }
    return nullptr;
}

bool is_address(std::string_view name) {
    const std::string text = upper(name);
    const std::size_t letters = text.starts_with("IN") ? 2 : text.starts_with("OUT") ? 3 : 0;
    return letters > 0 && text.size() > letters &&
           std::all_of(text.begin() + static_cast<std::ptrdiff_t>(letters), text.end(),
                       [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

std::optional<Span> definition_at(const Program& program, std::uint32_t offset) {
    const Reference* reference = program.reference_at(offset);
    if (reference == nullptr) return std::nullopt;
    if (const Definition* definition = program.definition_of(*reference)) return definition->name_span;
    if (reference->role == ast::Role::step && same_name(program.text(reference->span), "POWER_UP") &&
        program.tree().power_up)
        return program.tree().power_up->name.span;
    return std::nullopt;
}

std::vector<Occurrence> occurrences_at(const Program& program, std::uint32_t offset) {
    const Reference* at = program.reference_at(offset);
    if (at == nullptr) return {};
    std::vector<Occurrence> found;
    for (const Reference& other : program.references()) {
        const bool same = at->definition != Reference::kNone
                              ? other.definition == at->definition
                              : other.definition == Reference::kNone && other.role == at->role &&
                                    same_name(program.text(other.span), program.text(at->span));
        if (same) found.push_back({other.span, other.declares || other.role == ast::Role::output});
    }
    return found;
}

std::optional<Span> renamable_at(const Program& program, std::uint32_t offset) {
    const Reference* reference = program.reference_at(offset);
    if (reference == nullptr || program.definition_of(*reference) == nullptr) return std::nullopt;
    return reference->span;
}

Renaming rename(const Program& program, std::uint32_t offset, const std::string& new_name) {
    Renaming result;
    const Reference* reference = program.reference_at(offset);
    const Definition* definition = reference == nullptr ? nullptr : program.definition_of(*reference);
    if (definition == nullptr) {
        result.error = "only names that the program declares can be renamed: put the cursor on one";
        return result;
    }
    result.old_name = std::string(definition->name);
    if (!is_name(new_name)) {
        result.error = fmt::format(
            "'{}' cannot be a name: letters, digits and _, no digit first, and no word of the "
            "language",
            new_name);
        return result;
    }
    const bool is_register = registers::find(program.symbols().motor, new_name) != nullptr;
    if (is_signal(definition->kind) && (is_address(new_name) || is_register)) {
        result.error = fmt::format("'{}' has a meaning already: it is {}", new_name,
                                   is_register ? "a register of the motor" : "an address");
        return result;
    }
    if (const Definition* other = in_the_way(program, *definition, new_name)) {
        result.error = fmt::format("there is a '{}' already, in line {}", other->name,
                                   Places(program.sources()).line_text(other->name_span.offset));
        return result;
    }
    for (const Occurrence& occurrence : occurrences_at(program, offset))
        result.edits.push_back({occurrence.span, new_name});
    return result;
}

}  // namespace nplc::seqc::analysis
