#pragma once

#include <cstddef>
#include <cstdio>
#include <span>

#include "base/time.h"

/// Standard input, output and error.
namespace nplc::host {

/// To be called first in `main`: standard input and output pass bytes unchanged, and a terminal accepts UTF-8
/// and colours.
void prepare_streams();

/// Whether one of stdin, stdout and stderr is a terminal.
bool is_terminal(std::FILE* stream);

/// Width of standard output; 80 if unknown.
std::size_t terminal_columns();

/// Whether standard input has data or has ended, waiting up to `wait`.
bool input_within(base::Milliseconds wait);

/// Reads available data, at least one byte; waits for it. 0: end of input, or an error.
std::size_t read_input(std::span<char> into);

/// False if standard output is a pipe without a reader.
bool output_has_reader();

}  // namespace nplc::host
