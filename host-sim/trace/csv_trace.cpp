#include "sim/csv_trace.h"

#include <fmt/format.h>

#include "sim/names.h"

namespace nplc::sim {
namespace {

bool same_row(const Snapshot& a, const Snapshot& b) {
    return a.step == b.step && a.timer == b.timer && a.counter == b.counter && a.inputs == b.inputs &&
           a.outputs == b.outputs && a.in_position == b.in_position && a.error == b.error &&
           a.p_ist == b.p_ist && a.v_ist == b.v_ist && a.orders == b.orders;
}

}  // namespace

CsvTrace::CsvTrace(const std::string& path) : file_(path) {
    file_.write("time_ms,step,timer,counter,inputs,outputs,inpos,error,command,p_ist,v_ist\n");
}

Time CsvTrace::next_due() const {
    return last_ ? last_->time + kLongestGap : Time{0};
}

void CsvTrace::observe(const Snapshot& s) {
    const bool changed = !last_ || !same_row(s, *last_);
    if (!changed && s.time < next_due()) return;
    if (!changed || s.time > last_->time) write_held();
    if (changed) {
        write_row(s);
    } else {
        last_ = s;
    }
    holds_ = !changed;
}

void CsvTrace::write_held() {
    if (!holds_) return;
    holds_ = false;
    write_row(Snapshot{*last_});
}

void CsvTrace::finish(const Snapshot& last) {
    write_held();
    if (!last_ || last.time > last_->time) write_row(last);
    file_.commit();
}

void CsvTrace::write_row(const Snapshot& s) {
    file_.write(fmt::format("{},{},{},{},{},{},{:d},{:d},{},{},{}\n", in_milliseconds(s.time), s.step,
                            s.timer, s.counter, s.inputs, s.outputs, s.in_position, s.error,
                            in_numbers(s.orders), s.p_ist, s.v_ist));
    last_ = s;
    last_->orders.clear();
}

}  // namespace nplc::sim
