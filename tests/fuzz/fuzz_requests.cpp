// Any stream is parsed as messages of an editor, or rejected; any text is a request of the panel's page, or
// is refused with a reason; any stream at the metrics' port asks for them, or is answered with the error.
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <sstream>
#include <string>
#include <string_view>

#include "fuzz.h"
#include "http_client.h"
#include "request.h"
#include "rpc/message.h"

namespace {

using namespace nplc;

void messages(std::string_view text) {
    std::istringstream in{std::string(text)};
    for (std::size_t count = 0;; ++count) {
        require(count <= text.size());
        const rpc::Incoming incoming = rpc::read_message(in);
        if (incoming.kind == rpc::Incoming::Kind::end) return;
        require((incoming.kind == rpc::Incoming::Kind::malformed) != incoming.problem.empty());
        if (incoming.kind != rpc::Incoming::Kind::message) continue;
        std::ostringstream out;
        rpc::write_message(out, incoming.message);
        std::istringstream written(out.str());
        require(rpc::read_message(written).kind == rpc::Incoming::Kind::message);
    }
}

void panel_request(std::string_view text) {
    const panel::Request request = panel::Request::read(text);
    if (!request.error.empty()) return;
    const panel::Asked asked = panel::command_of(request, registers::Model::mac140, {});
    require(!asked.command || asked.error.empty());
}

/// In pieces of the length in its first byte.
void http(std::string_view text) {
    if (text.empty()) return;
    const std::size_t piece = 1 + static_cast<std::uint8_t>(text.front());
    std::array<int, 2> ends{};
    require(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, ends.data()) == 0);
    {
        metrics::HttpClient client(ends[0], {});
        for (text.remove_prefix(1); !text.empty() && client.events() == POLLIN && !client.is_gone();) {
            const std::size_t size = std::min(piece, text.size());
            require(::write(ends[1], text.data(), size) == static_cast<ssize_t>(size));
            text.remove_prefix(size);
            client.serve(POLLIN, {});
        }
        const bool wanted = client.wants_metrics();
        if (wanted) client.answer("a 1\n");
        std::array<char, 4096> out{};
        const ssize_t count = ::read(ends[1], out.data(), out.size());
        const std::string_view answer(out.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
        require(wanted == answer.starts_with("HTTP/1.1 200"));
        require(answer.empty() || answer.starts_with("HTTP/1.1 "));
    }
    ::close(ends[1]);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    messages(text);
    panel_request(text);
    http(text);
    return 0;
}
