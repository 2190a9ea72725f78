#include "tcp_client.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <span>

namespace nplc::modbus {
namespace {

/// Timeout for the rest of a message, and for sending an answer.
constexpr base::Milliseconds kPatience{10'000};
constexpr int kMostAtOnce = 8;

}  // namespace

TcpClient::TcpClient(int descriptor, UnitSet& set, const std::string& name, faces::Bell& bell,
                     const Moment& since)
    : descriptor_(descriptor),
      set_(set),
      session_(set.units(), name, bell),
      heard_(since.now),
      began_(since.now),
      silent_at_(since.arrived) {}

TcpClient::~TcpClient() {
    ::close(descriptor_);
}

short TcpClient::events() const {
    if (!out_.empty()) return POLLOUT;
    return have_ < in_.size() && !session_.is_waiting() ? short{POLLIN | POLLRDHUP} : short{0};
}

base::Instant TcpClient::due(base::Instant now) const {
    if (session_.is_waiting()) return now + UnitSet::kBetweenLooks;
    if (asks_image_) return std::max(now, image_asked_ + base::Milliseconds(1));
    if ((has_more_ || have_ >= kMostFrame) && out_.empty() && !session_.is_waiting()) return now;
    return have_ != 0 || !out_.empty() ? began_ + kPatience : base::kNever;
}

void TcpClient::read(base::Instant now) {
    arrived_ = silent_at_;
    const std::size_t room = in_.size() - have_;
    const ssize_t count = ::recv(descriptor_, &in_[have_], room, 0);
    if (count > 0) {
        have_ += static_cast<std::size_t>(count);
        if (static_cast<std::size_t>(count) < room) silent_at_ = now;
    } else if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
        is_gone_ = true;
    }
}

void TcpClient::serve(short events, base::Instant now) {
    if (have_ == 0 && out_.empty()) began_ = now;
    const bool was_asked = (this->events() & POLLIN) != 0;
    if ((events & POLLRDHUP) != 0) has_left_ = true;
    if ((events & POLLIN) != 0)
        read(now);
    else if (was_asked)
        silent_at_ = now;
    if ((events & (POLLERR | POLLHUP | POLLNVAL)) != 0) is_gone_ = true;
    if (const auto answer = session_.take(now)) put(*answer);
    if (session_.is_waiting() && has_stop_behind()) put(session_.put_aside());
    if (!out_.empty()) send();
    int served = 0;
    while (served < kMostAtOnce && out_.empty() && !is_gone_ && serve_one(now)) {
        began_ = now;
        ++served;
    }
    has_more_ = served == kMostAtOnce;
    if (!session_.is_waiting() && now - began_ > kPatience && (have_ != 0 || !out_.empty())) is_gone_ = true;
}

/// Whether a stop has arrived behind the request in progress. What is not read yet stays unread, so that the
/// age of what stands before it is known.
bool TcpClient::has_stop_behind() const {
    std::array<std::uint8_t, 8 * kMostFrame> bytes{};
    std::copy_n(in_.begin(), have_, bytes.begin());
    const ssize_t more = ::recv(descriptor_, &bytes[have_], bytes.size() - have_, MSG_PEEK);
    const std::span all =
        std::span(bytes).first(have_ + static_cast<std::size_t>(std::max<ssize_t>(more, 0)));
    for (std::size_t at = 0; all.size() - at > kHead;) {
        const std::size_t length = std::size_t{all[at + 4]} << 8 | all[at + 5];
        const std::size_t end = at + kHead - 1 + length;
        if (all[at + 2] != 0 || all[at + 3] != 0 || length < 2 || length > kMostPdu + 1 || end > all.size())
            return false;
        if (Session::asks_stop(all.subspan(at + kHead, length - 1))) return true;
        at = end;
    }
    return false;
}

/// For all axes, since a message may be for any of them.
bool TcpClient::waits_for_image(base::Instant now) {
    const bool is_old = !set_.is_fresh(now);
    if (is_old && !asks_image_) image_asked_ = now;
    asks_image_ = is_old && now - image_asked_ < UnitSet::kImageWait;
    return asks_image_;
}

/// True if a message was answered or dropped.
bool TcpClient::serve_one(base::Instant now) {
    if (session_.is_waiting() || have_ < kHead) return false;
    const std::size_t length = std::size_t{in_[4]} << 8 | in_[5];
    // Not Modbus, or out of sync: the next message cannot be found.
    if (in_[2] != 0 || in_[3] != 0 || length < 2 || length > kMostPdu + 1) {
        is_gone_ = true;
        return false;
    }
    const std::size_t size = kHead - 1 + length;
    if (have_ < size || waits_for_image(now)) return false;
    heard_ = now;
    std::copy_n(in_.begin(), kHead, head_.begin());
    // A message of a disconnected client counts as infinitely old, so that it is not carried out.
    const Moment moment{.now = now, .arrived = has_left_ ? base::Instant{} : arrived_};
    const auto answer = session_.serve(in_[6], std::span(in_).subspan(kHead, length - 1), moment);
    std::copy(in_.begin() + static_cast<std::ptrdiff_t>(size),
              in_.begin() + static_cast<std::ptrdiff_t>(have_), in_.begin());
    have_ -= size;
    if (answer) put(*answer);
    return true;
}

void TcpClient::put(const Answer& answer) {
    const std::size_t length = answer.bytes().size() + 1;
    out_.assign(head_.begin(), head_.end());
    out_[4] = static_cast<std::uint8_t>(length >> 8);
    out_[5] = static_cast<std::uint8_t>(length);
    out_.insert(out_.end(), answer.bytes().begin(), answer.bytes().end());
    send();
}

void TcpClient::send() {
    const ssize_t count = ::send(descriptor_, out_.data(), out_.size(), MSG_NOSIGNAL);
    if (count > 0) {
        out_.erase(out_.begin(), out_.begin() + count);
    } else if (errno != EAGAIN && errno != EINTR) {
        is_gone_ = true;
    }
}

}  // namespace nplc::modbus
