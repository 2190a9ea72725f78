#include "can_link.h"

#include <linux/can/netlink.h>
#include <linux/if.h>
#include <linux/if_arp.h>
#include <linux/rtnetlink.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <span>
#include <vector>

namespace nplc::hal_linux {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t kMessageRoom = 32'768;

template <class T>
std::optional<T> taken(Bytes bytes) {
    T value;
    if (bytes.size() < sizeof value) return std::nullopt;
    std::memcpy(&value, bytes.data(), sizeof value);
    return value;
}

/// The payload of the attribute of this type; empty if there is none.
Bytes attribute(Bytes all, unsigned type) {
    while (const auto head = taken<rtattr>(all)) {
        if (head->rta_len < sizeof(rtattr) || head->rta_len > all.size()) break;
        if ((head->rta_type & NLA_TYPE_MASK) == type)
            return all.subspan(sizeof(rtattr), head->rta_len - sizeof(rtattr));
        all = all.subspan(std::min<std::size_t>(RTA_ALIGN(head->rta_len), all.size()));
    }
    return {};
}

ports::CanState state_of(std::uint32_t kernels) {
    switch (kernels) {
        case CAN_STATE_ERROR_ACTIVE:
            return ports::CanState::active;
        case CAN_STATE_ERROR_WARNING:
            return ports::CanState::warning;
        case CAN_STATE_ERROR_PASSIVE:
            return ports::CanState::passive;
        case CAN_STATE_BUS_OFF:
            return ports::CanState::bus_off;
        default:
            return ports::CanState::down;
    }
}

/// `message`: the bytes after the header of an RTM_NEWLINK.
std::optional<CanLink> link_of(Bytes message) {
    const auto head = taken<ifinfomsg>(message);
    if (!head) return std::nullopt;
    const Bytes attributes =
        message.subspan(std::min<std::size_t>(NLMSG_ALIGN(sizeof(ifinfomsg)), message.size()));
    const Bytes data = attribute(attribute(attributes, IFLA_LINKINFO), IFLA_INFO_DATA);
    CanLink link{.index = head->ifi_index, .is_can = head->ifi_type == ARPHRD_CAN};
    const auto state = taken<std::uint32_t>(attribute(data, IFLA_CAN_STATE));
    if ((head->ifi_flags & IFF_UP) != 0) link.state = state ? state_of(*state) : ports::CanState::active;
    if (const auto timing = taken<can_bittiming>(attribute(data, IFLA_CAN_BITTIMING)))
        link.bitrate = timing->bitrate;
    else if (state)
        link.bitrate = 0;
    return link;
}

FileDescriptor open_netlink(unsigned groups) {
    FileDescriptor socket(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
    sockaddr_nl own{};
    own.nl_family = AF_NETLINK;
    own.nl_groups = groups;
    if (socket && ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&own), sizeof own) != 0)
        socket.close();
    return socket;
}

struct Answer {
    int error = 0;
    std::optional<CanLink> link{};
};

/// Parses the messages of one datagram.
Answer parse(Bytes datagram) {
    Answer answer;
    while (const auto head = taken<nlmsghdr>(datagram)) {
        if (head->nlmsg_len < sizeof(nlmsghdr) || head->nlmsg_len > datagram.size()) break;
        const Bytes body = datagram.subspan(sizeof(nlmsghdr), head->nlmsg_len - sizeof(nlmsghdr));
        if (head->nlmsg_type == NLMSG_ERROR) {
            const auto error = taken<nlmsgerr>(body);
            answer.error = error ? -error->error : EPROTO;
        } else if (head->nlmsg_type == RTM_NEWLINK) {
            answer.link = link_of(body);
        }
        datagram = datagram.subspan(std::min<std::size_t>(NLMSG_ALIGN(head->nlmsg_len), datagram.size()));
    }
    return answer;
}

/// A request with attributes, which may be nested.
class Request {
  public:
    Request(std::uint16_t type, std::uint16_t flags, int index) {
        nlmsghdr head{};
        head.nlmsg_type = type;
        head.nlmsg_flags = static_cast<std::uint16_t>(NLM_F_REQUEST | flags);
        append(&head, sizeof head);
        ifinfomsg body{};
        body.ifi_index = index;
        append(&body, sizeof body);
    }
    void add(unsigned short type, const void* payload, std::size_t size) {
        const std::size_t at = begin(type);
        append(payload, size);
        end(at);
    }
    std::size_t begin(unsigned short type) {
        const std::size_t at = bytes_.size();
        const rtattr head{0, type};
        append(&head, sizeof head);
        return at;
    }
    void end(std::size_t at) {
        const auto size = static_cast<unsigned short>(bytes_.size() - at);
        std::memcpy(bytes_.data() + at, &size, sizeof size);
        bytes_.resize(NLMSG_ALIGN(bytes_.size()));
    }

    /// The kernel answers before send returns.
    Answer ask() {
        const auto size = static_cast<std::uint32_t>(bytes_.size());
        std::memcpy(bytes_.data(), &size, sizeof size);
        const FileDescriptor socket = open_netlink(0);
        if (!socket || ::send(socket.get(), bytes_.data(), bytes_.size(), 0) < 0) return {.error = errno};
        std::vector<std::uint8_t> room(kMessageRoom);
        const ssize_t count = ::recv(socket.get(), room.data(), room.size(), 0);
        if (count < 0) return {.error = errno};
        return parse(Bytes(room).first(static_cast<std::size_t>(count)));
    }

  private:
    void append(const void* from, std::size_t size) {
        const auto* bytes = static_cast<const std::uint8_t*>(from);
        bytes_.insert(bytes_.end(), bytes, bytes + size);
    }

    std::vector<std::uint8_t> bytes_{};
};

}  // namespace

std::optional<CanLink> can_link(const std::string& name) {
    if (name.empty() || name.size() >= IFNAMSIZ) return std::nullopt;
    Request request(RTM_GETLINK, 0, 0);
    request.add(IFLA_IFNAME, name.c_str(), name.size() + 1);
    const Answer answer = request.ask();
    return answer.error == 0 ? answer.link : std::nullopt;
}

int restart_can(int index) {
    Request request(RTM_NEWLINK, NLM_F_ACK, index);
    const std::size_t info = request.begin(IFLA_LINKINFO);
    request.add(IFLA_INFO_KIND, "can", 3);
    const std::size_t data = request.begin(IFLA_INFO_DATA);
    const std::uint32_t now = 1;
    request.add(IFLA_CAN_RESTART, &now, sizeof now);
    request.end(data);
    request.end(info);
    return request.ask().error;
}

LinkChanges::LinkChanges() : socket_(open_netlink(RTMGRP_LINK)) {}

bool LinkChanges::take() {
    bool any = false;
    std::array<std::uint8_t, kMessageRoom> room;
    for (;;) {
        const ssize_t count = ::recv(socket_.get(), room.data(), room.size(), MSG_DONTWAIT);
        const bool some_were_lost = count < 0 && errno == ENOBUFS;
        if (count <= 0 && !some_were_lost) return any;
        any = true;
    }
}

}  // namespace nplc::hal_linux
