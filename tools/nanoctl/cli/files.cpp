#include "cli/files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "cli/session.h"
#include "seqc/intel_hex.h"
#include "sequencer/table.h"

namespace nplc::nanoctl::cli {

namespace fs = std::filesystem;

std::string read_whole(const std::string& path) {
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    std::error_code error;
    if (!file.is_open() || file.bad() || fs::is_directory(path, error))
        throw UserError(
            fmt::format("{}: cannot be read: {}", path, errno != 0 ? std::strerror(errno) : "it is no file"));
    return content;
}

std::vector<std::uint8_t> read_table(const std::string& path) {
    const std::string content = read_whole(path);
    std::vector<std::uint8_t> table(content.begin(), content.end());
    if (seqc::is_intel_hex(path, content)) {
        const seqc::HexImage image = seqc::from_intel_hex(content);
        if (!image.error.empty()) throw UserError(fmt::format("{}:{}: {}", path, image.line, image.error));
        table = image.bytes;
    }
    const auto loaded = sequencer::Table::load(table);
    if (!loaded.ok)
        throw UserError(fmt::format("{}: term {}: {}; this is no table of seqc build", path,
                                    loaded.fault.term, sequencer::describe(loaded.fault.error)));
    table.resize((loaded.table.size() + 1) * sequencer::kTermBytes);
    return table;
}

void write_table(const std::string& path, std::span<const std::uint8_t> table) {
    const std::string content =
        seqc::has_hex_extension(path) ? seqc::to_intel_hex(table) : std::string(table.begin(), table.end());
    const std::string temporary = fmt::format("{}.{}", path, ::getpid());
    std::ofstream file(temporary, std::ios::binary | std::ios::trunc);
    file << content << std::flush;
    std::error_code error;
    if (file) fs::rename(temporary, path, error);
    if (file && !error) return;
    const std::string reason = error ? error.message() : std::strerror(errno);
    fs::remove(temporary, error);
    throw UserError(fmt::format("{}: cannot be written: {}", path, reason));
}

}  // namespace nplc::nanoctl::cli
