#include "cli/verify_proof.h"

#include <fmt/format.h>

#include <cstdio>

#include "digest/digest.h"
#include "host/paths.h"
#include "host/printable.h"
#include "proof/certificate.h"
#include "whole_files/whole_files.h"

namespace nplc::seqc::cli {
namespace {

using verify::Verdict;

const char* verdict_word(Verdict verdict) {
    return verdict == Verdict::proved ? "proved" : verdict == Verdict::broken ? "broken" : "undecided";
}

proof::Certificate certificate_of(const verify::Report& report, const Input& input, const std::string& assume,
                                  const std::string& assumption) {
    proof::Certificate certificate{.version = "seqc " NPLC_VERSION,
                                   .table = host::name_of(host::path_of(input.file).filename()),
                                   .table_bytes = input.table.size(),
                                   .table_sha256 = digest::hex(digest::sha256(input.table)),
                                   .assume = assume,
                                   .assumptions = {assumption},
                                   .states = report.states,
                                   .results = {}};
    for (const verify::Result& result : report.results) {
        certificate.results.push_back({.name = result.name,
                                       .code = result.code,
                                       .property = result.text,
                                       .is_advice = result.severity == verify::Severity::advice,
                                       .verdict = verdict_word(result.verdict),
                                       .is_vacuous = result.vacuous,
                                       .allowed = result.allowed});
    }
    return certificate;
}

}  // namespace

int write_certificate(const std::string& file, const verify::Report& report, bool all_proved,
                      const Input& input, const std::string& assume, const std::string& assumption) {
    if (!digest::is_available()) return file_problem(fmt::format("{}: {}", file, digest::kNotAvailable));
    if (is_same_file(file, input.file))
        return file_problem(fmt::format("'{}' is what is to be proved: name another file", file));
    if (report.results.empty())
        return file_problem(
            fmt::format("{}: there is nothing to prove: name properties with --property", file));
    if (!all_proved || !report.complete) {
        host::complain(fmt::format("seqc: {} is not written, for not all is proved", file));
        return kOk;
    }
    const std::string text = proof::to_text(certificate_of(report, input, assume, assumption));
    const std::string error = whole_files::write_files({{file, text}});
    return error.empty() ? kOk : file_problem(error);
}

}  // namespace nplc::seqc::cli
