#include "host/terminal.h"

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <initializer_list>

namespace nplc::host {
namespace {

/// Enables escape sequences on a console; no effect on other outputs.
void take_escapes(DWORD which) {
    const HANDLE console = ::GetStdHandle(which);
    DWORD mode = 0;
    if (::GetConsoleMode(console, &mode))
        ::SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
}

}  // namespace

void prepare_streams() {
    for (std::FILE* stream : {stdin, stdout, stderr}) ::_setmode(::_fileno(stream), _O_BINARY);
    ::SetConsoleOutputCP(CP_UTF8);
    for (const DWORD which : {STD_OUTPUT_HANDLE, STD_ERROR_HANDLE}) take_escapes(which);
}

/// Windows reports the device NUL as a terminal too.
bool is_terminal(std::FILE* stream) {
    DWORD mode = 0;
    const std::intptr_t handle = ::_get_osfhandle(::_fileno(stream));
    return ::GetConsoleMode(reinterpret_cast<HANDLE>(handle), &mode) != 0;
}

std::size_t terminal_columns() {
    CONSOLE_SCREEN_BUFFER_INFO info{};
    if (!::GetConsoleScreenBufferInfo(::GetStdHandle(STD_OUTPUT_HANDLE), &info)) return 80;
    const int columns = info.srWindow.Right - info.srWindow.Left + 1;
    return columns > 1 ? static_cast<std::size_t>(columns) : 80;
}

bool input_within(base::Milliseconds wait) {
    const HANDLE input = ::GetStdHandle(STD_INPUT_HANDLE);
    return ::WaitForSingleObject(input, static_cast<DWORD>(wait.count())) == WAIT_OBJECT_0;
}

std::size_t read_input(std::span<char> into) {
    DWORD count = 0;
    const HANDLE input = ::GetStdHandle(STD_INPUT_HANDLE);
    return ::ReadFile(input, into.data(), static_cast<DWORD>(into.size()), &count, nullptr) != 0 ? count : 0;
}

bool output_has_reader() {
    const HANDLE output = ::GetStdHandle(STD_OUTPUT_HANDLE);
    if (::GetFileType(output) != FILE_TYPE_PIPE) return true;
    DWORD written = 0;
    return ::WriteFile(output, "", 0, &written, nullptr) != 0;
}

}  // namespace nplc::host
