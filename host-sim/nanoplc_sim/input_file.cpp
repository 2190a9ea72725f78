#include "input_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <span>

#include "host/files.h"
#include "host/printable.h"
#include "host/text_file.h"
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

std::string as_text(std::string bytes, const std::string& path, const std::string& what) {
    if (const std::string problem = host::make_text(bytes); !problem.empty())
        refuse(path, what, fmt::format("cannot be read: {}", problem));
    return bytes;
}

/// Advice for a text file that was given as a table.
std::string advice_for_text(const std::string& path) {
    const auto with = [&](const char* extension) {
        return std::filesystem::path(path).replace_extension(extension).string();
    };
    if (has_extension(path, ".scn"))
        return fmt::format("name the program to run, and this scenario with --scenario {}", path);
    if (has_extension(path, ".sym")) return "name the table, whose names these are; they are found beside it";
    if (has_extension(path, ".bin"))
        return fmt::format("if it is a program's source, call it {}", with(".seq"));
    return fmt::format("if it is a program's source, build the table first: seqc build {} -o {}", path,
                       with(".bin"));
}

std::vector<std::uint8_t> bytes_of(const std::string& content, const std::string& path) {
    intel_hex::Image image = intel_hex::bytes_in(path, content);
    if (image.error.empty()) return std::move(image.bytes);
    if (image.is_text) {
        const bool is_utf16 = host::is_utf16_text(content);
        throw InputError(fmt::format("{}: {}, not a raw table; {}", path,
                                     is_utf16 ? "text in UTF-16" : "text", advice_for_text(path)));
    }
    throw InputError(fmt::format("{}{}: {}; mend the file or build it again with seqc", path,
                                 image.line == 0 ? "" : fmt::format(":{}", image.line), image.error));
}

/// A table that begins with a byte such as '?' or FFh ends at once: erased memory, or another file.
void check_empty(std::span<const std::uint8_t> bytes, const std::string& path) {
    const auto rest = bytes.subspan(std::min(bytes.size(), sequencer::kTermBytes));
    const auto is_all = [&](std::uint8_t value) {
        return std::all_of(rest.begin(), rest.end(), [&](std::uint8_t byte) { return byte == value; });
    };
    if (is_all(0xFF) || is_all(0))
        return host::complain(fmt::format("{}: the table is empty: nothing will happen", path));
    throw InputError(
        fmt::format("{}: no term of a table, and {} bytes behind its end: this is another file; name a table "
                    "as `seqc build` writes it",
                    path, rest.size()));
}

}  // namespace

bool has_extension(const std::string& path, std::string_view extension) {
    return lower(std::filesystem::path(path).extension().string()) == extension;
}

std::string read_input(const std::string& path, const std::string& what) {
    return as_text(read(path, what, kMostBytes), path, what);
}

std::string read_long_input(const std::string& path, const std::string& what) {
    if (path == "-") return as_text(read_standard_input(what), "standard input", what);
    return as_text(read_bytes(path, what), path, what);
}

std::string read_bytes(const std::string& path, const std::string& what) {
    return read(path, what, kMostOfALongOne);
}

std::vector<std::uint8_t> read_table(const std::string& path) {
    if (has_extension(path, ".seq")) {
        throw InputError(fmt::format(
            "{0}: a program's source, not a table; build the table first: seqc build {0} -o {1}.bin", path,
            path.substr(0, path.size() - 4)));
    }
    const std::string what = "a sequence table as `seqc build` writes it";
    const std::string content = read(path, what, kMostBytes);
    if (content.empty()) refuse(path, what, "the file is empty");
    std::vector<std::uint8_t> bytes = bytes_of(content, path);
    check_table(bytes, path);
    if (sequencer::Table::load(bytes).table.empty()) check_empty(bytes, path);
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
