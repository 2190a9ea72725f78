#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "seqc/diagnostic.h"

namespace nplc::seqc {

/// The compiler phase that detects the error. Each has a file of explanations and one of golden cases.
enum class Phase : std::uint8_t {
    lexical,
    syntax,
    names,
    motor,       ///< MOTOR, SCALE, registers and their values
    commands,    ///< the arguments of commands
    scan,        ///< what a scan can do, and how often
    conditions,  ///< what the conditions of a step and its terms can distinguish
    steps,       ///< the program as a whole
    terms,       ///< TERM lines
    motion,      ///< the motor tracked through the steps
    courses,     ///< findings of `seqc verify` over all courses: errors are faults, warnings advice
};

struct CodeRow {
    std::string_view code;
    Severity severity;
    Phase phase;
};

/// All diagnostics, sorted.
constexpr auto kCodes = std::to_array<CodeRow>({
    {"E001", Severity::error, Phase::lexical},      {"E002", Severity::error, Phase::lexical},
    {"E003", Severity::error, Phase::lexical},      {"E004", Severity::error, Phase::lexical},
    {"E010", Severity::error, Phase::syntax},       {"E011", Severity::error, Phase::syntax},
    {"E012", Severity::error, Phase::syntax},       {"E013", Severity::error, Phase::syntax},
    {"E014", Severity::error, Phase::syntax},       {"E020", Severity::error, Phase::names},
    {"E021", Severity::error, Phase::names},        {"E022", Severity::error, Phase::names},
    {"E023", Severity::error, Phase::names},        {"E024", Severity::error, Phase::names},
    {"E025", Severity::error, Phase::names},        {"E026", Severity::error, Phase::names},
    {"E027", Severity::error, Phase::names},        {"E030", Severity::error, Phase::motor},
    {"E031", Severity::error, Phase::motor},        {"E032", Severity::error, Phase::motor},
    {"E040", Severity::error, Phase::motor},        {"E041", Severity::error, Phase::motor},
    {"E042", Severity::error, Phase::motor},        {"E043", Severity::error, Phase::motor},
    {"E044", Severity::error, Phase::motor},        {"E045", Severity::error, Phase::motor},
    {"E046", Severity::error, Phase::motor},        {"E047", Severity::error, Phase::motor},
    {"E050", Severity::error, Phase::commands},     {"E051", Severity::error, Phase::commands},
    {"E052", Severity::error, Phase::motion},       {"E060", Severity::error, Phase::scan},
    {"E061", Severity::error, Phase::scan},         {"E062", Severity::error, Phase::scan},
    {"E063", Severity::error, Phase::scan},         {"E064", Severity::error, Phase::scan},
    {"E065", Severity::error, Phase::scan},         {"E066", Severity::error, Phase::scan},
    {"E067", Severity::error, Phase::scan},         {"E068", Severity::error, Phase::scan},
    {"E070", Severity::error, Phase::conditions},   {"E071", Severity::error, Phase::conditions},
    {"E072", Severity::error, Phase::conditions},   {"E073", Severity::error, Phase::conditions},
    {"E074", Severity::error, Phase::conditions},   {"E075", Severity::error, Phase::terms},
    {"E080", Severity::error, Phase::steps},        {"E081", Severity::error, Phase::steps},
    {"E082", Severity::error, Phase::steps},        {"E083", Severity::error, Phase::steps},
    {"E084", Severity::error, Phase::steps},        {"E085", Severity::error, Phase::steps},
    {"E086", Severity::error, Phase::steps},        {"E090", Severity::error, Phase::terms},
    {"E091", Severity::error, Phase::terms},        {"E092", Severity::error, Phase::terms},
    {"E093", Severity::error, Phase::terms},        {"E094", Severity::error, Phase::terms},
    {"E095", Severity::error, Phase::steps},        {"E096", Severity::error, Phase::steps},
    {"E099", Severity::error, Phase::conditions},   {"V001", Severity::warning, Phase::courses},
    {"V002", Severity::warning, Phase::courses},    {"V003", Severity::warning, Phase::courses},
    {"V004", Severity::error, Phase::courses},      {"V005", Severity::error, Phase::courses},
    {"V006", Severity::warning, Phase::courses},    {"V007", Severity::warning, Phase::courses},
    {"V008", Severity::warning, Phase::courses},    {"V009", Severity::warning, Phase::courses},
    {"V010", Severity::error, Phase::courses},      {"V011", Severity::error, Phase::courses},
    {"V012", Severity::warning, Phase::courses},    {"V013", Severity::warning, Phase::courses},
    {"V014", Severity::warning, Phase::courses},    {"V015", Severity::warning, Phase::courses},
    {"W001", Severity::warning, Phase::conditions}, {"W002", Severity::warning, Phase::motor},
    {"W003", Severity::warning, Phase::motor},      {"W004", Severity::warning, Phase::motion},
    {"W005", Severity::warning, Phase::steps},      {"W006", Severity::warning, Phase::scan},
    {"W007", Severity::warning, Phase::scan},       {"W008", Severity::warning, Phase::scan},
    {"W009", Severity::warning, Phase::terms},      {"W010", Severity::warning, Phase::terms},
    {"W011", Severity::warning, Phase::motion},     {"W012", Severity::warning, Phase::motion},
    {"W013", Severity::warning, Phase::motion},     {"W014", Severity::warning, Phase::motion},
    {"W015", Severity::warning, Phase::motion},     {"W016", Severity::warning, Phase::motion},
    {"W017", Severity::warning, Phase::motion},     {"W018", Severity::warning, Phase::motor},
    {"W019", Severity::warning, Phase::steps},      {"W020", Severity::warning, Phase::steps},
    {"W021", Severity::warning, Phase::steps},      {"W022", Severity::warning, Phase::steps},
    {"W023", Severity::warning, Phase::motor},      {"W024", Severity::warning, Phase::scan},
    {"W025", Severity::warning, Phase::names},      {"W026", Severity::warning, Phase::motor},
    {"W030", Severity::warning, Phase::motion},     {"W031", Severity::warning, Phase::motion},
    {"W032", Severity::warning, Phase::motion},     {"W033", Severity::warning, Phase::motor},
    {"W034", Severity::warning, Phase::names},      {"W035", Severity::warning, Phase::motion},
    {"W036", Severity::warning, Phase::motion},     {"W037", Severity::warning, Phase::motion},
    {"W038", Severity::warning, Phase::motion},     {"W039", Severity::warning, Phase::motor},
    {"W040", Severity::warning, Phase::motion},     {"W041", Severity::warning, Phase::motion},
    {"W042", Severity::warning, Phase::motion},     {"W043", Severity::warning, Phase::motion},
    {"W044", Severity::warning, Phase::motion},     {"W045", Severity::warning, Phase::motion},
    {"W046", Severity::warning, Phase::motion},     {"W047", Severity::warning, Phase::motion},
    {"W048", Severity::warning, Phase::motion},     {"W049", Severity::warning, Phase::motion},
    {"W050", Severity::warning, Phase::motion},     {"W051", Severity::warning, Phase::motion},
    {"W052", Severity::warning, Phase::motion},
});

constexpr const CodeRow* find_code(std::string_view code) {
    const auto* row = std::lower_bound(kCodes.begin(), kCodes.end(), code,
                                       [](const CodeRow& a, std::string_view b) { return a.code < b; });
    return row != kCodes.end() && row->code == code ? row : nullptr;
}

/// Warnings about code that may be intended: a step can ALLOW them, like the own findings of `seqc verify`.
constexpr bool is_advice(std::string_view code) {
    return code == "W019" || code == "W022" || (code >= "W035" && code != "W039" && code <= "W049");
}

/// A code of the table; any other literal does not compile.
class Code {
  public:
    consteval Code(const char* code)
        : row_(&known(find_code(code))) {}  // NOLINT(google-explicit-constructor)
    const CodeRow& row() const { return *row_; }

  private:
    static consteval const CodeRow& known(const CodeRow* row) { return *row; }

    const CodeRow* row_;
};

}  // namespace nplc::seqc
