#pragma once

#include <string>
#include <vector>

namespace nplc::host {

/// Unique among the programs that run at the same time.
unsigned long own_process();

/// The folder of the running program; empty if unknown.
std::string own_folder();

struct Ran {
    bool missing = false;  ///< the program does not exist
    std::string problem;   ///< why it could not be run or watched; empty when it ended by itself
    bool done = false;     ///< it ended with exit code 0
    int status = -1;       ///< exit code, if it ended by itself
    std::string output;
    std::string errors;
};

/// Runs `program`, found by the system's search path, with `input` as its standard input, and waits for its
/// end. Uses no shell and leaves no files.
Ran run_program(const std::string& program, const std::vector<std::string>& arguments,
                const std::string& input);

}  // namespace nplc::host
