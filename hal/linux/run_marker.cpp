#include "hal_linux/run_marker.h"

#include <fcntl.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "base/crc32.h"
#include "file_descriptor.h"
#include "hal_linux/whole_file.h"

namespace nplc::hal_linux {
namespace {

const std::string kFresh = "fresh/2";
const std::string kEnded = "ended/2";
const std::string kRunning = "runs/2 ";
const std::string kCrashed = "crash/2";
/// Written by the previous version.
const std::string kOldFresh = "fresh  ";
const std::string kOldEnded = "ended  ";
const std::string kOldRunning = "running";

constexpr std::size_t kBoot = 36;
constexpr std::size_t kChecked = 7 + 1 + kBoot + 1;  ///< "running BOOT "
constexpr std::size_t kBytes = kChecked + 8 + 1;     ///< and CRC-32 in hexadecimal, end of line

std::span<const std::uint8_t> bytes_of(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

std::string with_check(std::string checked) {
    std::array<char, 10> check{};
    std::snprintf(check.data(), check.size(), "%08x\n",
                  static_cast<unsigned>(base::crc32(bytes_of(checked))));
    return std::move(checked) + check.data();
}

std::string boot_of_this_machine() {
    std::ifstream file("/proc/sys/kernel/random/boot_id");
    std::string boot;
    std::getline(file, boot);
    boot.resize(kBoot, '-');
    return boot;
}

}  // namespace

RunMarker::RunMarker(std::string path) : path_(std::move(path)), boot_(boot_of_this_machine()) {
    look();
}

void RunMarker::look() {
    const FileDescriptor file(::open(path_.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (!file) {
        if (errno == ENOENT) found_ = Found::missing;
        return;
    }
    std::string text(kBytes + 1, '\0');
    if (::pread(file.get(), text.data(), text.size(), 0) != static_cast<ssize_t>(kBytes)) return;
    text.resize(kBytes);
    if (text != with_check(text.substr(0, kChecked))) return;
    const auto is = [&text](const std::string& word) { return text.starts_with(word); };
    if (is(kFresh) || is(kOldFresh)) found_ = Found::fresh;
    if (is(kEnded) || is(kOldEnded)) found_ = Found::ended;
    if (is(kRunning) || is(kOldRunning)) found_ = Found::running;
    if (is(kCrashed)) found_ = Found::crashed;
    is_whole_ = true;
    is_old_ = is(kOldFresh) || is(kOldEnded) || is(kOldRunning);
    of_this_boot_ = text.compare(kRunning.size() + 1, kBoot, boot_) == 0;
}

std::string RunMarker::make() {
    return write(kFresh);
}

std::string RunMarker::set() {
    return write(kRunning);
}

std::string RunMarker::clear() {
    return write(kEnded);
}

std::string RunMarker::note_crash() {
    return write(kCrashed);
}

std::string RunMarker::write(const std::string& state) {
    const std::string text = with_check(state + " " + boot_ + " ");
    if (is_whole_ ? overwrite(path_, bytes_of(text)) : make_whole_file(path_, bytes_of(text))) {
        is_whole_ = true;
        return {};
    }
    return path_ + ": cannot be written: " + std::strerror(errno);
}

}  // namespace nplc::hal_linux
