#include "cli/dot_process.h"

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

extern char** environ;

namespace nplc::seqc::cli {
namespace {

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
/// A file without a name: with files instead of pipes neither side ever waits for the other.
using Scratch = std::unique_ptr<std::FILE, Close>;

std::string content_of(std::FILE* file) {
    std::string content;
    std::array<char, 65'536> buffer;
    std::rewind(file);
    for (std::size_t count = 0; (count = std::fread(buffer.data(), 1, buffer.size(), file)) > 0;)
        content.append(buffer.data(), count);
    return content;
}

bool fill(std::FILE* file, const std::string& text) {
    const bool written =
        std::fwrite(text.data(), 1, text.size(), file) == text.size() && std::fflush(file) == 0;
    return written && ::lseek(::fileno(file), 0, SEEK_SET) == 0;
}

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

/// The exit status as of waitpid, or an errno.
struct Ran {
    int error = 0;
    int status = 0;
};

Ran run(const std::string& option, std::FILE* in, std::FILE* out, std::FILE* err) {
    posix_spawn_file_actions_t actions;
    if (const int error = posix_spawn_file_actions_init(&actions); error != 0) return {error, 0};
    int error = 0;
    const std::array<std::FILE*, 3> files{in, out, err};
    for (int target = 0; target < 3 && error == 0; ++target)
        error = posix_spawn_file_actions_adddup2(&actions, ::fileno(files[static_cast<std::size_t>(target)]),
                                                 target);
    std::string name = "dot";
    std::string argument = option;
    const std::array<char*, 3> arguments{name.data(), argument.data(), nullptr};
    pid_t child = 0;
    if (error == 0) error = posix_spawnp(&child, "dot", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    Ran ran{error, 0};
    while (ran.error == 0 && ::waitpid(child, &ran.status, 0) < 0) {
        if (errno != EINTR) ran.error = errno;
    }
    return ran;
}

}  // namespace

Rendering render_dot(const std::string& text, const std::string& format) {
    const Scratch in(std::tmpfile());
    const Scratch out(std::tmpfile());
    const Scratch err(std::tmpfile());
    if (!in || !out || !err || !fill(in.get(), text))
        return {{}, fmt::format("cannot write a temporary file: {}", std::strerror(errno))};
    const Ran ran = run("-T" + format, in.get(), out.get(), err.get());
    if (ran.error == ENOENT) {
        return {
            {},
            "Graphviz' program 'dot' is missing: apt-get install graphviz, or take --format dot, which needs "
            "no Graphviz"};
    }
    if (ran.error != 0) return {{}, fmt::format("cannot run 'dot': {}", std::strerror(ran.error))};
    if (!WIFEXITED(ran.status) || WEXITSTATUS(ran.status) != 0)
        return {{}, fmt::format("'dot' failed: {}", first_line(content_of(err.get())))};
    return {content_of(out.get()), {}};
}

}  // namespace nplc::seqc::cli
