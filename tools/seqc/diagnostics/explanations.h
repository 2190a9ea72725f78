#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nplc::seqc {

/// What `seqc explain` tells about a code.
struct Explanation {
    std::string_view code;   ///< E012
    std::string_view title;  ///< what is wrong, in a few words
    std::string_view text;   ///< why it is, and what to do
    std::string wrong;       ///< a whole program that gives the code; empty if no program can
    std::string right;       ///< the same without the mistake
};

/// All of them, sorted by code.
std::vector<Explanation> explanations();

/// In a line of an example `{1..62}` stands for 62 such lines: $ is the line's number, @ the next one.
std::string whole_program(std::string_view example);
/// The same to be read: of the repeated lines only the first and the last.
std::string shown_program(std::string_view example);

}  // namespace nplc::seqc
