#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/line_time.h"
#include "report/machine.h"
#include "seqc/seqc.h"

namespace nplc::seqc {

/// Resources used by a table, and the load of its transitions on the motor's line.
struct TableReport {
    struct Step {
        std::uint8_t number = 0;
        std::string name;
        std::size_t terms = 0;
        bool reachable = false;
    };
    struct Transition {
        std::uint8_t from = 0;
        std::uint8_t to = 0;  ///< equal to `from`: acts in every scan while it stays
        Truth when;
        std::vector<std::string> orders;
        LineUse line;
    };

    std::optional<Symbols> symbols;  ///< as given
    bool has_power_up = false;       ///< step 0 is a program's POWER_UP
    LineSettings settings;
    std::size_t terms = 0;  ///< including the end term
    std::vector<Step> steps;
    std::vector<Transition> transitions;  ///< the longest first
};

TableReport report_of(std::span<const std::uint8_t> table, const Symbols* symbols,
                      const LineSettings& settings);

std::string text_of(const TableReport& report);
/// Memory use, and the transition with the highest load on the line.
std::string summary_of(const TableReport& report);
std::string json_of(const TableReport& report);

}  // namespace nplc::seqc
