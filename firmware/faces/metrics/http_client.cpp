#include "http_client.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>

namespace nplc::metrics {
namespace {

constexpr std::string_view kEnd = "\r\n\r\n";
constexpr const char* kText = "text/plain; charset=utf-8";

}  // namespace

HttpClient::~HttpClient() {
    ::close(descriptor_);
}

short HttpClient::events() const {
    if (!out_.empty()) return POLLOUT;
    return wants_metrics_ ? short{0} : POLLIN;
}

void HttpClient::serve(short events, base::Instant now) {
    if ((events & POLLIN) != 0 && out_.empty() && !wants_metrics_) read();
    if ((events & (POLLERR | POLLNVAL)) != 0) is_gone_ = true;
    if ((events & POLLOUT) != 0) send();
    if (now > ends()) is_gone_ = true;
}

void HttpClient::read() {
    const ssize_t count = ::recv(descriptor_, &in_[have_], in_.size() - have_, 0);
    if (count > 0) {
        have_ += static_cast<std::size_t>(count);
        look();
    } else if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
        is_gone_ = true;
    }
}

/// Only the request line is evaluated: METHOD TARGET HTTP/1.x (RFC 9112 §3).
void HttpClient::look() {
    const std::string_view head(in_.data(), have_);
    if (head.find(kEnd) == std::string_view::npos) {
        if (have_ == in_.size())
            refuse("431 Request Header Fields Too Large", "The request's head is too long.\n");
        return;
    }
    const std::string_view line = head.substr(0, head.find("\r\n"));
    const std::size_t first = line.find(' ');
    const std::size_t second = line.rfind(' ');
    if (first == std::string_view::npos || first == second || !line.substr(second + 1).starts_with("HTTP/1."))
        return refuse("400 Bad Request", "This is no request of HTTP/1.1.\n");
    const std::string_view method = line.substr(0, first);
    is_head_only_ = method == "HEAD";
    if (method != "GET" && !is_head_only_)
        return refuse("405 Method Not Allowed", "Metrics can only be read: GET /metrics.\n");
    std::string_view target = line.substr(first + 1, second - first - 1);
    target = target.substr(0, target.find('?'));
    if (target != "/metrics") return refuse("404 Not Found", "Metrics are at /metrics.\n");
    wants_metrics_ = true;
}

void HttpClient::refuse(const char* status, const char* text) {
    respond(status, kText, text);
}

void HttpClient::answer(const std::string& body) {
    wants_metrics_ = false;
    respond("200 OK", "text/plain; version=0.0.4; charset=utf-8", body);
}

void HttpClient::respond(const std::string& status, const std::string& type, const std::string& body) {
    out_ = fmt::format(
        "HTTP/1.1 {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-store\r\nConnection: "
        "close\r\n{}\r\n",
        status, type, body.size(), status.starts_with("405") ? "Allow: GET, HEAD\r\n" : "");
    if (!is_head_only_) out_ += body;
    send();
}

void HttpClient::send() {
    const ssize_t count = ::send(descriptor_, out_.data(), out_.size(), MSG_NOSIGNAL);
    if (count > 0) {
        out_.erase(0, static_cast<std::size_t>(count));
        if (!out_.empty()) return;
        ::shutdown(descriptor_, SHUT_WR);
        is_gone_ = true;
    } else if (errno != EAGAIN && errno != EINTR) {
        is_gone_ = true;
    }
}

}  // namespace nplc::metrics
