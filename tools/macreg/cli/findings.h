#pragma once

#include <fmt/format.h>

#include <string>

#include <nlohmann/json.hpp>

#include "cli/session.h"
#include "macreg/severity.h"

namespace nplc::macreg::cli {

/// What `why` says: numbered sentences, each with the values that make it so and the remedy.
class FindingsReport {
  public:
    /// `key`: of the values in a JSON document.
    explicit FindingsReport(const char* key) : key_(key) {}

    /// Of a Finding, whatever it was found in; `values` are empty if there are none.
    template <class Finding>
    void add(const Finding& finding, const std::string& values, const Json& documents) {
        text_ += fmt::format("{}{}. {}\n", text_.empty() ? "" : "\n", list_.size() + 1, finding.sentence);
        if (!values.empty()) text_ += fmt::format("   {}\n", values);
        text_ += fmt::format("   -> {}\n", finding.remedy);
        list_.push_back({{"code", finding.code},
                         {"severity", name_of(finding.severity)},
                         {"sentence", finding.sentence},
                         {key_, documents},
                         {"remedy", finding.remedy}});
    }

    /// Without the last line's end.
    std::string text() const { return text_.substr(0, text_.size() - 1); }
    Json document() const { return {{"findings", list_}}; }

  private:
    const char* key_;
    std::string text_;
    Json list_ = Json::array();
};

}  // namespace nplc::macreg::cli
