#include "language/reserved_words.h"

#include <algorithm>
#include <array>

#include "language/names.h"

namespace nplc::seqc {
namespace {

constexpr auto kReserved = std::to_array<std::string_view>(
    {"PROGRAM",      "END_PROGRAM",   "MOTOR",     "SCALE",     "VAR_INPUT", "VAR_OUTPUT",
     "VAR_MOTOR",    "END_VAR",       "AT",        "ON",        "ERROR",     "NEXT",
     "POWER_UP",     "END_POWER_UP",  "STEP",      "END_STEP",  "OUT",       "WHEN",
     "ENTRY",        "OWN",           "IF",        "THEN",      "ELSIF",     "ELSE",
     "END_IF",       "AND",           "OR",        "NOT",       "XOR",       "TRUE",
     "FALSE",        "INPOS",         "ANY",       "TIMER",     "COUNTER",   "EVERY_SCAN",
     "COUNT_DOWN",   "CLEAR_COUNTER", "TERM",      "REG",       "PROPERTY",  "NEVER",
     "ALWAYS",       "POSSIBLE",      "IS",        "REACHABLE", "WHENEVER",  "WITHIN",
     "ALLOW",        "BECAUSE",       "GROUP",     "IN",        "EXCEPT",    "NO_HELPER",
     "FOR",          "BETWEEN",       "STAYS",     "CHANGES",   "ONLY",      "FOLLOWED",
     "WHILE",        "ENDS",          "ASSUME",    "STABLE",    "CONST",     "SEQUENCE",
     "END_SEQUENCE", "INCLUDE",       "SET_POINT", "RANGE",     "TAKES",     "SET_POINTS"});

constexpr std::array kBoundaries = {
    std::string_view("END_PROGRAM"), std::string_view("MOTOR"),      std::string_view("SCALE"),
    std::string_view("VAR_INPUT"),   std::string_view("VAR_OUTPUT"), std::string_view("VAR_MOTOR"),
    std::string_view("END_VAR"),     std::string_view("POWER_UP"),   std::string_view("END_POWER_UP"),
    std::string_view("STEP"),        std::string_view("END_STEP"),   std::string_view("IF"),
    std::string_view("ELSIF"),       std::string_view("ELSE"),       std::string_view("END_IF"),
    std::string_view("PROPERTY"),    std::string_view("GROUP"),      std::string_view("ASSUME"),
    std::string_view("CONST"),       std::string_view("SEQUENCE"),   std::string_view("END_SEQUENCE"),
    std::string_view("INCLUDE"),     std::string_view("SET_POINT"),
};

template <std::size_t N>
bool contains(const std::array<std::string_view, N>& words, std::string_view word) {
    return std::any_of(words.begin(), words.end(), [&](std::string_view w) { return same_name(w, word); });
}

}  // namespace

bool is_reserved(std::string_view word) {
    return contains(kReserved, word);
}

std::span<const std::string_view> reserved_words() {
    return kReserved;
}

bool is_name(std::string_view text) {
    constexpr std::size_t kLongest = 60;
    return text.size() <= kLongest && is_identifier(text) && !is_reserved(text);
}

bool is_boundary(std::string_view word) {
    return contains(kBoundaries, word);
}

}  // namespace nplc::seqc
