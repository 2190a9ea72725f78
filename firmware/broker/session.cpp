#include "broker/session.h"

#include <fmt/format.h>
#include <mosquitto.h>
#include <nss.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

namespace nplc::broker {

namespace {

std::string error_in_files(const Options& options) {
    std::vector<Mistake> mistakes = mistakes_in_files(options);
    return mistakes.empty() ? std::string() : std::move(mistakes.front().text);
}

}  // namespace

const bool kIsBuiltIn = true;

Library::Library() {
    ::mosquitto_lib_init();
    // A static program must not load the system's name service modules, which need another C library.
    if (NPLC_STATIC) ::__nss_configure_lookup("hosts", "files dns");
}

Library::~Library() {
    ::mosquitto_lib_cleanup();
}

Session new_session(const std::string& name, void* self) {
    return {::mosquitto_new(name.c_str(), true, self), ::mosquitto_destroy};
}

Secrets read_secrets(const Options& options) {
    if (std::string error = error_in_files(options); !error.empty()) return {.error = std::move(error)};
    Secrets secrets;
    if (options.password_file.empty()) return secrets;
    std::ifstream file(options.password_file);
    std::getline(file, secrets.password);
    if (secrets.password.starts_with("\xEF\xBB\xBF")) secrets.password.erase(0, 3);
    if (secrets.password.ends_with('\r')) secrets.password.pop_back();
    if (secrets.password.empty())
        secrets.error =
            fmt::format("{}: its first line must be the password, and this program must be let read it",
                        options.password_file);
    return secrets;
}

std::string set_secrets(mosquitto* session, const Options& options, const std::string& password) {
    const auto or_null = [](const std::string& text) { return text.empty() ? nullptr : text.c_str(); };
    // They may have been exchanged since.
    if (std::string error = error_in_files(options); !error.empty()) return error;
    int code = MOSQ_ERR_SUCCESS;
    if (!options.user.empty())
        code = ::mosquitto_username_pw_set(session, options.user.c_str(), or_null(password));
    if (code == MOSQ_ERR_SUCCESS && !options.ca_file.empty())
        code = ::mosquitto_tls_set(session, options.ca_file.c_str(), nullptr,
                                   or_null(options.certificate_file), or_null(options.key_file), nullptr);
    return code == MOSQ_ERR_SUCCESS ? std::string() : reason_of(code);
}

std::string reason_of(int code) {
    const int cause = errno;
    // The library names it in its header alone.
    if (code == MOSQ_ERR_KEEPALIVE) return "the broker is silent, for longer than the keep-alive time";
    // The broker's alert can be lost with the connection; the next attempt may hear it.
    if (code == MOSQ_ERR_ERRNO && cause == EPROTO)
        return "the broker has ended TLS; its log says why, most often it wants or refuses certificate_file";
    if (code == MOSQ_ERR_ERRNO) return std::strerror(cause);
    const std::string text = ::mosquitto_strerror(code);
    const bool is_known = text != ::mosquitto_strerror(MOSQ_ERR_UNKNOWN);
    return is_known ? text : fmt::format("{} ({}, errno {})", text, code, cause);
}

}  // namespace nplc::broker
