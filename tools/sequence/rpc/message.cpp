#include "rpc/message.h"

#include <charconv>
#include <istream>
#include <ostream>

#include "base/json_depth.h"

namespace nplc::rpc {
namespace {

bool is_content_length(std::string_view line) {
    constexpr std::string_view kName = "content-length:";
    if (line.size() < kName.size()) return false;
    for (std::size_t i = 0; i < kName.size(); ++i) {
        const char c = line[i] >= 'A' && line[i] <= 'Z' ? static_cast<char>(line[i] - 'A' + 'a') : line[i];
        if (c != kName[i]) return false;
    }
    return true;
}

std::optional<std::size_t> number_in(std::string_view line) {
    const std::size_t first = line.find_first_of("0123456789");
    if (first == line.npos) return std::nullopt;
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(line.data() + first, line.data() + line.size(), number);
    if (error != std::errc()) return std::nullopt;
    return number;
}

}  // namespace

Incoming read_message(std::istream& in) {
    std::optional<std::size_t> length;
    std::string line;
    while (std::getline(in, line)) {
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.empty() && length) break;
        if (is_content_length(line)) length = number_in(line);
    }
    if (!in || !length) return {};
    if (*length > kLongestMessage) {
        in.ignore(static_cast<std::streamsize>(*length));
        return {Incoming::Kind::malformed, {}, "the message is longer than 64 MiB"};
    }
    std::string content(*length, '\0');
    in.read(content.data(), static_cast<std::streamsize>(content.size()));
    if (static_cast<std::size_t>(in.gcount()) != content.size()) return {};
    if (base::is_deeper(content, kDeepestMessage))
        return {Incoming::Kind::malformed,
                {},
                "the content's lists and objects lie more than 100 deep in each other"};
    Json message = Json::parse(content, nullptr, false);
    if (message.is_discarded() || !message.is_object())
        return {Incoming::Kind::malformed, {}, "the content is no JSON object"};
    return {Incoming::Kind::message, std::move(message), {}};
}

void write_message(std::ostream& out, const Json& message) {
    const std::string content = message.dump(-1, ' ', false, Json::error_handler_t::replace);
    out << "Content-Length: " << content.size() << "\r\n\r\n" << content << std::flush;
}

}  // namespace nplc::rpc
