#include "archive.h"

#include <minizip/zip.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace nplc::sim::fmu {
namespace {

/// A file in memory, in the form that minizip needs.
struct Memory {
    std::string bytes;
    std::size_t at = 0;
};

Memory& memory_of(voidpf stream) {
    return *static_cast<Memory*>(stream);
}

voidpf open_memory(voidpf memory, const void*, int) {
    return memory;
}

uLong read_memory(voidpf, voidpf stream, void* into, uLong size) {
    Memory& memory = memory_of(stream);
    const std::size_t count = std::min<std::size_t>(size, memory.bytes.size() - memory.at);
    std::memcpy(into, memory.bytes.data() + memory.at, count);
    memory.at += count;
    return count;
}

uLong write_memory(voidpf, voidpf stream, const void* from, uLong size) {
    Memory& memory = memory_of(stream);
    memory.bytes.resize(std::max<std::size_t>(memory.bytes.size(), memory.at + size));
    std::memcpy(memory.bytes.data() + memory.at, from, size);
    memory.at += size;
    return size;
}

ZPOS64_T place_in_memory(voidpf, voidpf stream) {
    return memory_of(stream).at;
}

long seek_memory(voidpf, voidpf stream, ZPOS64_T offset, int origin) {
    Memory& memory = memory_of(stream);
    std::size_t from = 0;
    if (origin == ZLIB_FILEFUNC_SEEK_CUR) from = memory.at;
    if (origin == ZLIB_FILEFUNC_SEEK_END) from = memory.bytes.size();
    if (from + offset > memory.bytes.size()) return -1;
    memory.at = from + offset;
    return 0;
}

int close_memory(voidpf, voidpf) {
    return 0;
}

int error_of_memory(voidpf, voidpf) {
    return 0;
}

void check(int code) {
    if (code != ZIP_OK) throw std::runtime_error("the FMU cannot be packed: minizip fails");
}

void add(zipFile zip, const ArchivedFile& file) {
    zip_fileinfo info{};
    info.tmz_date = {.tm_sec = 0, .tm_min = 0, .tm_hour = 0, .tm_mday = 1, .tm_mon = 0, .tm_year = 1980};
    check(zipOpenNewFileInZip(zip, file.path.c_str(), &info, nullptr, 0, nullptr, 0, nullptr, Z_DEFLATED,
                              Z_DEFAULT_COMPRESSION));
    check(zipWriteInFileInZip(zip, file.content.data(), static_cast<unsigned>(file.content.size())));
    check(zipCloseFileInZip(zip));
}

}  // namespace

std::string archive(const std::vector<ArchivedFile>& files) {
    Memory memory;
    zlib_filefunc64_def functions{};
    functions.zopen64_file = open_memory;
    functions.zread_file = read_memory;
    functions.zwrite_file = write_memory;
    functions.ztell64_file = place_in_memory;
    functions.zseek64_file = seek_memory;
    functions.zclose_file = close_memory;
    functions.zerror_file = error_of_memory;
    functions.opaque = &memory;
    const zipFile zip = zipOpen2_64("", APPEND_STATUS_CREATE, nullptr, &functions);
    if (zip == nullptr) check(ZIP_INTERNALERROR);
    for (const ArchivedFile& file : files) add(zip, file);
    check(zipClose(zip, nullptr));
    return std::move(memory.bytes);
}

}  // namespace nplc::sim::fmu
