#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace nplc::seqc {

/// What there is to say about a code.
struct CodeInfo {
    std::string_view code;         ///< E012
    std::string_view title;        ///< what is wrong, in a few words
    std::string_view explanation;  ///< why it is, and what to do
    std::string_view wrong;        ///< a whole program that gives the code; empty if no program can
    std::string_view right;        ///< the same without the mistake
};

/// All of them, in order.
std::vector<CodeInfo> catalog();

/// In a line of an example `{1..62}` stands for 62 such lines: $ is the line's number, @ the next one.
std::string whole_program(std::string_view example);
/// The same to be read: of the repeated lines only the first and the last.
std::string shown_program(std::string_view example);

/// The families that `catalog` joins.
namespace codes {
extern const std::span<const CodeInfo> kText;          ///< E00x
extern const std::span<const CodeInfo> kGrammar;       ///< E01x
extern const std::span<const CodeInfo> kNames;         ///< E02x
extern const std::span<const CodeInfo> kMotor;         ///< E03x, E04x
extern const std::span<const CodeInfo> kCommands;      ///< E05x
extern const std::span<const CodeInfo> kScan;          ///< E06x
extern const std::span<const CodeInfo> kTerms;         ///< E07x
extern const std::span<const CodeInfo> kProgram;       ///< E08x
extern const std::span<const CodeInfo> kRaw;           ///< E09x
extern const std::span<const CodeInfo> kWarnings;      ///< W001 to W008
extern const std::span<const CodeInfo> kMoreWarnings;  ///< W009 and on
}  // namespace codes

}  // namespace nplc::seqc
