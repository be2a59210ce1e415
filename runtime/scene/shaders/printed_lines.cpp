// runtime/scene/shaders/printed_lines.cpp: printf of shaders in an order that is known.
#include "runtime/scene/shaders/printed_lines.h"

#include <utility>

#include "rsl/model/renderer_services.h"
#include "rsl/model/string_functions.h"
#include "runtime/scene/description/findings.h"

namespace kinora {

std::string print_text(const jit::ServiceCall& call, int lane) {
    float values[rsl::kMostFormatValues];
    for (int k = 0; k < rsl::kMostFormatValues; ++k)
        values[k] = call.args[(1 + k) * jit::kMaxLanes + lane];
    return rsl::format_text(rsl::interned(jit::bits_of(call.args[lane])), values);
}

void PrintedLines::add(std::string text) {
    ++asked_;
    if (full()) return;
    left_out_ = bytes_ + text.size() > kMostPrintBytes;
    if (left_out_) return;
    bytes_ += text.size();
    lines_.push_back(std::move(text));
}

void PrintedLines::add(const jit::ServiceCall& call, int lane) {
    if (full())
        ++asked_;
    else
        add(print_text(call, lane));
}

void PrintedLines::add(PrintedLines&& others) {
    uint64_t beyond = others.asked_ - others.lines_.size();
    for (std::string& line : others.lines_) add(std::move(line));
    asked_ += beyond;
    left_out_ = left_out_ || beyond > 0;
}

void PrintedLines::show(const PrintTo& to) const {
    for (const std::string& line : lines_)
        if (to) to(line);
}

void PrintedLines::report(const std::string& shader, Diagnostics& diagnostics) const {
    if (asked_ > lines_.size())
        diagnostics.report(Code::PRINT_LIMIT, Location{}, shader, asked_, lines_.size());
}

}  // namespace kinora
