// What bench_reaction.py puts around the program that it measures, on the same board and so in the same time: a motor's line
// at 19200 baud that repeats its status without pause and shows the toggle of the last command (001 section 5.2), and a hand
// on an input line. Edges begin with SIGUSR1; it ends after the last one. usage: surroundings LINK PULL EDGES
#define _GNU_SOURCE
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/timerfd.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

enum { kCharacter = 520833, kInPosition = 0x10, kToggle = 0x80 };  // ns; bits of the status

static volatile sig_atomic_t begun;
static void begin(int signal) { (void)signal, begun = 1; }

static int open_line(const char* link) {
    struct termios mode;
    const int line = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK);
    if (line < 0 || grantpt(line) != 0 || unlockpt(line) != 0) exit(3);
    // Its other end stays open here too, so that it does not hang up between two programs.
    const int other = open(ptsname(line), O_RDWR | O_NOCTTY);
    if (other < 0 || tcgetattr(other, &mode) != 0) exit(3);
    cfmakeraw(&mode);
    if (tcsetattr(other, TCSANOW, &mode) != 0 || (unlink(link), symlink(ptsname(line), link)) != 0) exit(3);
    return line;
}

int main(int argc, char** argv) {
    if (argc != 4) return 2;
    const int pull = open(argv[2], O_WRONLY), timer = timerfd_create(CLOCK_MONOTONIC, 0), line = open_line(argv[1]);
    const struct itimerspec pace = {{0, kCharacter}, {0, kCharacter}};
    signal(SIGUSR1, begin);
    if (pull < 0 || timerfd_settime(timer, 0, &pace, NULL) != 0) return 3;
    int edges = atoi(argv[3]), characters = 0;
    uint8_t status = kInPosition, heard[64];
    unsigned chance = 1;
    for (int level = 0; edges > 0;) {
        uint64_t passed;
        if (read(timer, &passed, sizeof passed) < 0) continue;
        for (ssize_t count = read(line, heard, sizeof heard); count > 0; count = 0)
            status = kInPosition | (heard[count - 1] & kToggle);
        if (write(line, &status, 1) < 0) continue;
        if (!begun || --characters > 0) continue;
        // 20 to 30 ms to the next edge, and somewhere between two characters.
        chance = chance * 1103515245 + 12345;
        characters = 39 + (int)(chance >> 16) % 19;
        const struct timespec moment = {0, (chance >> 8) % (kCharacter / 2)};
        nanosleep(&moment, NULL);
        level = !level;
        if (pwrite(pull, level ? "pull-up" : "pull-down", level ? 7 : 9, 0) < 0) return 4;
        --edges;
    }
    const struct timespec last = {0, 20000000};
    nanosleep(&last, NULL);
    return 0;
}
