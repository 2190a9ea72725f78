#include "whole_files/whole_files.h"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "host/paths.h"
#include "host/process.h"

namespace nplc::whole_files {
namespace {

namespace fs = std::filesystem;
using host::path_of;

constexpr std::size_t kMostInput = 256 * 1024 * 1024;

std::string temporary_name(const std::string& path) {
    return fmt::format("{}.{}.tmp", path, host::own_process());
}

std::string reason() {
    return errno != 0 ? std::strerror(errno) : "unknown reason";
}

/// What a symbolic link leads to is written, not the link; it need not exist yet.
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

std::string where_first(const std::string& path) {
    return is_special(path) ? path : temporary_name(path);
}

void keep_permissions(const std::string& path) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path_of(path), ignored);
    if (fs::is_regular_file(status))
        fs::permissions(path_of(temporary_name(path)), status.permissions(), ignored);
}

std::string write_first(const OutputFile& file) {
    errno = 0;
    std::ofstream stream(path_of(where_first(file.path)), std::ios::binary | std::ios::trunc);
    stream.write(file.content.data(), static_cast<std::streamsize>(file.content.size()));
    stream.close();
    keep_permissions(file.path);
    return stream ? std::string() : fmt::format("cannot write '{}': {}", file.path, reason());
}

void remove_temporaries(const std::vector<OutputFile>& files) {
    std::error_code ignored;
    for (const OutputFile& file : files) fs::remove(path_of(temporary_name(file.path)), ignored);
}

}  // namespace

bool is_special(const std::string& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path_of(path), error);
    return fs::exists(status) && !fs::is_regular_file(status);
}

FileText read_file(const std::string& path) {
    std::error_code error;
    if (fs::is_directory(path_of(path), error)) return {{}, fmt::format("'{}' is a folder", path)};
    errno = 0;
    std::ifstream stream(path_of(path), std::ios::binary);
    if (!stream) return {{}, fmt::format("cannot read '{}': {}", path, reason())};
    FileText result;
    result.text.assign(std::istreambuf_iterator<char>(stream), {});
    if (stream.bad()) return {{}, fmt::format("cannot read '{}': {}", path, reason())};
    return result;
}

FileText read_standard_input() {
    errno = 0;
    FileText result;
    std::array<char, 65'536> some{};
    while (std::cin.read(some.data(), some.size()), std::cin.gcount() > 0) {
        result.text.append(some.data(), static_cast<std::size_t>(std::cin.gcount()));
        if (result.text.size() > kMostInput)
            return {{}, "standard input has more than 256 MiB; has it no end?"};
    }
    if (std::cin.bad() || std::ferror(stdin) != 0)
        return {{}, fmt::format("cannot read standard input: {}", reason())};
    return result;
}

std::string write_files(const std::vector<OutputFile>& named) {
    std::vector<OutputFile> files = named;
    for (OutputFile& file : files) {
        if (!is_special(file.path)) file.path = behind_links(file.path);
    }
    std::string problem;
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
