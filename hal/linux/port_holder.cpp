#include "port_holder.h"

#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <linux/sock_diag.h>
#include <linux/unix_diag.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <vector>

#include "file_descriptor.h"

namespace nplc::hal_linux {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kEstablished = 1;  // socket state, as in /proc/net/tcp

bool has_open(const fs::path& process, const std::function<bool(const struct stat&)>& is_it) {
    std::error_code error;
    for (fs::directory_iterator entry(process / "fd", error), end; !error && entry != end;
         entry.increment(error)) {
        struct stat status {};
        if (::stat(entry->path().c_str(), &status) == 0 && is_it(status)) return true;
    }
    return false;
}

std::string program_with_one_of(const std::vector<ino_t>& sockets) {
    if (sockets.empty()) return {};
    return program_with([&](const struct stat& status) {
        return S_ISSOCK(status.st_mode) &&
               std::find(sockets.begin(), sockets.end(), status.st_ino) != sockets.end();
    });
}

/// Queries the kernel for connected sockets of this family; calls `take` for each answer.
void list_unix_sockets(const std::function<void(const nlmsghdr&)>& take) {
    const FileDescriptor kernel(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_SOCK_DIAG));
    if (!kernel) return;
    struct {
        nlmsghdr header;
        unix_diag_req request;
    } question{};
    question.header.nlmsg_len = sizeof question;
    question.header.nlmsg_type = SOCK_DIAG_BY_FAMILY;
    question.header.nlmsg_flags = NLM_F_REQUEST | NLM_F_DUMP;
    question.request.sdiag_family = AF_UNIX;
    question.request.udiag_states = 1U << kEstablished;
    question.request.udiag_show = UDIAG_SHOW_NAME | UDIAG_SHOW_PEER;
    if (::send(kernel.get(), &question, sizeof question, 0) < 0) return;
    alignas(nlmsghdr) std::array<char, 32'768> answer{};
    for (;;) {
        const ssize_t got = ::recv(kernel.get(), answer.data(), answer.size(), 0);
        if (got <= 0) return;
        auto left = static_cast<std::size_t>(got);
        std::size_t at = 0;
        while (left >= sizeof(nlmsghdr)) {
            nlmsghdr header{};
            std::memcpy(&header, &answer[at], sizeof header);
            if (header.nlmsg_type == NLMSG_DONE || header.nlmsg_type == NLMSG_ERROR ||
                header.nlmsg_len < sizeof header || header.nlmsg_len > left)
                return;
            take(*reinterpret_cast<const nlmsghdr*>(&answer[at]));
            const std::size_t step = std::min<std::size_t>(NLMSG_ALIGN(header.nlmsg_len), left);
            at += step;
            left -= step;
        }
    }
}

/// The other end of a connection whose near end has this name; 0 for other connections.
ino_t peer_of(const nlmsghdr& message, const std::string& path) {
    const auto* bytes = reinterpret_cast<const char*>(&message);
    std::string name;
    std::uint32_t peer = 0;
    for (std::size_t at = NLMSG_LENGTH(NLMSG_ALIGN(sizeof(unix_diag_msg)));
         at + sizeof(rtattr) <= message.nlmsg_len;) {
        rtattr attribute{};
        std::memcpy(&attribute, bytes + at, sizeof attribute);
        if (attribute.rta_len < sizeof attribute || at + attribute.rta_len > message.nlmsg_len) break;
        const char* data = bytes + at + RTA_LENGTH(0);
        const std::size_t size = attribute.rta_len - RTA_LENGTH(0);
        if (attribute.rta_type == UNIX_DIAG_NAME) name.assign(data, ::strnlen(data, size));
        if (attribute.rta_type == UNIX_DIAG_PEER && size == sizeof peer) std::memcpy(&peer, data, size);
        at += RTA_ALIGN(attribute.rta_len);
    }
    return name == path ? peer : 0;
}

}  // namespace

std::string program_with(const std::function<bool(const struct stat&)>& is_it) {
    std::error_code error;
    for (fs::directory_iterator process("/proc", error), end; !error && process != end;
         process.increment(error)) {
        const std::string number = process->path().filename();
        if (number.find_first_not_of("0123456789") != std::string::npos ||
            number == std::to_string(::getpid()) || !has_open(process->path(), is_it))
            continue;
        std::string name = "a program";
        std::ifstream(process->path() / "comm") >> name;
        return name.append(" (process ").append(number).append(")");
    }
    return {};
}

std::string client_of_unix(const std::string& path) {
    std::vector<ino_t> clients;
    list_unix_sockets([&](const nlmsghdr& message) {
        if (const ino_t peer = peer_of(message, path); peer != 0) clients.push_back(peer);
    });
    return program_with_one_of(clients);
}

std::string client_of_tcp(std::uint16_t port) {
    std::ifstream table("/proc/net/tcp");
    std::vector<ino_t> clients;
    std::string line;
    std::getline(table, line);  // the heading
    while (std::getline(table, line)) {
        std::istringstream words(line);
        std::array<std::string, 10> word;  // 2: the other end, 3: the state, 9: the inode
        for (std::string& one : word) words >> one;
        const auto colon = word[2].find(':');
        if (!words || colon == std::string::npos) continue;
        const bool ours = std::strtoul(word[2].c_str() + colon + 1, nullptr, 16) == port &&
                          std::strtoul(word[3].c_str(), nullptr, 16) == kEstablished;
        if (ours) clients.push_back(std::strtoul(word[9].c_str(), nullptr, 10));
    }
    return program_with_one_of(clients);
}

}  // namespace nplc::hal_linux
