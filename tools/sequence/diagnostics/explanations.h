#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nplc::seqc {

/// The text of `seqc explain` about a code.
struct Explanation {
    std::string_view code;   ///< E012
    std::string_view title;  ///< the error in a few words
    std::string_view text;   ///< reason and remedy
    std::string wrong;       ///< a complete program with this error; empty if there can be none
    std::string right;       ///< the same, corrected
};

/// All of them, sorted by code.
std::vector<Explanation> explanations();

/// In a line of an example `{1..62}` stands for 62 such lines: $ is the line's number, @ the next one.
std::string whole_program(std::string_view example);
/// The same for display: only the first and the last of repeated lines.
std::string shown_program(std::string_view example);

}  // namespace nplc::seqc
