#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace nplc::sim {

/// Something the user gave cannot be used. The message is one line: where, what, and what to do. Exit code 2.
struct InputError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The whole text in a file of no more than 4 MiB. `what` names its purpose in messages.
std::string read_input(const std::string& path, const std::string& what);
/// The same of up to 256 MiB; `-` is standard input.
std::string read_long_input(const std::string& path, const std::string& what);
/// What is no text, of up to 256 MiB.
std::string read_bytes(const std::string& path, const std::string& what);

/// Without regard to case; `extension` is lower case and begins with its dot.
bool has_extension(const std::string& path, std::string_view extension);

/// A sequence table, raw or Intel HEX, checked: Table::load takes these bytes.
std::vector<std::uint8_t> read_table(const std::string& path);
/// Throws with the file, the term and the reason unless Table::load takes `bytes`.
void check_table(const std::vector<std::uint8_t>& bytes, const std::string& path);

}  // namespace nplc::sim
