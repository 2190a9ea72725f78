#include "output_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "input_file.h"
#include "program.h"
#include "sim/output_file.h"

namespace nplc::sim {
namespace {

namespace fs = std::filesystem;

bool same_file(const fs::path& a, const fs::path& b) {
    std::error_code error;
    if (fs::equivalent(a, b, error) && !error) return true;
    const fs::path whole_a = fs::weakly_canonical(fs::absolute(a, error), error);
    if (error) return false;
    const fs::path whole_b = fs::weakly_canonical(fs::absolute(b, error), error);
    return !error && whole_a == whole_b;
}

bool touches(const std::vector<fs::path>& written, const fs::path& file) {
    return std::any_of(written.begin(), written.end(),
                       [&](const fs::path& path) { return same_file(path, file); });
}

struct Output {
    std::string option;
    const std::string& path;

    void check_against(const std::string& input, std::string_view what) const {
        if (!touches(OutputFile::written_for(path), input)) return;
        throw InputError(fmt::format("{} {}: this would overwrite the {} {}; name another file", option, path,
                                     what, input));
    }
};

void check(const Output& output, const RunOptions& options) {
    if (output.path.empty() || output.path == "-") {
        throw InputError(
            fmt::format("{} \"{}\": this is no file's name; write one, or /dev/stdout for standard output",
                        output.option, output.path));
    }
    if (options.flash) output.check_against(*options.flash, "flash file");
    if (options.program.empty()) return;
    output.check_against(options.program, "program");
    const std::string symbols = symbols_of(options.program, options.symbols);
    if (!symbols.empty()) output.check_against(symbols, "symbol file");
    if (options.scenario) output.check_against(*options.scenario, "scenario");
}

}  // namespace

void check_outputs(const RunOptions& options) {
    if (options.csv) check({"--trace", *options.csv}, options);
    if (options.vcd) check({"--vcd", *options.vcd}, options);
    if (!options.csv || !options.vcd) return;
    const auto csv = OutputFile::written_for(*options.csv);
    const auto vcd = OutputFile::written_for(*options.vcd);
    if (!std::any_of(csv.begin(), csv.end(), [&](const fs::path& path) { return touches(vcd, path); }))
        return;
    throw InputError(fmt::format("--trace {} and --vcd {}: one would overwrite the other; name two files",
                                 *options.csv, *options.vcd));
}

}  // namespace nplc::sim
