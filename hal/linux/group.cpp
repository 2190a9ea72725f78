#include "hal_linux/group.h"

#include <grp.h>

#include <cstdio>
#include <memory>

namespace nplc::hal_linux {

/// Not getgrnam, which a statically linked program cannot use.
std::optional<unsigned> group_number(const std::string& name) {
    const auto close = [](std::FILE* file) { std::fclose(file); };
    const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen("/etc/group", "re"), close);
    while (file != nullptr) {
        const struct group* group = ::fgetgrent(file.get());
        if (group == nullptr) break;
        if (name == group->gr_name) return group->gr_gid;
    }
    return std::nullopt;
}

}  // namespace nplc::hal_linux
