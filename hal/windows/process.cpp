#include "host/process.h"

#include <windows.h>

#include <array>
#include <filesystem>

#include "handle.h"
#include "host/paths.h"
#include "text.h"

namespace nplc::host {
namespace {

using hal_windows::error_text;
using hal_windows::Handle;
using hal_windows::wide;

/// A file that a child inherits and that is deleted when all have closed it: files instead of pipes exclude a
/// deadlock between both sides.
Handle scratch() {
    std::array<wchar_t, MAX_PATH + 1> folder{};
    std::array<wchar_t, MAX_PATH + 1> name{};
    if (::GetTempPathW(MAX_PATH + 1, folder.data()) == 0 ||
        ::GetTempFileNameW(folder.data(), L"npl", 0, name.data()) == 0)
        return Handle();
    SECURITY_ATTRIBUTES inherited{};
    inherited.nLength = sizeof inherited;
    inherited.bInheritHandle = TRUE;
    return Handle(::CreateFileW(
        name.data(), GENERIC_READ | GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE,
        &inherited, CREATE_ALWAYS, FILE_ATTRIBUTE_TEMPORARY | FILE_FLAG_DELETE_ON_CLOSE, nullptr));
}

bool rewind(const Handle& file) {
    return ::SetFilePointer(file.get(), 0, nullptr, FILE_BEGIN) != INVALID_SET_FILE_POINTER;
}

bool fill(const Handle& file, const std::string& text) {
    DWORD written = 0;
    const auto bytes = static_cast<DWORD>(text.size());
    return ::WriteFile(file.get(), text.data(), bytes, &written, nullptr) && written == bytes && rewind(file);
}

std::string content_of(const Handle& file) {
    std::string content;
    std::array<char, 65'536> buffer{};
    DWORD count = 0;
    rewind(file);
    while (::ReadFile(file.get(), buffer.data(), buffer.size(), &count, nullptr) && count > 0)
        content.append(buffer.data(), count);
    return content;
}

/// Quotes as the child's C library parses it: backslashes are doubled before a quote only.
std::string quoted(const std::string& word) {
    std::string text = "\"";
    std::size_t backslashes = 0;
    for (const char c : word) {
        if (c == '"') text.append(backslashes + 1, '\\');
        backslashes = c == '\\' ? backslashes + 1 : 0;
        text += c;
    }
    return text.append(backslashes, '\\').append("\"");
}

std::wstring command_line(const std::string& program, const std::vector<std::string>& arguments) {
    std::string text = quoted(program);
    for (const std::string& argument : arguments) text.append(" ").append(quoted(argument));
    return wide(text);
}

}  // namespace

unsigned long own_process() {
    return ::GetCurrentProcessId();
}

std::string own_folder() {
    std::array<wchar_t, 32'768> name{};
    const DWORD length = ::GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size()));
    return length == 0 ? "" : name_of(std::filesystem::path(name.data(), name.data() + length).parent_path());
}

Ran run_program(const std::string& program, const std::vector<std::string>& arguments,
                const std::string& input) {
    const Handle in = scratch();
    const Handle out = scratch();
    const Handle err = scratch();
    Ran ran;
    if (!in || !out || !err || !fill(in, input)) {
        ran.problem = "cannot write a temporary file: " + error_text(::GetLastError());
        return ran;
    }
    STARTUPINFOW start{};
    start.cb = sizeof start;
    start.dwFlags = STARTF_USESTDHANDLES;
    start.hStdInput = in.get();
    start.hStdOutput = out.get();
    start.hStdError = err.get();
    PROCESS_INFORMATION child{};
    std::wstring line = command_line(program, arguments);
    if (!::CreateProcessW(nullptr, line.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr, &start,
                          &child)) {
        const DWORD reason = ::GetLastError();
        ran.missing = reason == ERROR_FILE_NOT_FOUND || reason == ERROR_PATH_NOT_FOUND;
        ran.problem = "cannot run '" + program + "': " + error_text(reason);
        return ran;
    }
    const Handle thread(child.hThread);
    const Handle process(child.hProcess);
    DWORD code = 1;
    ::WaitForSingleObject(process.get(), INFINITE);
    if (::GetExitCodeProcess(process.get(), &code)) ran.status = static_cast<int>(code);
    ran.done = ran.status == 0;
    ran.output = content_of(out);
    ran.errors = content_of(err);
    return ran;
}

}  // namespace nplc::host
