#pragma once

#include <cstdint>
#include <span>
#include <string_view>

/// The numbers of causes, for faces without texts. They are permanent: none is changed or used again.
namespace nplc::causes {

struct Code {
    std::uint16_t number;
    std::string_view name;  ///< Finding::code
    std::string_view text;  ///< in a few words
};

/// In ascending order of number.
std::span<const Code> codes();
/// 0: there is no such name.
std::uint16_t number_of(std::string_view name);
/// Null: there is no such number.
const Code* find_code(std::uint16_t number);

}  // namespace nplc::causes
