#pragma once

#include <string>

namespace nplc::command_line {

/// A file's content. Throws UserError on any failure; a folder or more than 4 MiB counts as one.
std::string read_whole(const std::string& path);

/// The same of a text (`host/text_file.h`).
std::string read_text(const std::string& path);

}  // namespace nplc::command_line
