// The smallest program that answers an edge of a GPIO line with a byte on a serial port: what bench_reaction.py holds
// nanoplc against. usage: smallest CHIP LINE TTY PRIORITY
#include <fcntl.h>
#include <linux/gpio.h>
#include <poll.h>
#include <sched.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <termios.h>
#include <unistd.h>

int main(int argc, char** argv) {
    if (argc != 5) return 2;
    const struct sched_param priority = {.sched_priority = atoi(argv[4])};
    struct gpioevent_request line = {.lineoffset = (unsigned)atoi(argv[2]),
                                     .handleflags = GPIOHANDLE_REQUEST_INPUT,
                                     .eventflags = GPIOEVENT_REQUEST_BOTH_EDGES,
                                     .consumer_label = "smallest"};
    struct termios mode;
    const int tty = open(argv[3], O_RDWR | O_NOCTTY);
    if (tty < 0 || tcgetattr(tty, &mode) != 0) return 3;
    cfmakeraw(&mode);
    cfsetspeed(&mode, B19200);
    mode.c_cflag |= CLOCAL;
    if (tcsetattr(tty, TCSANOW, &mode) != 0) return 3;
    if (ioctl(open(argv[1], O_RDWR), GPIO_GET_LINEEVENT_IOCTL, &line) != 0) return 3;
    if (mlockall(MCL_CURRENT) != 0 || sched_setscheduler(0, SCHED_FIFO, &priority) != 0) return 3;
    if (write(STDOUT_FILENO, "ready\n", 6) != 6) return 3;
    struct pollfd edge = {.fd = line.fd, .events = POLLIN};
    struct gpioevent_data taken;
    for (;;) {
        if (poll(&edge, 1, -1) != 1) return 4;
        if (write(tty, "\x01", 1) != 1) return 4;
        if (read(line.fd, &taken, sizeof taken) != sizeof taken) return 4;
    }
}
