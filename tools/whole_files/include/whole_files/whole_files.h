#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "host/text_file.h"

namespace nplc::whole_files {

struct FileText {
    std::string text;
    std::string error;  ///< empty when it was read
};

/// More than any program, table, symbol file or recording.
constexpr std::size_t kMostOfAProgram = std::size_t{4} * 1024 * 1024;
constexpr std::size_t kMostInput = std::size_t{256} * 1024 * 1024;

/// As host::read_file.
FileText read_file(const std::string& path, std::size_t most = kMostOfAProgram);
/// The same of a text (`host/text_file.h`).
FileText read_text(const std::string& path, std::size_t most = kMostOfAProgram);
/// A text too, of at most kMostInput: longer input is rejected.
FileText read_standard_input();

/// A text file, or standard input (`-`), of up to kMostInput: in lines, see host::TextPieces. Answers what is
/// wrong, or nothing.
std::string read_in_pieces(const std::string& path, const host::TextPieces::Take& take);

/// The target of a chain of symbolic links, whether it exists or not: it is written instead of the link.
std::string behind_links(const std::string& path);

/// The reason why nothing can be written there, if symbolic links form a cycle; else empty.
std::string why_endless(const std::string& path);

/// A new file that replaces an existing one. Null, and errno, if it cannot be created.
std::FILE* create_anew(const std::string& path);

/// A device or pipe, which is written to in place: a rename would replace it.
bool is_special(const std::string& path);

struct OutputFile {
    std::string path;
    std::string content;
};

/// The reason why a file that was read from a machine, and may be the only copy, must not be written there: a
/// non-empty file exists. Empty if it may.
std::string why_kept(const std::string& path);

/// The reason why no file can be created there, or empty. Leaves nothing behind.
std::string why_not_made(const std::string& path);

/// Writes into temporary files beside the targets and renames them once all are written completely, so that
/// no partial file is ever visible. A target that exists keeps its permissions. Returns the error, or empty.
std::string write_files(const std::vector<OutputFile>& files);

}  // namespace nplc::whole_files
