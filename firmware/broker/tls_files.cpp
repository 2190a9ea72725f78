// The files of TLS, as OpenSSL reads them.
#include <fmt/format.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <memory>

#include "broker/session.h"

namespace nplc::broker {
namespace {

using Context = std::unique_ptr<SSL_CTX, void (*)(SSL_CTX*)>;

/// Instead of a question at the terminal.
int no_password(char* /*text*/, int /*size*/, int /*writes*/, void* /*data*/) {
    return 0;
}

/// Empty, or why it cannot be read.
std::string unreadable(const std::string& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored))
        return fmt::format("{}: is a folder; name a file in it", file);
    errno = 0;
    if (std::ifstream(file).is_open()) return {};
    const int cause = errno;
    return fmt::format("{}: {}; {}", file, std::strerror(cause),
                       cause == ENOENT ? "put the file there, or name another"
                                       : "let the user that this program runs as read it, and its folders");
}

std::string no_certificate(const std::string& file) {
    return fmt::format(
        "{0}: holds no certificate in PEM form (-----BEGIN CERTIFICATE-----); `openssl x509 -inform DER -in "
        "{0} -out FILE.pem` makes one of DER form",
        file);
}

/// Empty: `context` has the certificate.
std::string mistake_in_certificate(SSL_CTX* context, const std::string& file) {
    if (::SSL_CTX_use_certificate_chain_file(context, file.c_str()) == 1) return {};
    const unsigned long error = ::ERR_peek_last_error();
    if (ERR_GET_REASON(error) == ERR_R_PEM_LIB) return no_certificate(file);
    const char* const why = ::ERR_reason_error_string(error);
    return fmt::format(
        "{}: is not taken: {}; make one with an RSA key of 2048 bits or more, or with one of an elliptic "
        "curve",
        file, why == nullptr ? "unknown" : why);
}

/// `certificate`: null if there is none.
std::string mistake_in_key(const std::string& file, const X509* certificate) {
    const std::unique_ptr<BIO, int (*)(BIO*)> bytes(::BIO_new_file(file.c_str(), "r"), ::BIO_free);
    const std::unique_ptr<EVP_PKEY, void (*)(EVP_PKEY*)> key(
        bytes ? ::PEM_read_bio_PrivateKey(bytes.get(), nullptr, no_password, nullptr) : nullptr,
        ::EVP_PKEY_free);
    if (!key)
        return fmt::format(
            "{0}: holds no key in PEM form without a password (-----BEGIN PRIVATE KEY-----); `openssl pkey "
            "-in "
            "{0} -out FILE.key` takes a password off",
            file);
    if (certificate != nullptr && ::X509_check_private_key(certificate, key.get()) != 1)
        return fmt::format(
            "{}: is the key of another certificate; name the one that certificate_file was made with", file);
    return {};
}

}  // namespace

std::vector<Mistake> mistakes_in_files(const Options& options) {
    std::vector<Mistake> mistakes;
    if (options.ca_file.empty() && options.certificate_file.empty() && options.key_file.empty())
        return mistakes;
    const Context context(::SSL_CTX_new(::TLS_client_method()), ::SSL_CTX_free);
    if (!context) return mistakes;
    const auto note = [&mistakes](std::string_view key, std::string text) {
        if (!text.empty()) mistakes.push_back({key, std::move(text)});
    };
    const auto is_readable = [&note](std::string_view key, const std::string& file) {
        if (file.empty()) return false;
        const std::string error = unreadable(file);
        note(key, error);
        return error.empty();
    };
    if (is_readable("ca_file", options.ca_file) &&
        ::SSL_CTX_load_verify_locations(context.get(), options.ca_file.c_str(), nullptr) != 1)
        note("ca_file", no_certificate(options.ca_file));
    const X509* certificate = nullptr;
    if (is_readable("certificate_file", options.certificate_file)) {
        note("certificate_file", mistake_in_certificate(context.get(), options.certificate_file));
        certificate = ::SSL_CTX_get0_certificate(context.get());  // null: none was taken
    }
    if (is_readable("key_file", options.key_file))
        note("key_file", mistake_in_key(options.key_file, certificate));
    ::ERR_clear_error();
    return mistakes;
}

}  // namespace nplc::broker
