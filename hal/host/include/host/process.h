#pragma once

#include <string>
#include <vector>

namespace nplc::host {

/// Another number for each program that runs at the same time.
unsigned long own_process();

/// The folder of the program that runs; empty where the system does not say.
std::string own_folder();

struct Ran {
    bool missing = false;  ///< there is no such program
    std::string problem;   ///< why it could not be run or watched; empty when it ended by itself
    bool done = false;     ///< it ended with 0
    int status = -1;       ///< what it ended with, if by itself
    std::string output;
    std::string errors;
};

/// Runs `program`, looked for as the system does, with `input` as its standard input, and waits for its end.
/// No shell is involved; nothing is left behind.
Ran run_program(const std::string& program, const std::vector<std::string>& arguments,
                const std::string& input);

}  // namespace nplc::host
