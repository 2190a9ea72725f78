#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "diagnostics/codes.h"
#include "seqc/diagnostic.h"

namespace nplc::seqc {

/// Collects diagnostics. Beyond a limit further ones are dropped, warnings first.
class Report {
  public:
    Diagnostic& add(Code code, Span span, std::string message, std::string help = {});
    Diagnostic& add(Diagnostic diagnostic);

    /// The last one added; there must be one.
    Diagnostic& last() { return diagnostics_.back(); }

    bool has_errors() const { return errors_ > 0; }
    std::size_t error_count() const { return errors_; }
    bool full() const { return diagnostics_.size() >= kMost; }
    /// Further errors would be dropped. Until then a new error replaces a warning.
    bool full_of_errors() const { return errors_ >= kMost; }
    /// Diagnostics were dropped, here or in a report that was merged.
    bool has_more() const { return more_; }
    void note_more() { more_ = true; }
    bool has(std::string_view code) const;
    bool has(std::string_view code, Span span) const;
    /// Removes warnings that satisfy `unwanted`.
    template <class Unwanted>
    void drop(const Unwanted& unwanted) {
        std::erase_if(diagnostics_,
                      [&](const Diagnostic& d) { return d.severity == Severity::warning && unwanted(d); });
    }
    /// In source order.
    std::vector<Diagnostic> take();

  private:
    static constexpr std::size_t kMost = 100;

    std::vector<Diagnostic> diagnostics_;
    Diagnostic dropped_;
    std::size_t errors_ = 0;
    bool more_ = false;
};

}  // namespace nplc::seqc
