#pragma once

#include "cli/input.h"

namespace nplc::seqc::cli {

/// A program or table as a gateway would take it; one that every gateway refuses for a term of it is a file
/// problem. More terms than a gateway need hold are not.
Input read_for_view(const InputFile& named);

inline const Symbols* names_of(const Input& input) {
    return input.symbols ? &*input.symbols : nullptr;
}

}  // namespace nplc::seqc::cli
