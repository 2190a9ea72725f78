#include "host/terminal.h"

#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace nplc::host {

void prepare_streams() {}

bool is_terminal(std::FILE* stream) {
    return ::isatty(::fileno(stream)) != 0;
}

std::size_t terminal_columns() {
    winsize size{};
    const bool known = ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1;
    return known ? size.ws_col : 80;
}

bool input_within(base::Milliseconds wait) {
    pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    return ::poll(&input, 1, static_cast<int>(wait.count())) > 0;
}

std::size_t read_input(std::span<char> into) {
    const auto count = ::read(STDIN_FILENO, into.data(), into.size());
    return count > 0 ? static_cast<std::size_t>(count) : 0;
}

bool output_has_reader() {
    pollfd output{.fd = STDOUT_FILENO, .events = 0, .revents = 0};
    return ::poll(&output, 1, 0) <= 0 || (output.revents & (POLLERR | POLLHUP)) == 0;
}

}  // namespace nplc::host
