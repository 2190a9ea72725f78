#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Files; what goes wrong is a UserError.
namespace nplc::nanoctl::cli {

/// A table in a .bin or Intel HEX file, held to the rules of a table; nothing may follow its end term.
std::vector<std::uint8_t> read_table(const std::string& path);

/// Appears whole or stays as it was, but a device or pipe is written to; Intel HEX if its name says so.
void write_table(const std::string& path, std::span<const std::uint8_t> table);

}  // namespace nplc::nanoctl::cli
