#include "cli/build_targets.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <optional>

#include "cli/common.h"
#include "compiler/model.h"
#include "host/paths.h"
#include "intel_hex/intel_hex.h"
#include "seqc/symbol_file.h"
#include "sequencer/term.h"
#include "symbols/symbol_file_format.h"

namespace nplc::seqc::cli {
namespace {

namespace fs = std::filesystem;

/// Decimal, or hexadecimal with 0x.
std::optional<std::uint32_t> address_of(std::string_view text) {
    const bool hex = text.starts_with("0x") || text.starts_with("0X");
    if (hex) text.remove_prefix(2);
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, hex ? 16 : 10);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

/// The table is written to a pipe or a device, so no symbol file can be placed next to it.
bool is_device(const std::string& path) {
    return whole_files::is_special(path) ||
           host::name_of(host::path_of(path).lexically_normal()).starts_with("/dev/");
}

std::string overlap(const BuildTargets& targets, const BuildOptions& options) {
    struct Target {
        std::string_view what;
        const std::string& path;
    };
    const Target all[] = {
        {"the table", targets.table}, {"the listing", targets.listing}, {"the symbols", targets.symbols}};
    for (const Target& target : all) {
        if (target.path.empty()) continue;
        if (target.path == "-") return "build writes files only: name one instead of '-' (or ./-)";
        if (is_same_file(target.path, options.source)) {
            return fmt::format("'{}' is the program itself: name another file for {}", target.path,
                               target.what);
        }
        for (const Target& other : all) {
            if (&other == &target) break;
            if (other.path.empty() || !is_same_file(target.path, other.path)) continue;
            return fmt::format("'{}' cannot be both {} and {}: name another file", target.path,
                               other.what.substr(4), target.what.substr(4));
        }
    }
    return {};
}

/// The symbol file was not named explicitly, so it must not replace a file that is not one.
std::string foreign(const std::string& symbols) {
    std::error_code error;
    if (symbols.empty() || !fs::is_regular_file(host::path_of(symbols), error)) return {};
    if (whole_files::read_file(symbols).text.find(kSymbolsFormat) != std::string::npos) return {};
    return fmt::format("'{}' is there and was not written by seqc: use --symbols FILE or --no-symbols",
                       symbols);
}

std::string format_problem(const BuildOptions& options) {
    if (!options.format.empty() && options.format != "bin" && options.format != "hex")
        return fmt::format("--format {}: write bin or hex", options.format);
    if (options.no_symbols && !options.symbols.empty())
        return "--symbols and --no-symbols exclude each other: leave one out";
    return {};
}

std::string address_problem(const BuildOptions& options, BuildTargets& targets) {
    if (options.base_address.empty()) return {};
    if (!targets.hex) return "--base-address: a raw table has no address; write Intel HEX with --format hex";
    const auto address = address_of(options.base_address);
    if (!address) {
        return fmt::format("--base-address {}: write a number 0 to 4294967295 or 0x0 to 0xFFFFFFFF",
                           options.base_address);
    }
    targets.base_address = *address;
    return {};
}

std::string counted(std::size_t count, std::string_view what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

}  // namespace

BuildTargets targets_of(const BuildOptions& options) {
    BuildTargets targets;
    targets.problem = format_problem(options);
    if (!targets.problem.empty()) return targets;
    targets.hex =
        options.format == "hex" || (options.format.empty() && intel_hex::has_extension(options.output));
    targets.table = options.output;
    if (targets.table.empty())
        targets.table =
            host::name_of(host::path_of(options.source).replace_extension(targets.hex ? ".hex" : ".bin"));
    targets.listing = options.listing;
    targets.symbols = options.symbols;
    if (targets.symbols.empty() && !options.no_symbols && !is_device(targets.table))
        targets.symbols = host::name_of(host::path_of(targets.table).replace_extension(".sym"));
    targets.problem = address_problem(options, targets);
    if (targets.problem.empty()) targets.problem = overlap(targets, options);
    if (targets.problem.empty() && options.symbols.empty()) targets.problem = foreign(targets.symbols);
    return targets;
}

std::string overwritten_source(const BuildTargets& targets, const Sources& sources) {
    for (const std::string* target : {&targets.table, &targets.listing, &targets.symbols}) {
        for (const SourceFile& file : sources.files()) {
            if (!target->empty() && is_same_file(*target, file.name))
                return fmt::format("'{}' is a file that the program includes: name another one", *target);
        }
    }
    return {};
}

std::vector<whole_files::OutputFile> files_of(const BuildTargets& targets, const Compilation& compilation,
                                              const Sources& sources) {
    const std::vector<std::uint8_t>& table = compilation.table;
    std::vector<whole_files::OutputFile> files = {
        {targets.table, targets.hex ? intel_hex::write(table, targets.base_address)
                                    : std::string(table.begin(), table.end())}};
    if (!targets.listing.empty()) files.push_back({targets.listing, listing(compilation, sources)});
    if (!targets.symbols.empty()) files.push_back({targets.symbols, write_symbols(compilation, sources)});
    return files;
}

bool has_room(const BuildTargets& targets, std::size_t bytes) {
    return std::uint64_t{targets.base_address} + bytes <= 0x1'0000'0000U;
}

std::string summary(const BuildTargets& targets, const Compilation& compilation) {
    if (is_device(targets.table)) return {};
    std::string text = targets.table + ": ";
    const bool has_power_up = compilation.symbols.steps[0] == "POWER_UP";
    if (!compilation.steps.empty()) {
        const std::size_t named = compilation.steps.size() - (has_power_up ? 1 : 0);
        text += fmt::format("{} of {}, ", counted(named, "step"), has_power_up ? kMostSteps : kMostSteps + 1);
    }
    const std::size_t bytes = compilation.table.size();
    text += fmt::format("{}, {} bytes", counted(bytes / sequencer::kTermBytes, "term"), bytes);
    if (targets.base_address != 0) text += fmt::format(" at {:X}h", targets.base_address);
    if (!targets.symbols.empty()) text += fmt::format("; names in {}", targets.symbols);
    return text + "\n";
}

}  // namespace nplc::seqc::cli
