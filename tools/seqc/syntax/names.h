#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nplc::seqc {

/// Case counts not in names and keywords.
bool same_name(std::string_view a, std::string_view b);
std::string upper(std::string_view text);

/// The candidate that `name` may be a misspelling of; nothing if none is near enough.
std::string_view nearest(std::string_view name, const std::vector<std::string_view>& candidates);

/// Letters, digits and _, no digit first. Words of the language are identifiers too.
bool is_identifier(std::string_view text);

/// Which of the two somebody numbers who writes TIMER2 or COUNTER_1; empty if it is none.
std::string_view numbered_timer(std::string_view name);

/// "did you mean 'Travel'?" when a candidate is near enough to `name`, else nothing.
std::string suggestion(std::string_view name, const std::vector<std::string_view>& candidates);

}  // namespace nplc::seqc
