#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "seqc/seqc.h"
#include "whole_files/whole_files.h"

namespace nplc::seqc::cli {

/// Options and output files of `seqc build`.
struct BuildOptions {
    std::string source;
    std::string output;   ///< the table
    std::string listing;  ///< empty: none
    std::string symbols;  ///< empty: next to the table
    std::string format;   ///< bin or hex; empty: by the output's extension
    std::string base_address;
    bool no_symbols = false;
    bool quiet = false;
    bool json = false;
};

/// The same with every file name resolved.
struct BuildTargets {
    std::string table;
    std::string listing;  ///< empty: none
    std::string symbols;  ///< empty: none
    bool hex = false;
    std::uint32_t base_address = 0;
    std::string problem;  ///< why this cannot be built; empty if it can
};

BuildTargets targets_of(const BuildOptions& options);

/// All output files of the build. Needs a compilation without errors.
std::vector<whole_files::OutputFile> files_of(const BuildTargets& targets, const Compilation& compilation,
                                              const Sources& sources);

/// Error if an output file is one of the program's source files; empty if none is.
std::string overwritten_source(const BuildTargets& targets, const Sources& sources);

/// Whether the table ends within 32 bits of address.
bool has_room(const BuildTargets& targets, std::size_t bytes);

/// `F.bin: 7 steps of 61, 25 terms, 200 bytes; names in F.sym` and a line feed; empty if the table was
/// written to a device, which may be standard output.
std::string summary(const BuildTargets& targets, const Compilation& compilation);

}  // namespace nplc::seqc::cli
