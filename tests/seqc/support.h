#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "seqc/seqc.h"

namespace nplc::seqc::test {

/// What one scan of a table does, worked out term by term from the bytes (001 §6.1.5 - §6.1.9).
struct Scan {
    std::optional<int> next = std::nullopt;
    std::optional<int> outputs = std::nullopt;
    std::optional<int> timer = std::nullopt;
    std::optional<int> counter = std::nullopt;
    bool clears = false;
    bool counts = false;
    std::vector<std::string> sends = {};  ///< "41" for a command byte, "65=3146" for a register
    bool operator==(const Scan&) const = default;
};

/// `image`: inputs in bits 0..5, IN_POS bit 6, ERROR bit 7.
Scan scan(const std::vector<std::uint8_t>& table, int step, unsigned image, bool timer_zero,
          bool counter_zero);

/// The same for a case number: the image in its low byte, timer zero in bit 8, counter zero in bit 9.
Scan scan_case(const std::vector<std::uint8_t>& table, int step, unsigned number);

/// Terms of a step in a table, the end left out.
int terms_of(const std::vector<std::uint8_t>& table, int step);

/// "C0 01 .." of one term.
std::string term_text(const std::vector<std::uint8_t>& table, std::size_t index);

/// Numbers that are the same in every run.
class Random {
  public:
    explicit Random(unsigned seed) : engine_(seed) {}
    unsigned operator()() { return static_cast<unsigned>(engine_()); }

  private:
    std::mt19937 engine_;
};

/// A program around the text of its steps, with inputs A..F, outputs W..Z and a fault step at the end.
std::string program(std::string_view steps);

/// Of a program without errors.
Compilation compiled(const std::string& source);

/// All diagnostics as the user sees them.
std::string shown(const Compilation& compilation, std::string_view source);

/// Codes in order, space separated.
std::string codes(const Compilation& compilation);

/// The same without W026, W033 and W034: the program is a frame that declares more than it needs.
std::string codes_in_frame(const Compilation& compilation);

}  // namespace nplc::seqc::test
