#include "proof/certificate.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "digest/digest.h"

namespace nplc::proof {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kFormat = "nanoplc-proof-2";
constexpr std::string_view kAnyFormat = "nanoplc-proof-";
constexpr const char* kForeign = "is no certificate of seqc verify, or it was cut short";
constexpr int kDeepest = 3;

std::string dumped(const Json& document, int indent) {
    return document.dump(indent, ' ', false, Json::error_handler_t::replace);
}

/// Of the document without its own field.
std::string check_of(const Json& document) {
    return digest::hex(digest::sha256(dumped(document, -1)));
}

Json document_of(const Certificate& certificate) {
    Json document;
    document["format"] = kFormat;
    document["version"] = certificate.version;
    document["table"] = {{"file", certificate.table},
                         {"bytes", certificate.table_bytes},
                         {"sha256", certificate.table_sha256}};
    document["assume"] = certificate.assume;
    document["assumptions"] = certificate.assumptions;
    document["states"] = certificate.states;
    document["results"] = Json::array();
    for (const Proved& proved : certificate.results) {
        Json& added = document["results"].emplace_back();
        added["name"] = proved.name;
        if (!proved.code.empty()) added["code"] = proved.code;
        added["property"] = proved.property;
        added["severity"] = proved.is_advice ? "advice" : "fault";
        added["verdict"] = proved.verdict;
        if (proved.is_vacuous) added["vacuous"] = true;
        if (!proved.allowed.empty()) added["allowed"] = proved.allowed;
    }
    return document;
}

Certificate certificate_of(const Json& document) {
    Certificate certificate{.version = document.at("version"),
                            .table = document.at("table").at("file"),
                            .table_bytes = document.at("table").at("bytes"),
                            .table_sha256 = document.at("table").at("sha256"),
                            .assume = document.at("assume"),
                            .assumptions = document.at("assumptions"),
                            .states = document.at("states"),
                            .results = {}};
    for (const Json& result : document.at("results")) {
        certificate.results.push_back({.name = result.at("name"),
                                       .code = result.value("code", ""),
                                       .property = result.at("property"),
                                       .is_advice = result.at("severity") == "advice",
                                       .verdict = result.at("verdict"),
                                       .is_vacuous = result.value("vacuous", false),
                                       .allowed = result.value("allowed", "")});
    }
    return certificate;
}

std::string wrong_format(const std::string& format) {
    if (format == kFormat) return "";
    if (!format.starts_with(kAnyFormat)) return kForeign;
    if (format == "nanoplc-proof-1")
        return "is one of an older seqc verify (nanoplc-proof-1), which did not report vacuous proofs";
    return fmt::format("is of a format that this program does not know ({})", format);
}

std::string why_refused(const Certificate& certificate) {
    if (certificate.results.empty()) return "proves nothing";
    for (const Proved& proved : certificate.results) {
        if (!proved.is_advice && proved.verdict != "proved")
            return fmt::format("says that '{}' is not proved", proved.name);
    }
    return "";
}

}  // namespace

std::string to_text(const Certificate& certificate) {
    Json document = document_of(certificate);
    document["check"] = check_of(document);
    return dumped(document, 2) + "\n";
}

CertificateReading read_certificate(std::string_view text) {
    try {
        const Json document =
            Json::parse(text, [](int depth, Json::parse_event_t, const Json&) { return depth <= kDeepest; });
        if (!document.is_object()) return {.certificate = {}, .error = kForeign};
        if (std::string wrong = wrong_format(document.value("format", "")); !wrong.empty())
            return {.certificate = {}, .error = std::move(wrong)};
        if (to_text(certificate_of(document)) != text)
            return {.certificate = {}, .error = "was changed since seqc verify wrote it"};
        CertificateReading reading{.certificate = certificate_of(document), .error = {}};
        reading.error = why_refused(reading.certificate);
        return reading;
    } catch (const Json::exception&) {
        return {.certificate = {}, .error = kForeign};
    }
}

std::string why_not_of(const Certificate& certificate, std::span<const std::uint8_t> table) {
    const std::string own = digest::hex(digest::sha256(table));
    if (certificate.table_sha256 == own) {
        if (certificate.table_bytes == table.size()) return "";
        return fmt::format("says that the table has {} bytes, and it has {}", certificate.table_bytes,
                           table.size());
    }
    return fmt::format("is of another table ({}, SHA-256 {}...) than this one ({}...)", certificate.table,
                       certificate.table_sha256.substr(0, 16), own.substr(0, 16));
}

}  // namespace nplc::proof
