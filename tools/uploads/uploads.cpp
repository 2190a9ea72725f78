#include "uploads/uploads.h"

#include <fmt/format.h>

#include <filesystem>

#include "command_line/files.h"
#include "command_line/program.h"
#include "host/printable.h"
#include "intel_hex/intel_hex.h"
#include "registers/gateway.h"
#include "seqc/symbol_file.h"
#include "sequencer/table.h"
#include "whole_files/whole_files.h"

namespace nplc::uploads {

using command_line::UserError;
namespace gw = registers::gateway;

std::vector<std::uint8_t> read_table(const std::string& path) {
    const intel_hex::Image image = intel_hex::bytes_in(path, command_line::read_whole(path));
    if (image.line != 0) throw UserError(fmt::format("{}:{}: {}", path, image.line, image.error));
    if (!image.error.empty())
        throw UserError(fmt::format("{}: {}; this is no table of seqc build", path, image.error));
    const std::vector<std::uint8_t>& table = image.bytes;
    const auto loaded = sequencer::Table::load(table);
    if (!loaded.ok)
        throw UserError(fmt::format("{}: term {}: {}; this is no table of seqc build", path,
                                    loaded.fault.term, sequencer::describe(loaded.fault.error)));
    const std::size_t whole = (loaded.table.size() + 1) * sequencer::kTermBytes;
    if (table.size() != whole)
        throw UserError(
            fmt::format("{}: term {} ends the table and {} bytes follow it; this is no table of "
                        "seqc build, build it anew",
                        path, loaded.table.size(), table.size() - whole));
    if (loaded.table.empty())
        host::complain(fmt::format("{}: the table is empty: nothing will happen", path));
    return table;
}

set_points::Record read_record(const std::string& table_file, const std::string& symbols,
                               std::span<const std::uint8_t> table) {
    const std::string path = symbols.empty() ? seqc::symbol_file_beside(table_file) : symbols;
    std::error_code error;
    if (path.empty() || (symbols.empty() && !std::filesystem::exists(path, error))) return {};
    const std::string text = command_line::read_text(path);
    const seqc::SymbolReading any = seqc::read_symbols(text);
    if (any.error.empty() && any.file.symbols.set_points.values.empty()) return {};
    const seqc::SymbolReading own = seqc::read_symbols(text, table);
    if (!own.error.empty()) {
        if (!any.error.empty() && symbols.empty()) return {};
        throw UserError(
            fmt::format("{}: {}; the table's set-points stand in it: build both anew", path, own.error));
    }
    if (!set_points::decode(set_points::encode(own.file.symbols.set_points), table))
        throw UserError(fmt::format("{}: its set-points do not fit the table; build both anew", path));
    return own.file.symbols.set_points;
}

digest::Digest certificate_for(const std::string& path, std::span<const std::uint8_t> table) {
    if (!digest::is_available()) throw UserError(fmt::format("{}: {}", path, digest::kNotAvailable));
    const std::string text = command_line::read_whole(path);
    const proof::CertificateReading reading = proof::read_certificate(text);
    std::string wrong = reading.error;
    if (wrong.empty()) wrong = proof::why_not_of(reading.certificate, table);
    if (!wrong.empty())
        throw UserError(fmt::format("{}: {}; prove the table with `seqc verify --proof`", path, wrong));
    return digest::sha256(text);
}

std::vector<std::uint8_t> with_digest(std::span<const std::uint8_t> table, const digest::Digest& digest) {
    std::vector<std::uint8_t> content(table.begin(), table.end());
    content.insert(content.end(), gw::kProofMark.begin(), gw::kProofMark.end());
    content.insert(content.end(), digest.begin(), digest.end());
    return content;
}

void write_table(const std::string& path, std::span<const std::uint8_t> table) {
    const std::string content =
        intel_hex::has_extension(path) ? intel_hex::write(table) : std::string(table.begin(), table.end());
    if (const std::string problem = whole_files::write_files({{path, content}}); !problem.empty())
        throw UserError(problem);
}

}  // namespace nplc::uploads
