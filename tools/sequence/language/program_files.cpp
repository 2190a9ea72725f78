#include <filesystem>
#include <utility>

#include "host/paths.h"
#include "seqc/sources.h"
#include "whole_files/whole_files.h"

namespace nplc::seqc {

TextReader file_reader() {
    return {[](const std::string& name) {
                whole_files::FileText file = whole_files::read_text(name);
                return SourceText{name, std::move(file.text), std::move(file.error)};
            },
            [](const std::string& name) {
                std::error_code error;
                const auto path = std::filesystem::weakly_canonical(
                    std::filesystem::absolute(host::path_of(name), error), error);
                return error ? name : host::name_of(path);
            }};
}

Sources read_sources(std::string name, std::string text) {
    return Sources({std::move(name), std::move(text)}, file_reader());
}

}  // namespace nplc::seqc
