#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "seqc/seqc.h"
#include "views/line_time.h"
#include "views/machine.h"

namespace nplc::seqc {

/// What a table uses, and how long its switches keep the motor's line.
struct TableReport {
    struct Step {
        std::uint8_t number = 0;
        std::string name;
        std::size_t terms = 0;
        bool reachable = false;
    };
    struct Transition {
        std::uint8_t from = 0;
        std::uint8_t to = 0;  ///< the same as `from`: acts in every scan while it stays
        Truth when;
        std::vector<std::string> orders;
        LineUse line;
    };

    std::optional<Symbols> symbols;  ///< as given
    bool has_power_up = false;       ///< step 0 is the hidden one of a program
    LineSettings settings;
    std::size_t terms = 0;  ///< the end included
    std::vector<Step> steps;
    std::vector<Transition> transitions;  ///< the longest first
};

TableReport report_of(std::span<const std::uint8_t> table, const Symbols* symbols,
                      const LineSettings& settings);

std::string text_of(const TableReport& report);
/// Room, and the switch that keeps the line longest.
std::string summary_of(const TableReport& report);
std::string json_of(const TableReport& report);

}  // namespace nplc::seqc
