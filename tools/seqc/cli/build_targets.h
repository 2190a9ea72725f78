#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "seqc/seqc.h"
#include "whole_files/whole_files.h"

namespace nplc::seqc::cli {

/// What `seqc build` is asked for, and where it goes.
struct BuildOptions {
    std::string source;
    std::string output;   ///< the table
    std::string listing;  ///< empty: none
    std::string symbols;  ///< empty: beside the table
    std::string format;   ///< bin or hex; empty: by the output's extension
    std::string base_address;
    bool no_symbols = false;
    bool quiet = false;
    bool json = false;
};

/// The same with every name filled in.
struct BuildTargets {
    std::string table;
    std::string listing;  ///< empty: none
    std::string symbols;  ///< empty: none
    bool hex = false;
    std::uint32_t base_address = 0;
    std::string problem;  ///< why nothing can be built like that; empty when it can
};

BuildTargets targets_of(const BuildOptions& options);

/// Everything that is written together. The compilation must be good.
std::vector<whole_files::OutputFile> files_of(const BuildTargets& targets, const Compilation& compilation,
                                              const Sources& sources);

/// Why nothing may be written: a target is a file that the program includes. Nothing if none is.
std::string overwritten_source(const BuildTargets& targets, const Sources& sources);

/// Whether the table ends within 32 bits of address.
bool has_room(const BuildTargets& targets, std::size_t bytes);

/// `F.bin: 7 steps of 61, 25 terms, 200 bytes; names in F.sym` and a line feed; nothing where the table went
/// to a device, which may be standard output.
std::string summary(const BuildTargets& targets, const Compilation& compilation);

}  // namespace nplc::seqc::cli
