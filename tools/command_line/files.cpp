#include "command_line/files.h"

#include <fmt/format.h>

#include "command_line/program.h"
#include "host/files.h"
#include "host/text_file.h"

namespace nplc::command_line {
namespace {

/// Far larger than any table or its symbols.
constexpr std::size_t kMostBytes = 4 * 1024 * 1024;

std::string content_of(const std::string& path, host::FileContent file) {
    if (!file.problem.empty()) throw UserError(fmt::format("{}: cannot be read: {}", path, file.problem));
    return std::move(file.bytes);
}

}  // namespace

std::string read_whole(const std::string& path) {
    return content_of(path, host::read_file(path, kMostBytes));
}

std::string read_text(const std::string& path) {
    return content_of(path, host::read_text(path, kMostBytes));
}

}  // namespace nplc::command_line
