#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// What `seqc verify` has proved of one table, as a file F.proof. README.md describes it.
namespace nplc::proof {

struct Proved {
    std::string name;
    std::string code;  ///< of a built-in check
    std::string property;
    bool is_advice = false;
    std::string verdict;
    bool is_vacuous = false;  ///< proved, of nothing
    std::string allowed;      ///< advice that was switched off in its step: why
};

struct Certificate {
    std::string version;  ///< of the program that proved it
    std::string table;    ///< the file's name, for people
    std::uint64_t table_bytes = 0;
    std::string table_sha256;
    std::string assume;
    std::vector<std::string> assumptions;
    std::uint64_t states = 0;
    std::vector<Proved> results;
};

std::string to_text(const Certificate& certificate);

struct CertificateReading {
    Certificate certificate;
    std::string error;  ///< what is wrong; empty if nothing is
};

/// Refuses all but the bytes that `to_text` writes, and a certificate in which something is not proved.
CertificateReading read_certificate(std::string_view text);

/// Why it is not of this table; empty if it is.
std::string why_not_of(const Certificate& certificate, std::span<const std::uint8_t> table);

}  // namespace nplc::proof
