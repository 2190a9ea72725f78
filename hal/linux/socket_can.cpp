#include "hal_linux/socket_can.h"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <sys/epoll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <vector>

#include "can_link.h"

namespace nplc::hal_linux {
namespace {

using ports::CanFrame;
using ports::CanState;

can_frame kernels(const CanFrame& frame) {
    can_frame out{};
    out.can_id = frame.id | (frame.extended ? CAN_EFF_FLAG : 0U) | (frame.remote ? CAN_RTR_FLAG : 0U);
    out.len = frame.length;
    if (!frame.remote) std::copy_n(frame.data.begin(), frame.length, out.data);
    return out;
}

CanFrame ours(const can_frame& frame) {
    CanFrame out{};
    out.extended = (frame.can_id & CAN_EFF_FLAG) != 0;
    out.remote = (frame.can_id & CAN_RTR_FLAG) != 0;
    out.id = frame.can_id & (out.extended ? CAN_EFF_MASK : CAN_SFF_MASK);
    out.length = std::min<std::uint8_t>(frame.len, CAN_MAX_DLEN);
    if (!out.remote) std::copy_n(frame.data, out.length, out.data.begin());
    return out;
}

void count(std::uint32_t& counter) {
    if (counter < std::numeric_limits<std::uint32_t>::max()) ++counter;
}

/// From the controller part of an error frame; `before` if it has none.
CanState state_of(std::uint8_t controller, CanState before) {
    if ((controller & (CAN_ERR_CRTL_TX_PASSIVE | CAN_ERR_CRTL_RX_PASSIVE)) != 0) return CanState::passive;
    if ((controller & (CAN_ERR_CRTL_TX_WARNING | CAN_ERR_CRTL_RX_WARNING)) != 0) return CanState::warning;
    if ((controller & CAN_ERR_CRTL_ACTIVE) != 0) return CanState::active;
    return before;
}

/// 0.5 %: the allowed difference between two nodes.
bool fits_bitrate(std::uint32_t made, std::uint32_t wanted) {
    return std::abs(std::int64_t{made} - std::int64_t{wanted}) * 200 <= std::int64_t{wanted};
}

std::string set_up_words(const CanSettings& settings) {
    return "ip link set " + settings.interface + " down && ip link set " + settings.interface +
           " type can bitrate " + std::to_string(*settings.bitrate) + " restart-ms 100 && ip link set " +
           settings.interface + " up";
}

/// Empty if the interface matches the settings.
std::string misfit(const CanSettings& settings, const std::optional<CanLink>& link) {
    const std::string& name = settings.interface;
    if (!link)
        return "there is no interface '" + name + "'; `ip -o link | grep link/can` lists those for CAN";
    if (!link->is_can) return name + " is not an interface for CAN; `ip -o link | grep link/can` lists those";
    if (!settings.bitrate || !link->bitrate) return {};
    if (*link->bitrate == 0) return name + " has no bit rate yet; as root: " + set_up_words(settings);
    if (!fits_bitrate(*link->bitrate, *settings.bitrate))
        return name + " is set to " + std::to_string(*link->bitrate) + " bit/s, not to " +
               std::to_string(*settings.bitrate) + "; as root: " + set_up_words(settings);
    return {};
}

bool set_filters(int socket, const std::vector<can_filter>& filters) {
    return ::setsockopt(socket, SOL_CAN_RAW, CAN_RAW_FILTER, filters.data(),
                        static_cast<socklen_t>(filters.size() * sizeof(can_filter))) == 0;
}

/// Bound to the interface, with error frames and the counter of lost frames.
FileDescriptor open_raw(int index, const std::optional<std::vector<can_filter>>& filters) {
    FileDescriptor raw(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
    constexpr can_err_mask_t kErrors = CAN_ERR_MASK;
    constexpr int kOn = 1;
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = index;
    const bool ready =
        raw && ::setsockopt(raw.get(), SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &kErrors, sizeof kErrors) == 0 &&
        ::setsockopt(raw.get(), SOL_SOCKET, SO_RXQ_OVFL, &kOn, sizeof kOn) == 0 &&
        (!filters || set_filters(raw.get(), *filters)) &&
        ::bind(raw.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
    if (!ready) {
        const int reason = errno;
        raw.close();
        errno = reason;
    }
    return raw;
}

bool watch(int epoll, int descriptor) {
    epoll_event event{};
    event.events = EPOLLIN;
    return ::epoll_ctl(epoll, EPOLL_CTL_ADD, descriptor, &event) == 0;
}

}  // namespace

struct SocketCan::Inside {
    explicit Inside(const CanSettings& wanted) : settings(wanted), both(::epoll_create1(EPOLL_CLOEXEC)) {}

    enum class Got : std::uint8_t { frame, other, nothing };
    Got receive(CanFrame& frame);
    void take_error_frame(const can_frame& frame);
    void take_lost(const msghdr& message);
    bool take_changes();
    void set_state(CanState state_now);
    void lose();
    bool hears_changes();

    CanSettings settings;
    FileDescriptor both;  ///< epoll
    LinkChanges changes{};
    bool hears = false;    ///< `changes` is among `both`
    FileDescriptor raw{};  ///< none while the interface is gone
    int index = 0;
    CanState state = CanState::down;
    ports::CanFaults faults{};
    std::uint32_t lost_before = 0;
    std::optional<std::vector<can_filter>> filters{};
};

SocketCan::Inside::Got SocketCan::Inside::receive(CanFrame& frame) {
    can_frame received{};
    iovec place{.iov_base = &received, .iov_len = sizeof received};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(std::uint32_t))> beside{};
    msghdr message{};
    message.msg_iov = &place;
    message.msg_iovlen = 1;
    message.msg_control = beside.data();
    message.msg_controllen = beside.size();
    const ssize_t size = ::recvmsg(raw.get(), &message, MSG_DONTWAIT);
    if (size == static_cast<ssize_t>(sizeof received)) {
        take_lost(message);
        if ((received.can_id & CAN_ERR_FLAG) != 0) {
            take_error_frame(received);
            return Got::other;
        }
        frame = ours(received);
        return Got::frame;
    }
    if (size >= 0) return Got::other;
    if (errno == ENETDOWN) {
        set_state(CanState::down);
        return Got::other;
    }
    if (errno == ENODEV || errno == ENXIO) lose();
    return Got::nothing;
}

void SocketCan::Inside::take_lost(const msghdr& message) {
    const cmsghdr* note = CMSG_FIRSTHDR(&message);
    if (note == nullptr || note->cmsg_level != SOL_SOCKET || note->cmsg_type != SO_RXQ_OVFL) return;
    std::uint32_t lost = 0;
    std::memcpy(&lost, CMSG_DATA(note), sizeof lost);
    const std::uint32_t more = lost - lost_before;
    lost_before = lost;
    faults.overruns += std::min(more, std::numeric_limits<std::uint32_t>::max() - faults.overruns);
}

void SocketCan::Inside::take_error_frame(const can_frame& frame) {
    if ((frame.can_id & (CAN_ERR_PROT | CAN_ERR_ACK | CAN_ERR_BUSERROR)) != 0) count(faults.bus_errors);
    if ((frame.can_id & CAN_ERR_CRTL) != 0) {
        if ((frame.data[1] & CAN_ERR_CRTL_RX_OVERFLOW) != 0) count(faults.overruns);
        set_state(state_of(frame.data[1], state));
    }
    if ((frame.can_id & CAN_ERR_BUSOFF) != 0) set_state(CanState::bus_off);
    if ((frame.can_id & CAN_ERR_RESTARTED) != 0) set_state(CanState::active);
}

void SocketCan::Inside::set_state(CanState state_now) {
    if (state_now == CanState::bus_off && state != CanState::bus_off) count(faults.bus_offs);
    state = state_now;
}

void SocketCan::Inside::lose() {
    raw.close();
    set_state(CanState::down);
}

bool SocketCan::Inside::hears_changes() {
    hears = hears || (both && watch(both.get(), changes.descriptor()));
    return hears;
}

/// False if there were none. The present state is read, since an error frame may be newer than the change.
bool SocketCan::Inside::take_changes() {
    if (!changes.take()) return false;
    const std::optional<CanLink> link = can_link(settings.interface);
    if (!link || link->index != index)
        lose();
    else if (raw)
        set_state(link->state);
    return true;
}

SocketCan::SocketCan(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
SocketCan::~SocketCan() = default;

SocketCan::Opened SocketCan::open(const CanSettings& settings) {
    std::unique_ptr<SocketCan> can = absent(settings);
    std::string error = can->reopen();
    if (!error.empty()) return {nullptr, std::move(error)};
    return {std::move(can), {}};
}

std::unique_ptr<SocketCan> SocketCan::absent(const CanSettings& settings) {
    return std::unique_ptr<SocketCan>(new SocketCan(std::make_unique<Inside>(settings)));
}

std::string SocketCan::reopen() {
    Inside& own = *inside_;
    own.lose();
    if (!own.hears_changes()) return own.settings.interface + ": cannot be watched: " + std::strerror(errno);
    std::optional<CanLink> link = can_link(own.settings.interface);
    if (std::string error = misfit(own.settings, link); !error.empty()) return error;
    FileDescriptor raw = open_raw(link->index, own.filters);
    if (!raw && errno == EAFNOSUPPORT) return "this kernel has no CAN; as root: modprobe can-raw";
    if (!raw || !watch(own.both.get(), raw.get()))
        return own.settings.interface + ": cannot be opened: " + std::strerror(errno);
    own.raw = std::move(raw);
    own.index = link->index;
    own.lost_before = 0;
    // Queried again, so that a change since the first query is not lost.
    link = can_link(own.settings.interface);
    own.set_state(link ? link->state : CanState::down);
    return {};
}

bool SocketCan::write(const CanFrame& frame) {
    Inside& own = *inside_;
    if (!base::is_valid(frame) || !own.raw || own.state == CanState::down || own.state == CanState::bus_off)
        return false;
    const can_frame out = kernels(frame);
    return ::send(own.raw.get(), &out, sizeof out, MSG_DONTWAIT) == static_cast<ssize_t>(sizeof out);
}

bool SocketCan::read(CanFrame& frame) {
    Inside& own = *inside_;
    for (;;) {
        const Inside::Got got = own.raw ? own.receive(frame) : Inside::Got::nothing;
        if (got == Inside::Got::frame) return true;
        if (got == Inside::Got::nothing && !own.take_changes()) return false;
    }
}

bool SocketCan::filter(std::span<const ports::CanFilter> filters) {
    Inside& own = *inside_;
    std::vector<can_filter> wanted;
    for (const ports::CanFilter& one : filters) {
        const canid_t format = one.extended ? CAN_EFF_FLAG : 0U;
        const canid_t bits = one.extended ? CAN_EFF_MASK : CAN_SFF_MASK;
        wanted.push_back({(one.id & bits) | format, (one.mask & bits) | CAN_EFF_FLAG});
    }
    if (wanted.size() > CAN_RAW_FILTER_MAX || (own.raw && !set_filters(own.raw.get(), wanted))) return false;
    own.filters = std::move(wanted);
    return true;
}

CanState SocketCan::state() {
    return inside_->state;
}

ports::CanFaults SocketCan::faults() {
    return inside_->faults;
}

bool SocketCan::restart() {
    Inside& own = *inside_;
    const std::string& name = own.settings.interface;
    restart_problem_.clear();
    if (own.state != CanState::bus_off) {
        restart_problem_ = name + " is not off the bus";
        return false;
    }
    const int error = restart_can(own.index);
    if (error == EBUSY) {
        if (const auto link = can_link(name)) own.set_state(link->state);
        restart_problem_ = name + " is not off the bus";
    } else if (error == EPERM)
        restart_problem_ =
            name + ": a restart from here needs CAP_NET_ADMIN; with restart-ms the kernel does it";
    else if (error == EINVAL)
        restart_problem_ = name + ": the kernel restarts it by itself (restart-ms), or it is down";
    else if (error != 0)
        restart_problem_ = name + ": cannot be restarted: " + std::strerror(error);
    return error == 0;
}

int SocketCan::descriptor() const {
    return inside_->both.get();
}

bool SocketCan::gone() const {
    return !inside_->raw;
}

}  // namespace nplc::hal_linux
