#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

/// Files; what goes wrong is a UserError.
namespace nplc::nanoctl::cli {

std::string read_whole(const std::string& path);

/// A table in a .bin or Intel HEX file up to and with its end term, held to the rules of a table.
std::vector<std::uint8_t> read_table(const std::string& path);

/// Appears whole or stays as it was; Intel HEX if its name says so.
void write_table(const std::string& path, std::span<const std::uint8_t> table);

}  // namespace nplc::nanoctl::cli
