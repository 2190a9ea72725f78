#pragma once

#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>
#include <string_view>

namespace nplc::host {

struct FileContent {
    std::string bytes;
    std::string problem;  ///< why it cannot be read, without its name; empty when it was
};

/// The file, block by block, until `take` has enough and answers false. What is wrong as in FileContent.
/// Otherwise as read_file.
std::string read_blocks(const std::string& name, std::size_t most,
                        const std::function<bool(std::string_view block)>& take);

/// The whole file. One of more than `most` bytes is refused without reading it; of a device, which may have
/// no end, no more than 4 MiB are taken. A pipe is read until its writers have closed it; one without a
/// writer is refused.
FileContent read_file(const std::string& name, std::size_t most);

/// A new file, open for writing. Null, and errno, if something of this name is there, be it a link.
std::FILE* create_file(const std::string& name);

}  // namespace nplc::host
