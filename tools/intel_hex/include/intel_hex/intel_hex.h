#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// Intel HEX (Hexadecimal Object File Format Specification, revision A, 1988): the text form in which flash
/// programmers take and give bytes.
namespace nplc::intel_hex {

/// Data records of 16 bytes from `base` on, extended linear address records where the upper half of the
/// address changes, the end record. `base` + size must not pass 2^32.
std::string write(std::span<const std::uint8_t> bytes, std::uint32_t base = 0);

struct Image {
    std::uint32_t base = 0;  ///< address of the first byte
    std::vector<std::uint8_t> bytes;
    std::size_t line = 0;  ///< of the mistake, from 1
    std::string error;     ///< why there are no bytes; empty when there are
    bool is_text = false;  ///< bytes_in: text, but no Intel HEX
};

/// Accepts data records in any order and of any length, with segment or linear addresses, as long as they
/// leave no gap and do not overlap. Start addresses (records 03, 05) and blank lines are ignored.
Image read(std::string_view text);

/// What a file holds, raw or as Intel HEX (`is_file`). Other text is an error without a line.
Image bytes_in(std::string_view file_name, std::string content);

/// Whether a file is to be read as Intel HEX: its name ends in .hex, .ihx or .ihex in any case, or its first
/// line is a colon and hex digits, which no real sequence table begins with.
bool is_file(std::string_view file_name, std::string_view content);
bool has_extension(std::string_view file_name);

}  // namespace nplc::intel_hex
