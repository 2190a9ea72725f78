#pragma once

#include <string>
#include <vector>

namespace nplc::whole_files {

struct FileText {
    std::string text;
    std::string error;  ///< empty when it was read
};

FileText read_file(const std::string& path);
/// No more than 256 MiB: what has no end is none of ours.
FileText read_standard_input();

/// A device or pipe, which is written to in place: a rename would replace it.
bool is_special(const std::string& path);

struct OutputFile {
    std::string path;
    std::string content;
};

/// Writes into temporary files beside the targets and renames them once all are written whole, so that no
/// half file is ever seen. A target that exists keeps its permissions. Answers what went wrong, or nothing.
std::string write_files(const std::vector<OutputFile>& files);

}  // namespace nplc::whole_files
