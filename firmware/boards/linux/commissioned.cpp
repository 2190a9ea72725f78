#include "commissioned.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "base/crc32.h"
#include "hal_linux/quiet_thread.h"
#include "hal_linux/whole_file.h"

namespace nplc::boards {
namespace {

using std::chrono::sys_seconds;

constexpr std::string_view kListMagic = "NPC1\n";
/// No axis can have this name.
constexpr const char* kListFile = "/commissioned.txt";
/// Far more than the names of all axes.
constexpr std::size_t kLongestList = std::size_t{16} * 1024;
constexpr std::size_t kListCheck = 9;  ///< CRC-32 in hexadecimal, end of line

std::span<const std::uint8_t> as_bytes_of(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string check_of(std::string_view text) {
    return fmt::format("{:08x}\n", base::crc32(as_bytes_of(text)));
}

using Entries = std::map<std::string, sys_seconds>;

std::optional<Entries> entries_in(std::string_view text) {
    if (text.size() < kListMagic.size() + kListCheck) return std::nullopt;
    std::string_view rest = text.substr(0, text.size() - kListCheck);
    if (text.substr(rest.size()) != check_of(rest) || !rest.starts_with(kListMagic)) return std::nullopt;
    Entries entries;
    for (rest.remove_prefix(kListMagic.size()); !rest.empty();) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(rest.size(), line.size() + 1));
        std::int64_t second = 0;
        const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), second);
        const std::string_view name = line.substr(static_cast<std::size_t>(end - line.data()));
        if (error != std::errc() || name.size() < 2 || name[0] != ' ') return std::nullopt;
        entries[std::string(name.substr(1))] = sys_seconds(std::chrono::seconds(second));
    }
    return entries;
}

struct List {
    Entries entries{};
    std::string fault{};
};

List read_list(const std::string& path) {
    const int file = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return {{}, errno == ENOENT ? "" : path + ": cannot be read: " + std::strerror(errno)};
    std::string text(kLongestList + 1, '\0');
    const ssize_t count = ::pread(file, text.data(), text.size(), 0);
    const int reason = errno;
    ::close(file);
    if (count < 0) return {{}, path + ": cannot be read: " + std::strerror(reason)};
    text.resize(static_cast<std::size_t>(count));
    auto entries = entries_in(text);
    if (!entries) return {{}, path + ": is damaged"};
    return {*std::move(entries), {}};
}

}  // namespace

CommissionedAxes::CommissionedAxes(const std::string& state_directory, Clock clock)
    : path_(state_directory + kListFile), clock_(clock) {
    List list = read_list(path_);
    found_ = std::move(list.entries);
    fault_ = std::move(list.fault);
}

CommissionedAxes::~CommissionedAxes() {
    while (thread_.joinable()) {
        thread_.join();
        if (is_due_) begin_write();
    }
}

sys_seconds CommissionedAxes::now_by_clock() {
    return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
}

std::optional<sys_seconds> CommissionedAxes::since(const std::string& axis) const {
    for (const Entries* entries : {&entered_, &found_}) {
        if (const auto it = entries->find(axis); it != entries->end()) return it->second;
    }
    return std::nullopt;
}

void CommissionedAxes::enter(const std::string& axis) {
    entered_[axis] = clock_();
    is_due_ = true;
    begin_write();
}

void CommissionedAxes::begin_write() {
    if (thread_.joinable()) return;
    is_due_ = false;
    is_written_ = false;
    thread_ = hal_linux::start_quiet_thread([this, entries = entered_] {
        error_ = write(path_, entries);
        is_written_ = true;
    });
}

std::optional<std::string> CommissionedAxes::poll() {
    if (!thread_.joinable() || !is_written_) return std::nullopt;
    thread_.join();
    std::string error = std::move(error_);
    if (is_due_) begin_write();
    return error;
}

std::string CommissionedAxes::write(const std::string& path, Entries entries) {
    entries.merge(read_list(path).entries);
    std::string text(kListMagic);
    for (const auto& [axis, since] : entries)
        text += fmt::format("{} {}\n", since.time_since_epoch().count(), axis);
    text += check_of(text);
    if (hal_linux::make_whole_file(path, as_bytes_of(text))) return {};
    return path + ": cannot be written: " + std::strerror(errno);
}

}  // namespace nplc::boards
