// Clients of nanoplc's user port: each reads the gateway's identity (001 section 2.7), and stays connected until SIGTERM.
// Says "connected" when all have been answered. usage: clients SOCKET COUNT
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

int main(int argc, char** argv) {
    static const unsigned char ask[] = {0x50, 0x50, 0x50, 0x80, 0x7F, 0x01, 0xFE, 0xAA, 0xAA};
    if (argc != 3) return 2;
    struct sockaddr_un address = {.sun_family = AF_UNIX};
    strncpy(address.sun_path, argv[1], sizeof address.sun_path - 1);
    for (int left = atoi(argv[2]); left > 0; --left) {
        char answer[64];
        const int client = socket(AF_UNIX, SOCK_STREAM, 0);
        if (client < 0 || connect(client, (struct sockaddr*)&address, sizeof address) != 0) return 3;
        if (write(client, ask, sizeof ask) != sizeof ask || read(client, answer, sizeof answer) <= 0) return 4;
    }
    puts("connected");
    fflush(stdout);
    for (;;) pause();
}
