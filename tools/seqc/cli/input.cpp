#include "cli/input.h"

#include <fmt/format.h>

#include <filesystem>
#include <span>

#include "cli/files.h"
#include "sequencer/term.h"

namespace nplc::seqc::cli {
namespace {

using sequencer::kTermBytes;

bool is_program(const std::string& file) {
    const std::string extension = std::filesystem::path(file).extension().string();
    return extension == ".seq" || extension == ".SEQ";
}

void compile_into(Input& input, const std::string& text) {
    Compilation compilation = compile(text);
    print_diagnostics(compilation, text, input.file);
    if (!compilation.ok) {
        input.exit_code = kProgramHasErrors;
        return;
    }
    input.table = compilation.table;
    input.symbols = compilation.symbols;
    input.source = text;
    input.program = std::move(compilation);
}

/// The bytes up to and including the end term; nothing if there is none.
std::size_t table_length(std::span<const std::uint8_t> bytes) {
    for (std::size_t at = 0; at + kTermBytes <= bytes.size(); at += kTermBytes) {
        if (sequencer::is_end(bytes.subspan(at).first<kTermBytes>())) return at + kTermBytes;
    }
    return 0;
}

void read_table_into(Input& input, const std::string& text) {
    std::vector<std::uint8_t> bytes(text.begin(), text.end());
    const std::size_t length = table_length(bytes);
    if (length == 0) {
        input.exit_code = file_problem(fmt::format(
            "{}: {} bytes hold {} whole terms, and none has STATE 63: this is no sequence table, or "
            "its end is missing",
            input.file, bytes.size(), bytes.size() / kTermBytes));
        return;
    }
    if (length < bytes.size()) {
        fmt::print(stderr, "seqc: {}: {} bytes after the end of the table are left out\n", input.file,
                   bytes.size() - length);
        bytes.resize(length);
    }
    input.table = std::move(bytes);
}

}  // namespace

Input read_input(const std::string& file) {
    Input input;
    input.file = file;
    const FileText text = read_file(file);
    if (!text.error.empty()) {
        input.exit_code = file_problem(text.error);
    } else if (is_program(file)) {
        compile_into(input, text.text);
    } else {
        read_table_into(input, text.text);
    }
    return input;
}

}  // namespace nplc::seqc::cli
