#include "journal.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace nplc::boards {
namespace {

/// JOURNAL_STREAM is DEVICE:INODE of what the service was started with.
bool stderr_is_journal() {
    const char* stream = std::getenv("JOURNAL_STREAM");
    struct stat status {};
    if (stream == nullptr || ::fstat(STDERR_FILENO, &status) != 0) return false;
    return fmt::format("{}:{}", status.st_dev, status.st_ino) == stream;
}

}  // namespace

Journal::Journal(LogLevel most) : most_(most), with_levels_(stderr_is_journal()) {}

void Journal::write(LogLevel level, const std::string& text) {
    if (!writes(level)) return;
    const std::string prefix = with_levels_ ? fmt::format("<{}>", static_cast<int>(level)) : "";
    const std::string line = prefix + text + "\n";
    // One write a line: nothing is held back, and lines of other programs do not mix in.
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, line.data(), line.size());
}

}  // namespace nplc::boards
