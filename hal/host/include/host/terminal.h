#pragma once

#include <cstddef>
#include <cstdio>
#include <span>

#include "base/time.h"

/// The user's end of standard input, output and error.
namespace nplc::host {

/// What a program's `main` begins with: the bytes of standard input and output are passed as they are, and a
/// terminal takes UTF-8 and colours.
void prepare_streams();

/// Whether one of stdin, stdout and stderr is a terminal.
bool is_terminal(std::FILE* stream);

/// Of standard output; 80 if unknown.
std::size_t terminal_columns();

/// Whether something is to be read from standard input, its end too, waiting no longer than `wait`.
bool input_within(base::Milliseconds wait);

/// What is there, some of it at least; waits for it. 0: its end, or an error.
std::size_t read_input(std::span<char> into);

/// False if standard output is a pipe that nobody reads any more.
bool output_has_reader();

}  // namespace nplc::host
