#include "whole_files/whole_files.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>

#include "host/files.h"
#include "host/paths.h"
#include "host/process.h"

namespace nplc::whole_files {
namespace {

namespace fs = std::filesystem;
using host::path_of;

std::string temporary_name(const std::string& path) {
    return fmt::format("{}.{}.tmp", path, host::own_process());
}

std::string reason() {
    return errno != 0 ? std::strerror(errno) : "unknown reason";
}

void remove_file(const std::string& path) {
    std::error_code ignored;
    if (!fs::is_directory(fs::symlink_status(path_of(path), ignored))) fs::remove(path_of(path), ignored);
}

void keep_permissions(const std::string& path) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path_of(path), ignored);
    if (fs::is_regular_file(status))
        fs::permissions(path_of(temporary_name(path)), status.permissions(), ignored);
}

std::FILE* open_first(const std::string& path) {
    return is_special(path) ? std::fopen(path.c_str(), "wb") : create_anew(temporary_name(path));
}

std::string write_first(const OutputFile& file) {
    errno = 0;
    std::FILE* const stream = open_first(file.path);
    bool written = stream != nullptr &&
                   std::fwrite(file.content.data(), 1, file.content.size(), stream) == file.content.size() &&
                   std::fflush(stream) == 0;
    const std::string why = written ? std::string() : reason();
    if (stream != nullptr) written = std::fclose(stream) == 0 && written;
    if (!written) return fmt::format("cannot write '{}': {}", file.path, why.empty() ? reason() : why);
    keep_permissions(file.path);
    return {};
}

void remove_temporaries(const std::vector<OutputFile>& files) {
    for (const OutputFile& file : files) remove_file(temporary_name(file.path));
}

std::string read_standard_input_in_blocks(const std::function<bool(std::string_view block)>& take) {
    errno = 0;
    std::size_t read = 0;
    std::array<char, 65'536> some{};
    while (std::cin.read(some.data(), some.size()), std::cin.gcount() > 0) {
        const auto count = static_cast<std::size_t>(std::cin.gcount());
        read += count;
        if (read > kMostInput) return "standard input has more than 256 MiB; has it no end?";
        if (!take({some.data(), count})) return {};
    }
    const bool is_bad = std::cin.bad() || std::ferror(stdin) != 0;
    return is_bad ? fmt::format("cannot read standard input: {}", reason()) : std::string();
}

FileText all_of_standard_input() {
    FileText result;
    result.error = read_standard_input_in_blocks([&](std::string_view block) {
        result.text.append(block);
        return true;
    });
    if (!result.error.empty()) result.text.clear();
    return result;
}

FileText as_text(FileText file, const std::string& name) {
    if (!file.error.empty()) return file;
    const std::string problem = host::make_text(file.text);
    if (problem.empty()) return file;
    return {{}, fmt::format("cannot read {}: {}", name, problem)};
}

}  // namespace

std::string why_endless(const std::string& path) {
    std::error_code error;
    static_cast<void>(fs::status(path_of(path), error));
    if (error != std::errc::too_many_symbolic_link_levels) return {};
    return fmt::format("cannot write '{}': {}", path, error.message());
}

std::string behind_links(const std::string& path) {
    constexpr int kMostLinks = 40;
    std::error_code error;
    fs::path target = path_of(path);
    for (int i = 0; i < kMostLinks && fs::is_symlink(target, error); ++i) {
        const fs::path next = fs::read_symlink(target, error);
        if (error) return path;
        target = target.parent_path() / next;
    }
    return host::name_of(target);
}

std::FILE* create_anew(const std::string& path) {
    remove_file(path);
    return host::create_file(path);
}

bool is_special(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path_of(path), error);
    return fs::exists(status) && !fs::is_regular_file(status);
}

std::string why_kept(const std::string& path) {
    std::error_code error;
    if (!fs::is_regular_file(path_of(path), error) || fs::file_size(path_of(path), error) == 0) return {};
    return fmt::format("'{}' is there already: name another file, or replace it with --force", path);
}

FileText read_file(const std::string& path, std::size_t most) {
    host::FileContent file = host::read_file(path, most);
    if (!file.problem.empty()) return {{}, fmt::format("cannot read '{}': {}", path, file.problem)};
    return {std::move(file.bytes), {}};
}

FileText read_text(const std::string& path, std::size_t most) {
    return as_text(read_file(path, most), fmt::format("'{}'", path));
}

FileText read_standard_input() {
    return as_text(all_of_standard_input(), "standard input");
}

std::string read_in_pieces(const std::string& path, const host::TextPieces::Take& take) {
    host::TextPieces pieces(take);
    const auto add = [&](std::string_view block) { return pieces.add(block); };
    const bool standard = path == "-";
    const std::string name = standard ? "standard input" : fmt::format("'{}'", path);
    std::string problem =
        standard ? read_standard_input_in_blocks(add) : host::read_blocks(path, kMostInput, add);
    if (problem.empty()) {
        pieces.finish();
        problem = pieces.problem();
    } else if (standard) {
        return problem;
    }
    return problem.empty() ? problem : fmt::format("cannot read {}: {}", name, problem);
}

std::string why_not_made(const std::string& path) {
    if (is_special(path)) return {};
    if (const std::string why = why_endless(path); !why.empty()) return why;
    const std::string probe = temporary_name(behind_links(path));
    std::FILE* const file = create_anew(probe);
    if (file == nullptr) return fmt::format("cannot write '{}': {}", path, reason());
    std::fclose(file);
    remove_file(probe);
    return {};
}

std::string write_files(const std::vector<OutputFile>& named) {
    std::vector<OutputFile> files = named;
    for (OutputFile& file : files) {
        if (!is_special(file.path)) file.path = behind_links(file.path);
    }
    std::string problem;
    for (const OutputFile& file : named) {
        if (problem.empty()) problem = why_endless(file.path);
    }
    for (const OutputFile& file : files) {
        std::error_code error;
        if (problem.empty() && fs::is_directory(path_of(file.path), error)) {
            problem = fmt::format("cannot write '{}': it is a folder", file.path);
        }
        if (problem.empty()) problem = write_first(file);
    }
    for (const OutputFile& file : files) {
        std::error_code error;
        if (problem.empty() && !is_special(file.path))
            fs::rename(path_of(temporary_name(file.path)), path_of(file.path), error);
        if (error) problem = fmt::format("cannot write '{}': {}", file.path, error.message());
    }
    remove_temporaries(files);
    return problem;
}

}  // namespace nplc::whole_files
