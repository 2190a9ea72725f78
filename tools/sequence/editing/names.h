#pragma once

#include <optional>
#include <string>
#include <vector>

#include "editing/program.h"

namespace nplc::seqc::analysis {

std::optional<Span> definition_at(const Program& program, std::uint32_t offset);

struct Occurrence {
    Span span;
    bool writes = false;  ///< a declaration, or an output or register that is written
};
/// Occurrences of the name at a place, its declaration included; for an address or a register of the map, of
/// the same text.
std::vector<Occurrence> occurrences_at(const Program& program, std::uint32_t offset);

/// The name to rename at a place: one that the program declares.
std::optional<Span> renamable_at(const Program& program, std::uint32_t offset);
struct Renaming {
    std::vector<TextEdit> edits;
    std::string old_name;
    std::string error;  ///< why it cannot be renamed
};
Renaming rename(const Program& program, std::uint32_t offset, const std::string& new_name);

}  // namespace nplc::seqc::analysis
