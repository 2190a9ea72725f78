#pragma once

#include <string_view>

#include "language/ast.h"
#include "language/token_stream.h"

namespace nplc::seqc {

/// END IF, END STEP: both words are read as one keyword, in all of the file.
void mend_split_words(TokenStream& in);

/// Reports what stands twice; `first` is the first of the two.
void refuse_twice(TokenStream& in, Span span, std::string_view what, Span first);

/// A construct of another language outside of steps, which is skipped or mended; false if there is none.
bool refuse_foreign_item(TokenStream& in, ast::Program& program);

/// Skips to the next construct outside of steps.
void recover_item(TokenStream& in);

/// Unknown names may be some that could not be parsed.
void miss_names(ast::Program& program);

}  // namespace nplc::seqc
