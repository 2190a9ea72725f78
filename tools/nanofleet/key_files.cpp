#include "nanofleet/key_files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "command_line/files.h"
#include "command_line/program.h"

namespace nplc::nanofleet {
namespace {

namespace fs = std::filesystem;
using command_line::UserError;

/// A new file, flushed to the disk on return; a failed one is removed.
void make_file(const std::string& path, const std::string& text, unsigned mode) {
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (file < 0 && errno == EEXIST)
        throw UserError(
            fmt::format("'{}' is there already, and a key is never overwritten; name another one", path));
    if (file < 0) throw UserError(fmt::format("cannot write '{}': {}", path, std::strerror(errno)));
    errno = ENOSPC;
    const bool is_written =
        ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size()) && ::fsync(file) == 0;
    const int why = errno;
    ::close(file);
    if (is_written) return;
    ::unlink(path.c_str());
    throw UserError(fmt::format("cannot write '{}': {}", path, std::strerror(why)));
}

}  // namespace

orders::TrustedKey public_of(const orders::SecretKey& secret) {
    return {.name = secret.name, .key = orders::public_key_of(secret.seed)};
}

orders::TrustedKey make_key(const std::string& folder, const std::string& name) {
    if (!orders::has_crypto()) throw UserError(std::string(orders::kNoCrypto));
    if (!orders::is_key_name(name))
        throw UserError(fmt::format("'{}' is no name of a key: 1 to 32 letters, digits, - and _", name));
    std::error_code error;
    const std::string secret_file = fmt::format("{}/{}.key", folder, name);
    const std::string public_file = fmt::format("{}/{}.pub", folder, name);
    if (fs::exists(public_file, error))
        throw UserError(fmt::format("'{}' is there already, and a key is never overwritten; name another one",
                                    public_file));
    constexpr unsigned kOwnersAlone = 0600;
    constexpr unsigned kEverybodys = 0644;
    const orders::SecretKey secret{.name = name, .seed = orders::new_seed()};
    make_file(secret_file, orders::write_secret(name, secret.seed), kOwnersAlone);
    const orders::TrustedKey key = public_of(secret);
    make_file(public_file, orders::write_public(key), kEverybodys);
    return key;
}

std::vector<KeyFiles> list_keys(const std::string& folder) {
    orders::TrustedKeys trusted = orders::read_trusted(folder);
    if (!trusted.error.empty()) throw UserError(trusted.error);
    std::vector<KeyFiles> keys;
    std::error_code error;
    for (orders::TrustedKey& key : trusted.keys) {
        const bool has_secret = fs::exists(fmt::format("{}/{}.key", folder, key.name), error);
        keys.push_back({.key = std::move(key), .has_secret = has_secret});
    }
    return keys;
}

orders::SecretKey read_secret_file(const std::string& path) {
    struct stat status {};
    constexpr unsigned kOthers = 077;
    if (::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && (status.st_mode & kOthers) != 0)
        throw UserError(
            fmt::format("'{}' can be read or written by others: `chmod 600` it, and make another key if "
                        "somebody may have",
                        path));
    const auto secret = orders::read_secret(command_line::read_text(path));
    if (!secret)
        throw UserError(fmt::format("'{}' is no secret key; make one with `nanofleet keys make`", path));
    return *secret;
}

}  // namespace nplc::nanofleet
