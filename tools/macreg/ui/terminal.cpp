#include "terminal.h"

#include <langinfo.h>
#include <unistd.h>

#include <clocale>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "curses_headers.h"

namespace nplc::macreg {
namespace {

volatile std::sig_atomic_t g_ended = 0;

void on_end(int /*signal*/) {
    g_ended = 1;
}

/// Restores the terminal before the program crashes.
void on_crash(int signal) {
    ::endwin();
    std::signal(signal, SIG_DFL);
    std::raise(signal);
}

constexpr int kEscape = 27;
constexpr int kDelete = 127;
constexpr int kCtrlU = 21;
constexpr int kEscapeDelay = 50;  // milliseconds until an escape is a key of its own

struct KeyCode {
    int code;
    Key key;
};

constexpr KeyCode kKeys[] = {
    {KEY_UP, Key::up},         {KEY_DOWN, Key::down},     {KEY_LEFT, Key::left},
    {KEY_RIGHT, Key::right},   {KEY_PPAGE, Key::page_up}, {KEY_NPAGE, Key::page_down},
    {KEY_HOME, Key::first},    {KEY_END, Key::last},      {'\t', Key::tab},
    {KEY_BTAB, Key::back_tab}, {'\n', Key::enter},        {'\r', Key::enter},
    {KEY_ENTER, Key::enter},   {kEscape, Key::escape},    {KEY_BACKSPACE, Key::backspace},
    {'\b', Key::backspace},    {kDelete, Key::backspace}, {kCtrlU, Key::erase},
};

KeyPress pressed(int code) {
    for (const KeyCode& one : kKeys) {
        if (one.code == code) return {one.key};
    }
    if (code >= ' ' && code < kDelete) return {Key::character, static_cast<char>(code)};
    return {};
}

}  // namespace

Terminal::Terminal() {
    if (::isatty(STDIN_FILENO) == 0 || ::isatty(STDOUT_FILENO) == 0)
        throw std::runtime_error("ui needs a terminal; for scripts there are get, set and watch");
    std::setlocale(LC_CTYPE, "");
    utf8_ = std::strcmp(::nl_langinfo(CODESET), "UTF-8") == 0;
    g_ended = 0;
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) std::signal(signal, on_end);
    ::SCREEN* const screen = ::newterm(nullptr, stdout, stdin);
    if (screen == nullptr)
        throw std::runtime_error(
            "ui does not know this kind of terminal; set TERM, for example to xterm or vt100");
    screen_ = screen;
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, on_crash);
    ::cbreak();
    ::noecho();
    ::keypad(stdscr, TRUE);
    ::set_escdelay(kEscapeDelay);
    ::curs_set(0);
    colours_ = ::has_colors() && std::getenv("NO_COLOR") == nullptr;
    if (!colours_) return;
    ::start_color();
    ::use_default_colors();
    constexpr short kDefault = -1;
    ::init_pair(kPairBad, COLOR_RED, kDefault);
    ::init_pair(kPairCurve, COLOR_GREEN, kDefault);
    ::init_pair(kPairTitle, COLOR_CYAN, kDefault);
}

Terminal::~Terminal() {
    ::endwin();
    ::delscreen(static_cast<::SCREEN*>(screen_));
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL}) std::signal(signal, SIG_DFL);
}

KeyPress Terminal::key(int milliseconds) {
    ::wtimeout(stdscr, milliseconds);
    return pressed(::wgetch(stdscr));
}

bool Terminal::goes_on() {
    return g_ended == 0;
}

}  // namespace nplc::macreg
