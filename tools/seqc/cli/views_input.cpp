#include "cli/views_input.h"

#include <fmt/format.h>

#include <span>

#include "sequencer/table.h"

namespace nplc::seqc::cli {

Input read_for_view(const InputFile& named) {
    Input input = read_input(named);
    if (input.exit_code != kOk) return input;
    const auto loaded = sequencer::Table::load(input.table);
    if (loaded.ok || loaded.fault.error == base::Error::no_space) return input;
    input = {};
    input.exit_code = file_problem(fmt::format("{}: term {}: {}; no gateway takes this table", named.file,
                                               loaded.fault.term, sequencer::describe(loaded.fault.error)));
    return input;
}

}  // namespace nplc::seqc::cli
