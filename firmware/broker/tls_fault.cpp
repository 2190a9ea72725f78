// What has gone wrong with TLS, by libmosquitto's log and OpenSSL's verdict on the broker's certificate.
#include <fmt/format.h>
#include <mosquitto.h>
#include <openssl/ssl.h>

#include <array>
#include <string_view>

#include "broker/session.h"

namespace nplc::broker {
namespace {

bool has(std::string_view line, std::string_view part) {
    return line.find(part) != std::string_view::npos;
}

constexpr std::string_view kOtherName =
    "the broker's certificate is of another name; its subjectAltName must have `broker` as it is written in "
    "the "
    "configuration, as DNS:NAME or IP:ADDRESS";

std::string_view of_verdict(long verdict) {
    switch (verdict) {
        case X509_V_ERR_CERT_NOT_YET_VALID:
            return "the broker's certificate is not valid yet; set this machine's clock, or that of the "
                   "machine "
                   "that made it";
        case X509_V_ERR_CERT_HAS_EXPIRED:
            return "the broker's certificate, or its CA's, has expired; renew it, or set this machine's "
                   "clock";
        case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
            return "the broker's certificate has signed itself, and is not the one in ca_file; name it "
                   "there, or "
                   "give the broker one that the CA in ca_file has signed";
        case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT:
        case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
        case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
        case X509_V_ERR_SELF_SIGNED_CERT_IN_CHAIN:
        case X509_V_ERR_CERT_SIGNATURE_FAILURE:
            return "the CA in ca_file has not signed the broker's certificate; name the file of the CA that "
                   "has";
        case X509_V_ERR_HOSTNAME_MISMATCH:
        case X509_V_ERR_IP_ADDRESS_MISMATCH:
            return kOtherName;
        default:
            return "the broker's certificate is not accepted; look at ca_file, and at the certificate's "
                   "dates and "
                   "names";
    }
}

/// The broker's own words.
std::string_view of_alert(std::string_view line) {
    if (has(line, "certificate required"))
        return "the broker wants a certificate of its clients; name certificate_file and key_file";
    if (has(line, "certificate expired"))
        return "the broker refuses certificate_file, which has expired; renew it, or set the broker's clock";
    if (has(line, "certificate revoked"))
        return "the broker refuses certificate_file, which its CA has revoked; name a new one";
    constexpr std::array<std::string_view, 5> kOfCertificate{
        "unknown ca", "bad certificate", "certificate unknown", "unsupported certificate", "decrypt error"};
    for (const std::string_view part : kOfCertificate) {
        if (has(line, part))
            return "the broker refuses certificate_file; name one that the broker's own CA has signed";
    }
    if (has(line, "handshake failure") || has(line, "protocol version"))
        return "the broker and this program have no common TLS, or the broker wants certificate_file and "
               "key_file; its log says which";
    return "the broker ends TLS; its log says why";
}

std::string_view of_end(bool is_made) {
    return is_made ? "the broker has ended the connection"
                   : "the broker ends the connection in the place of TLS; name its port for TLS, or leave "
                     "ca_file out if it has none";
}

std::string_view remedy_for(std::string_view line, long verdict, bool is_made) {
    if (has(line, "host name verification failed")) return kOtherName;
    if (has(line, "certificate verify failed")) return of_verdict(verdict);
    if (has(line, "wrong version number") || has(line, "packet length too long"))
        return "the broker speaks no TLS at this port; name its port for TLS, or leave ca_file out";
    if (has(line, "unexpected eof")) return of_end(is_made);
    if (has(line, " alert ")) return of_alert(line);
    return {};
}

}  // namespace

std::string explained(mosquitto* session, const std::string& text) {
    const auto* tls = static_cast<const SSL*>(::mosquitto_ssl_get(session));
    const long verdict = tls == nullptr ? long{X509_V_OK} : ::SSL_get_verify_result(tls);
    const std::string_view remedy =
        remedy_for(text, verdict, tls != nullptr && ::SSL_is_init_finished(tls) != 0);
    return remedy.empty() ? text : fmt::format("{} ({})", remedy, text);
}

}  // namespace nplc::broker
