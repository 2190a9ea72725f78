#pragma once

#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>

namespace nplc::host {

struct FileContent {
    std::string bytes;
    std::string problem;  ///< why it cannot be read, without its name; empty on success
};

/// Reads the file block by block until `take` returns false. Returns an error as in FileContent. Otherwise as
/// read_file.
std::string read_blocks(const std::string& name, std::size_t most,
                        const std::function<bool(std::string_view block)>& take);

/// Reads the whole file. A file of more than `most` bytes is refused without reading it; from a device, which
/// may have no end, at most 4 MiB are read. A pipe is read until its writers have closed it; one without a
/// writer is refused.
FileContent read_file(const std::string& name, std::size_t most);

/// Creates a new file for writing. Null with errno if the name exists, also as a link.
std::FILE* create_file(const std::string& name);

}  // namespace nplc::host
