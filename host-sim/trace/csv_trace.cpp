#include "sim/csv_trace.h"

#include <fmt/format.h>

#include "sim/names.h"

namespace nplc::sim {

CsvTrace::CsvTrace(const std::string& path) : file_(path) {
    file_.write("time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist\n");
}

Time CsvTrace::next_due() const {
    return last_ ? last_->time + kLongestGap : Time{0};
}

void CsvTrace::observe(const Snapshot& s) {
    if (last_ && s.time < next_due() && s.same_state(*last_)) return;
    file_.write(fmt::format("{},{},{},{},{},{},{:d},{:d},{},{},{}\n", in_milliseconds(s.time), s.step,
                            s.timer, s.counter, s.inputs, s.outputs, s.in_position, s.error,
                            in_numbers(s.orders), s.p_ist, s.v_ist));
    last_ = s;
    last_->orders.clear();
}

}  // namespace nplc::sim
