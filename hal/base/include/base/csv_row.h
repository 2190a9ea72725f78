#pragma once

#include <string_view>

namespace nplc::base {

/// Whether all cells of a CSV line are empty: spreadsheets write `,,,` for empty rows.
constexpr bool is_blank_row(std::string_view line) {
    return line.find_first_not_of(" \t\r,;\"") == std::string_view::npos;
}

}  // namespace nplc::base
