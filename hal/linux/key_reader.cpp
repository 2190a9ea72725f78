#include "hal_linux/key_reader.h"

#include <poll.h>
#include <termios.h>
#include <unistd.h>

namespace nplc::hal_linux {

struct KeyReader::SavedMode {
    termios mode{};
};

KeyReader::KeyReader() {
    termios mode{};
    if (isatty(STDIN_FILENO) == 0 || tcgetattr(STDIN_FILENO, &mode) != 0) return;
    saved_ = std::make_unique<SavedMode>(SavedMode{mode});
    mode.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
    mode.c_cc[VMIN] = 0;
    mode.c_cc[VTIME] = 0;
    tcsetattr(STDIN_FILENO, TCSANOW, &mode);
}

KeyReader::~KeyReader() {
    if (saved_ != nullptr) tcsetattr(STDIN_FILENO, TCSANOW, &saved_->mode);
}

std::optional<char> KeyReader::key(std::chrono::milliseconds wait, int other) {
    pollfd watched[] = {{.fd = saved_ != nullptr ? STDIN_FILENO : -1, .events = POLLIN, .revents = 0},
                        {.fd = other, .events = POLLIN, .revents = 0}};
    const pollfd& input = watched[0];
    if (poll(watched, 2, static_cast<int>(wait.count())) <= 0) return std::nullopt;
    char key = 0;
    if ((input.revents & POLLIN) != 0 && read(STDIN_FILENO, &key, 1) == 1) return key;
    if ((input.revents & POLLHUP) != 0) saved_.reset();
    return std::nullopt;
}

}  // namespace nplc::hal_linux
