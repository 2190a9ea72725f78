#include "host/process.h"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <system_error>

#include "host/paths.h"

extern char** environ;

namespace nplc::host {
namespace {

struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
/// A file without a name: files instead of pipes exclude a deadlock between both sides.
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

/// The exit status as of waitpid, or an errno.
struct Ended {
    int error = 0;
    int status = 0;
};

Ended run(std::vector<std::string> words, const std::array<std::FILE*, 3>& files) {
    posix_spawn_file_actions_t actions;
    if (const int error = ::posix_spawn_file_actions_init(&actions); error != 0) return {error, 0};
    int error = 0;
    for (int target = 0; target < 3 && error == 0; ++target)
        error = ::posix_spawn_file_actions_adddup2(&actions,
                                                   ::fileno(files[static_cast<std::size_t>(target)]), target);
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    pid_t child = 0;
    if (error == 0) error = ::posix_spawnp(&child, pointers[0], &actions, nullptr, pointers.data(), environ);
    ::posix_spawn_file_actions_destroy(&actions);
    Ended ended{error, 0};
    while (ended.error == 0 && ::waitpid(child, &ended.status, 0) < 0) {
        if (errno != EINTR) ended.error = errno;
    }
    return ended;
}

}  // namespace

unsigned long own_process() {
    return static_cast<unsigned long>(::getpid());
}

std::string own_folder() {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    return error ? "" : name_of(program.parent_path());
}

Ran run_program(const std::string& program, const std::vector<std::string>& arguments,
                const std::string& input) {
    const Scratch in(std::tmpfile());
    const Scratch out(std::tmpfile());
    const Scratch err(std::tmpfile());
    Ran ran;
    if (!in || !out || !err || !fill(in.get(), input)) {
        ran.problem = std::string("cannot write a temporary file: ") + std::strerror(errno);
        return ran;
    }
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    const Ended ended = run(std::move(words), {in.get(), out.get(), err.get()});
    ran.missing = ended.error == ENOENT;
    if (ended.error != 0) {
        ran.problem = "cannot run '" + program + "': " + std::strerror(ended.error);
        return ran;
    }
    if (WIFEXITED(ended.status)) ran.status = WEXITSTATUS(ended.status);
    ran.done = ran.status == 0;
    ran.output = content_of(out.get());
    ran.errors = content_of(err.get());
    return ran;
}

}  // namespace nplc::host
