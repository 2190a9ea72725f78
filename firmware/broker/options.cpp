#include "broker/options.h"

#include <charconv>

namespace nplc::broker {

bool read_address(const std::string& text, Options& options) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos || colon == 0) return false;
    const char* const end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data() + colon + 1, end, options.port);
    if (error != std::errc{} || read != end || options.port == 0) return false;
    options.host = text.substr(0, colon);
    if (options.host.starts_with('[') && options.host.ends_with(']'))
        options.host = options.host.substr(1, options.host.size() - 2);
    return !options.host.empty() && options.host.find_first_of(" /") == std::string::npos;
}

std::vector<Mistake> mistakes_of(const Options& options) {
    std::vector<Mistake> mistakes;
    if (!options.password_file.empty() && options.user.empty())
        mistakes.push_back({"password_file", "is of no use without `user`"});
    if (options.certificate_file.empty() != options.key_file.empty())
        mistakes.push_back({options.key_file.empty() ? "certificate_file" : "key_file",
                            "needs the other one: certificate_file and key_file go together"});
    if (!options.certificate_file.empty() && options.ca_file.empty())
        mistakes.push_back({"certificate_file", "is for TLS, which takes a ca_file too"});
    return mistakes;
}

}  // namespace nplc::broker
