#include "command_line/files.h"

#include <fmt/format.h>

#include "command_line/program.h"
#include "host/files.h"

namespace nplc::command_line {
namespace {

/// Far more than a table or its symbols have.
constexpr std::size_t kMostBytes = 4 * 1024 * 1024;

}  // namespace

std::string read_whole(const std::string& path) {
    host::FileContent file = host::read_file(path, kMostBytes);
    if (!file.problem.empty()) throw UserError(fmt::format("{}: cannot be read: {}", path, file.problem));
    return std::move(file.bytes);
}

}  // namespace nplc::command_line
