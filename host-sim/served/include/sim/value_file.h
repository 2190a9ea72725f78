#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace nplc::sim {

struct NamedValue {
    std::string name;
    std::int64_t value = 0;
    int line = 0;  ///< of the file it was read from
};

/// A text file whose first line is `heading`, then a line `NAME = VALUE` each, in decimal; `#` begins a
/// comment.
struct ValueFile {
    bool exists = false;
    std::vector<NamedValue> values;
    std::string error;  ///< what went wrong, in one line, or nothing
};
/// A file that is not there is no error. `form` is how a line is written, for messages: "REGISTER = VALUE".
ValueFile read_values(const std::string& path, const std::string& heading, const std::string& form);
/// The message about a line whose name or value nobody knows.
std::string bad_value(const std::string& path, const NamedValue& value, const std::string& form);
/// Whether write_values can write there; leaves nothing behind. These answer what went wrong, or nothing.
std::string try_values(const std::string& path);
/// The file appears whole or stays as it was.
std::string write_values(const std::string& path, const std::string& heading,
                         const std::vector<NamedValue>& values);

}  // namespace nplc::sim
