#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace nplc::seqc {

/// Names and keywords are case-insensitive.
bool same_name(std::string_view a, std::string_view b);
std::string upper(std::string_view text);

/// The candidate most similar to `name`; empty if none is similar enough.
std::string_view nearest(std::string_view name, const std::vector<std::string_view>& candidates);

/// All candidates that are as near as nearest() is; none if that is none.
std::vector<std::string_view> all_nearest(std::string_view name,
                                          const std::vector<std::string_view>& candidates);

/// Those most similar to `name`, the nearest first, `most` at the most: at least half of the letters agree.
std::vector<std::string_view> most_similar(std::string_view name,
                                           const std::vector<std::string_view>& candidates, std::size_t most);

/// Letters, digits and _, not beginning with a digit. Keywords are identifiers too.
bool is_identifier(std::string_view text);

/// TIMER or COUNTER for a name such as TIMER2 or COUNTER_1; empty otherwise.
std::string_view numbered_timer(std::string_view name);

/// "did you mean 'Travel'?" if a candidate is similar enough to `name`, else empty.
std::string suggestion(std::string_view name, const std::vector<std::string_view>& candidates);

}  // namespace nplc::seqc
