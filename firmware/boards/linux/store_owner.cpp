#include "store_owner.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "base/bytes.h"
#include "base/crc32.h"
#include "hal_linux/quiet_thread.h"
#include "hal_linux/whole_file.h"

namespace nplc::boards {
namespace {

constexpr std::string_view kMagic = "NPO1";
constexpr std::size_t kLongestName = 32;
constexpr std::size_t kHeader = kMagic.size() + 2;
constexpr std::size_t kMost = kHeader + kLongestName + 4;

std::span<const std::uint8_t> bytes_of(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string record_of(AutostartPermission permission, const std::string& axis) {
    std::string record(kMagic);
    record += static_cast<char>(permission);
    record += static_cast<char>(axis.size());
    record += axis;
    std::uint8_t check[4];
    base::store_u32(check, base::crc32(bytes_of(record)));
    record.append(reinterpret_cast<const char*>(check), sizeof check);
    return record;
}

}  // namespace

StoreOwner::StoreOwner(std::string store, std::string axis)
    : path_(std::move(store)), axis_(std::move(axis)) {
    look();
}

StoreOwner::~StoreOwner() {
    if (thread_.joinable()) thread_.join();
}

void StoreOwner::look() {
    const int file = ::open(path_.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    if (file < 0) return;
    std::string bytes(kMost, '\0');
    const ssize_t count = ::pread(file, bytes.data(), bytes.size(), kAddress);
    ::close(file);
    if (count != static_cast<ssize_t>(bytes.size())) return;
    if (std::all_of(bytes.begin(), bytes.end(), [](char byte) { return byte == '\xFF'; })) {
        found_ = Found::blank;
        return;
    }
    const std::size_t length = static_cast<std::uint8_t>(bytes[kHeader - 1]);
    const auto permission = static_cast<AutostartPermission>(bytes[kHeader - 2]);
    if (length > kLongestName || permission < AutostartPermission::first_run ||
        permission > AutostartPermission::lost)
        return;
    const std::string owner = bytes.substr(kHeader, length);
    if (!bytes.starts_with(record_of(permission, owner))) return;
    found_ = Found::whole;
    permission_ = permission;
    owner_ = owner;
}

std::string StoreOwner::write(AutostartPermission permission) {
    if (!hal_linux::overwrite(path_, bytes_of(record_of(permission, axis_)), kAddress))
        return path_ + ": cannot be written: " + std::strerror(errno);
    found_ = Found::whole;
    permission_ = permission;
    owner_ = axis_;
    return {};
}

void StoreOwner::begin_write(AutostartPermission permission) {
    is_written_ = false;
    thread_ = hal_linux::start_quiet_thread([this, permission] {
        error_ = write(permission);
        is_written_ = true;
    });
}

std::optional<std::string> StoreOwner::poll() {
    if (!thread_.joinable() || !is_written_) return std::nullopt;
    thread_.join();
    return error_;
}

}  // namespace nplc::boards
