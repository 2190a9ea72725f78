// Writes the register reference, one file a family, into the folder that is given.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <fstream>

#include "registers_reference/reference.h"

namespace {

using nplc::registers::Model;
namespace fs = std::filesystem;

/// The whole file or, if that cannot be, what was there before.
bool write(const fs::path& path, const std::string& text) {
    fs::path part = path;
    part += ".part";
    std::ofstream file(part, std::ios::binary);
    file << text;
    file.close();
    std::error_code failure;
    if (file) fs::rename(part, path, failure);
    if (file && !failure) return true;
    fs::remove(part, failure);
    fmt::print(stderr, "cannot write {}: check the folder and its permissions\n", path.string());
    return false;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "usage: write_registers_reference FOLDER\n");
        return 2;
    }
    for (const Model model : {Model::mac50, Model::mac800}) {
        if (!write(fs::path(argv[1]) / nplc::registers_reference::file_name(model),
                   nplc::registers_reference::reference(model))) {
            return 2;
        }
    }
    return 0;
}
