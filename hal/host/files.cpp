#include "host/files.h"

namespace nplc::host {

FileContent read_file(const std::string& name, std::size_t most) {
    FileContent content;
    content.problem = read_blocks(name, most, [&](std::string_view block) {
        content.bytes.append(block);
        return true;
    });
    if (!content.problem.empty()) content.bytes.clear();
    return content;
}

}  // namespace nplc::host
