#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace nplc::sim {

/// An unusable user input. The message is one line: position, error and remedy. Exit code 2.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The whole text of a file of at most 4 MiB. `what` names its purpose in messages.
std::string read_input(const std::string& path, const std::string& what);
/// The same up to 256 MiB; `-` is standard input.
std::string read_long_input(const std::string& path, const std::string& what);
/// A binary file of up to 256 MiB.
std::string read_bytes(const std::string& path, const std::string& what);

/// Without regard to case; `extension` is lower case and begins with its dot.
bool has_extension(const std::string& path, std::string_view extension);

/// A sequence table, raw or Intel HEX, checked by Table::load.
std::vector<std::uint8_t> read_table(const std::string& path);
/// Throws with the file, the term and the reason if Table::load rejects `bytes`.
void check_table(const std::vector<std::uint8_t>& bytes, const std::string& path);

}  // namespace nplc::sim
