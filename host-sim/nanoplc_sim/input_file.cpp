#include "input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>

#include "host/files.h"
#include "intel_hex/intel_hex.h"
#include "sequencer/table.h"
#include "sim/text.h"

namespace nplc::sim {
namespace {

constexpr std::size_t kMostBytes = 4U << 20U;
constexpr std::size_t kMostOfALongOne = 256U << 20U;

[[noreturn]] void refuse(const std::string& path, const std::string& what, const std::string& why) {
    throw InputError(fmt::format("{}: {}; name {}", path, why, what));
}

std::string read_standard_input(const std::string& what) {
    const std::string name = "standard input";
    std::string text;
    std::string block(1U << 16U, '\0');
    while (std::cin.read(block.data(), static_cast<std::streamsize>(block.size())), std::cin.gcount() > 0) {
        text.append(block, 0, static_cast<std::size_t>(std::cin.gcount()));
        if (text.size() > kMostOfALongOne) refuse(name, what, "it is larger than 256 MiB");
    }
    if (std::cin.bad()) refuse(name, what, fmt::format("cannot be read: {}", std::strerror(errno)));
    return text;
}

std::string read(const std::string& path, const std::string& what, std::size_t most) {
    host::FileContent file = host::read_file(path, most);
    if (!file.problem.empty()) refuse(path, what, fmt::format("cannot be opened: {}", file.problem));
    return std::move(file.bytes);
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

std::string read_input(const std::string& path, const std::string& what) {
    return read(path, what, kMostBytes);
}

std::string read_long_input(const std::string& path, const std::string& what) {
    return path == "-" ? read_standard_input(what) : read(path, what, kMostOfALongOne);
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
    if (is_printable(text) && !intel_hex::is_file(path, text)) {
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
