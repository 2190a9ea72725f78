#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "host/files.h"

namespace nplc::host {

/// Whether it begins with the byte order mark of UTF-16 and a letter of ASCII, as no raw table does.
bool is_marked_utf16(std::string_view bytes);

/// Makes of a file's bytes the text in it, whichever editor wrote it: no byte order mark in front, no 1Ah (the
/// end of DOS's files) behind, LF at the end of a line, also where CR alone ends all of them. Answers why it
/// is no text, and how to mend it, or nothing.
std::string make_text(std::string& bytes);

/// As read_file, of a text.
FileContent read_text(const std::string& name, std::size_t most);

}  // namespace nplc::host
