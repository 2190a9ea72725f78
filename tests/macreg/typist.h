#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "bench.h"
#include "macreg/service.h"

/// Types the commands that `why` names.
namespace nplc::macreg {

/// The words between `backticks`.
inline std::vector<std::string> commands_in(const std::string& text) {
    std::vector<std::string> all;
    for (std::size_t begin = text.find('`'); begin != std::string::npos;) {
        const std::size_t end = text.find('`', begin + 1);
        if (end == std::string::npos) break;
        all.push_back(text.substr(begin + 1, end - begin - 1));
        begin = text.find('`', end + 1);
    }
    return all;
}

inline std::vector<std::string> words_of(const std::string& command) {
    std::istringstream stream(command);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    return words;
}

/// Takes `word` out; whether it was there.
inline bool take(std::vector<std::string>& words, std::string_view word) {
    return std::erase(words, word) > 0;
}

/// `safe` and `flash`, without "macreg". False: no such command.
inline bool serve(Bench& bench, std::vector<std::string> words) {
    Service service(bench.motor, [] { return true; });
    if (take(words, "--stop")) service.allow_stop();
    std::string what;
    for (const std::string& word : words) what += (what.empty() ? "" : " ") + word;
    if (what == "safe enter")
        service.enter_safe();
    else if (what == "safe exit")
        service.exit_safe();
    else if (what == "flash reload")
        service.reload();
    else if (what == "flash defaults")
        service.defaults(true);
    else if (what == "flash save")
        static_cast<void>(service.save());
    else
        return false;
    return true;
}

}  // namespace nplc::macreg
