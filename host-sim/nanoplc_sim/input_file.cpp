#include "input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "intel_hex/intel_hex.h"
#include "sequencer/table.h"
#include "sim/text.h"

namespace nplc::sim {
namespace {

constexpr std::size_t kLargestFile = 256U << 20U;

[[noreturn]] void refuse(const std::string& path, const std::string& what, const std::string& why) {
    throw InputError(fmt::format("{}: {}; name {}", path, why, what));
}

std::string read_all(std::istream& stream, const std::string& path, const std::string& what) {
    std::string text;
    std::string block(1U << 16U, '\0');
    while (stream.read(block.data(), static_cast<std::streamsize>(block.size())), stream.gcount() > 0) {
        text.append(block, 0, static_cast<std::size_t>(stream.gcount()));
        if (text.size() > kLargestFile) refuse(path, what, "it is larger than 256 MiB");
    }
    if (stream.bad()) refuse(path, what, fmt::format("cannot be read: {}", std::strerror(errno)));
    return text;
}

bool is_printable(const std::string& text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return byte == '\t' || byte == '\r' || byte == '\n' || (byte >= ' ' && byte != 0x7F);
    });
}

std::vector<std::uint8_t> bytes_of(const std::string& text, const std::string& path) {
    if (!intel_hex::is_file(path, text)) return {text.begin(), text.end()};
    intel_hex::Image image = intel_hex::read(text);
    if (image.error.empty()) return std::move(image.bytes);
    throw InputError(
        fmt::format("{}:{}: {}; mend the file or build it again with seqc", path, image.line, image.error));
}

}  // namespace

bool has_extension(const std::string& path, std::string_view extension) {
    return lower(std::filesystem::path(path).extension().string()) == extension;
}

std::string read_input(const std::string& path, const std::string& what, bool dash_is_stdin) {
    if (dash_is_stdin && path == "-") return read_all(std::cin, "standard input", what);
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) refuse(path, what, "it is a folder");
    std::ifstream stream(path, std::ios::binary);
    if (!stream) refuse(path, what, fmt::format("cannot be opened: {}", std::strerror(errno)));
    return read_all(stream, path, what);
}

std::vector<std::uint8_t> read_table(const std::string& path) {
    if (has_extension(path, ".seq")) {
        throw InputError(fmt::format(
            "{0}: a program's source, not a table; build the table first: seqc build {0} -o {1}.bin", path,
            path.substr(0, path.size() - 4)));
    }
    const std::string text = read_input(path, "a sequence table as `seqc build` writes it");
    if (text.empty()) refuse(path, "a sequence table as `seqc build` writes it", "the file is empty");
    std::vector<std::uint8_t> bytes = bytes_of(text, path);
    if (is_printable(text) && !intel_hex::is_file(path, text) && !sequencer::Table::load(bytes).ok) {
        throw InputError(
            fmt::format("{0}: text, not a raw table; if it is a program's source, build the table first: "
                        "seqc build {0} -o {1}",
                        path, std::filesystem::path(path).replace_extension(".bin").string()));
    }
    check_table(bytes, path);
    return bytes;
}

void check_table(const std::vector<std::uint8_t>& bytes, const std::string& path) {
    const auto loaded = sequencer::Table::load(bytes);
    if (loaded.ok) return;
    throw InputError(fmt::format("{}: term {} (byte {}): {}; mend the table or build it again with seqc",
                                 path, loaded.fault.term, loaded.fault.term * sequencer::kTermBytes,
                                 sequencer::describe(loaded.fault.error)));
}

}  // namespace nplc::sim
