#include "host/files.h"

#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "host/paths.h"

namespace nplc::host {

std::string read_blocks(const std::string& name, std::size_t most,
                        const std::function<bool(std::string_view block)>& take) {
    std::error_code error;
    const std::filesystem::path path = path_of(name);
    if (std::filesystem::is_directory(path, error)) return "it is a folder";
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    if (!file) return std::strerror(errno);
    std::array<char, 65'536> block{};
    std::size_t read = 0;
    while (file.read(block.data(), block.size()), file.gcount() > 0) {
        read += static_cast<std::size_t>(file.gcount());
        if (read > most) return "it has more than " + std::to_string(most) + " bytes";
        if (!take({block.data(), static_cast<std::size_t>(file.gcount())})) return {};
    }
    return file.bad() ? std::strerror(errno) : std::string();
}

std::FILE* create_file(const std::string& name) {
    const int file =
        ::_wopen(path_of(name).c_str(), _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY, _S_IREAD | _S_IWRITE);
    return file < 0 ? nullptr : ::_fdopen(file, "wb");
}

}  // namespace nplc::host
