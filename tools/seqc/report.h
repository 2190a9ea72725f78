#pragma once

#include <string>
#include <vector>

#include "seqc/diagnostic.h"

namespace nplc::seqc {

/// Collects diagnostics. Beyond a bound further ones are dropped: nobody reads them.
class Report {
  public:
    Diagnostic& error(const char* code, Span span, std::string message, std::string help = {});
    Diagnostic& warning(const char* code, Span span, std::string message, std::string help = {});

    Diagnostic& add(Diagnostic diagnostic);

    bool has_errors() const { return errors_ > 0; }
    std::size_t error_count() const { return errors_; }
    bool full() const { return diagnostics_.size() >= kMost; }
    /// In source order.
    std::vector<Diagnostic> take();

  private:
    static constexpr std::size_t kMost = 200;

    std::vector<Diagnostic> diagnostics_;
    Diagnostic dropped_;
    std::size_t errors_ = 0;
};

}  // namespace nplc::seqc
